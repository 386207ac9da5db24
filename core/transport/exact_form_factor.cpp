#include "core/transport/exact_form_factor.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::transport {

namespace {

using base::kPi;

// Lambert's term of the edge from a to b, both relative to the receiving point: the angle that it subtends
// times the component along the normal of its plane's unit normal.
double edgeTerm(const Vec3d& a, const Vec3d& b, const Vec3d& normal) {
    const Vec3d perpendicular = glm::cross(b, a);
    const double length = glm::length(perpendicular);
    return length > 0.0 ? std::atan2(length, glm::dot(a, b)) * glm::dot(normal, perpendicular) / length : 0.0;
}

// The same of an edge from `from` to `to` that lies in the horizon.
double horizonTerm(const Vec3d& from, const Vec3d& to, const Vec3d& normal) {
    return std::atan2(glm::dot(normal, glm::cross(to, from)), glm::dot(from, to));
}

// Antiderivatives over phi of 1, cos phi and sin phi, each over (1 + k cos phi) with 0 < k < 1.
struct ArcTerms {
    double one = 0.0;
    double cosine = 0.0;
    double sine = 0.0;
};

ArcTerms arcTerms(double k, double phi) {
    // atan2 keeps the branch within (-pi, pi]; whole turns are added back.
    const double turns = std::floor((phi + kPi) / (2.0 * kPi));
    const double half = 0.5 * (phi - 2.0 * kPi * turns);
    const double angle = std::atan2(std::sqrt(1.0 - k) * std::sin(half), std::sqrt(1.0 + k) * std::cos(half));
    const double one = 2.0 * (angle + kPi * turns) / std::sqrt((1.0 - k) * (1.0 + k));
    return {one, (phi - one) / k, -std::log1p(k * std::cos(phi)) / k};
}

// Integral of Lambert's form over the arc of a circle from phi0 to phi1. In the circle's frame the receiving
// point is at the origin, the centre at (p, 0, q); `n` is the receiving normal.
double arcIntegral(double p, double q, double radius, const Vec3d& n, double phi0, double phi1) {
    const double alpha = p * p + q * q + radius * radius;
    const double k = 2.0 * p * radius / alpha;
    const double one = n.z * radius * radius;
    const double cosine = (n.z * p - n.x * q) * radius;
    const double sine = -n.y * q * radius;
    if (k > 0.05) {
        const ArcTerms t0 = arcTerms(k, phi0);
        const ArcTerms t1 = arcTerms(k, phi1);
        return (one * (t1.one - t0.one) + cosine * (t1.cosine - t0.cosine) + sine * (t1.sine - t0.sine)) /
               alpha;
    }
    // Near the axis the closed form cancels: expand 1 / (1 + k cos) in powers of k instead.
    constexpr int kTerms = 12;
    double sum = 0.0;
    double power = 1.0;
    // Integral of cos^m over the arc, by recursion.
    const auto cosPower = [&](int m) {
        double previous = m % 2 == 0 ? phi1 - phi0 : std::sin(phi1) - std::sin(phi0);
        for (int j = m % 2 == 0 ? 2 : 3; j <= m; j += 2) {
            const double edge = std::pow(std::cos(phi1), j - 1) * std::sin(phi1) -
                                std::pow(std::cos(phi0), j - 1) * std::sin(phi0);
            previous = (edge + (j - 1) * previous) / j;
        }
        return previous;
    };
    for (int m = 0; m < kTerms; ++m) {
        const double sineIntegral =
            (std::pow(std::cos(phi0), m + 1) - std::pow(std::cos(phi1), m + 1)) / (m + 1);
        sum += power * (one * cosPower(m) + cosine * cosPower(m + 1) + sine * sineIntegral);
        power *= -k;
    }
    return sum / alpha;
}

}  // namespace

double pointToPolygon(const Vec3d& x, const Vec3d& normal, std::span<const Vec3d> polygon) {
    if (polygon.size() < 3) {
        return 0.0;
    }
    double sum = 0.0;
    Vec3d exit{};        // where the contour last went below the horizon
    Vec3d firstEntry{};  // where it came up before any exit was seen
    bool hasExit = false;
    bool hasFirstEntry = false;
    Vec3d a = polygon.back() - x;
    double heightA = glm::dot(normal, a);
    for (const Vec3d& corner : polygon) {
        const Vec3d b = corner - x;
        const double heightB = glm::dot(normal, b);
        if (heightA >= 0.0 && heightB >= 0.0) {
            sum += edgeTerm(a, b, normal);
        } else if (heightA >= 0.0) {
            exit = a + (heightA / (heightA - heightB)) * (b - a);
            hasExit = true;
            sum += edgeTerm(a, exit, normal);
        } else if (heightB >= 0.0) {
            const Vec3d entry = a + (heightA / (heightA - heightB)) * (b - a);
            sum += edgeTerm(entry, b, normal);
            if (hasExit) {
                sum += horizonTerm(exit, entry, normal);
                hasExit = false;
            } else {
                firstEntry = entry;
                hasFirstEntry = true;
            }
        }
        a = b;
        heightA = heightB;
    }
    if (hasExit && hasFirstEntry) {
        sum += horizonTerm(exit, firstEntry, normal);
    }
    return std::max(0.0, sum / (2.0 * kPi));
}

double pointToDisc(const Vec3d& x, const Vec3d& normal, const Vec3d& center, const Vec3d& discNormal,
                   double radius) {
    const Vec3d c = center - x;
    const double q = glm::dot(c, discNormal);
    if (!(q < 0.0)) {
        return 0.0;
    }
    // Frame in which the centre is at (p, 0, q) with p >= 0.
    const Vec3d inPlane = c - q * discNormal;
    const double p = glm::length(inPlane);
    const Vec3d helper = std::abs(discNormal.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d e1 = p > 1e-12 * radius ? inPlane / p : glm::normalize(glm::cross(discNormal, helper));
    const Vec3d e2 = glm::cross(discNormal, e1);
    const Vec3d n(glm::dot(normal, e1), glm::dot(normal, e2), glm::dot(normal, discNormal));
    // Height of the rim over the horizon: middle + swing cos(phi - top).
    const double middle = n.x * p + n.z * q;
    const double swing = radius * std::hypot(n.x, n.y);
    if (middle >= swing) {
        return std::max(0.0, -arcIntegral(p, q, radius, n, -kPi, kPi) / (2.0 * kPi));
    }
    if (middle <= -swing) {
        return 0.0;
    }
    const double top = std::atan2(n.y, n.x);
    const double half = std::acos(std::clamp(-middle / swing, -1.0, 1.0));
    const auto rim = [&](double phi) { return Vec3d(p + radius * std::cos(phi), radius * std::sin(phi), q); };
    const double arc = -arcIntegral(p, q, radius, n, top - half, top + half);
    const double chord = horizonTerm(rim(top + half), rim(top - half), n);
    return std::max(0.0, (arc + chord) / (2.0 * kPi));
}

double pointToSphere(const Vec3d& x, const Vec3d& normal, const Vec3d& center, double radius) {
    const Vec3d toCenter = center - x;
    const double distance = glm::length(toCenter);
    if (!(distance > radius)) {
        return 0.0;
    }
    const double s = radius / distance;  // sine of the half-angle
    const double cosine = glm::dot(normal, toCenter) / distance;
    if (cosine >= s) {
        return cosine * s * s;
    }
    if (cosine <= -s) {
        return 0.0;
    }
    // The horizon cuts the sphere's disc of directions. With c the half-angle's cosine and sigma the sine of
    // the tilt, w is the half-chord on the horizon: the boundary is an arc of the cone and an arc of the
    // horizon.
    const double c = std::sqrt((1.0 - s) * (1.0 + s));
    const double sigma = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    const double ratio = std::clamp(-c * cosine / (s * sigma), -1.0, 1.0);
    const double w = std::sqrt((1.0 - ratio) * (1.0 + ratio));
    const double cone = s * s * cosine * std::acos(ratio) - s * c * sigma * w;
    const double horizon = std::atan2(sigma * w * s, c);
    return std::max(0.0, (cone + horizon) / kPi);
}

}  // namespace fluxwalk::transport
