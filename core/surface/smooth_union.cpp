#include "core/surface/smooth_union.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/surface/bernstein.h"

namespace fluxwalk::surface {

namespace {

/// T. Larger values let the balls melt less.
constexpr double kThreshold = 0.2;
/// (radius / S)^2 of a ball alone: 1 - cbrt(T).
const double kRelativeSquared = 1.0 - std::cbrt(kThreshold);

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

}  // namespace

SmoothUnion::SmoothUnion(const std::vector<Ball>& balls) {
    FLUXWALK_CHECK(!balls.empty() && balls.size() <= kMaxBalls);
    for (const Ball& ball : balls) {
        FLUXWALK_CHECK(ball.radius > 0.0 && std::isfinite(ball.radius));
        balls_.push_back({ball.center, ball.radius, ball.radius * ball.radius / kRelativeSquared});
    }
    // Where k balls reach, at least one of them gives T / k: no point lies farther from it than that.
    for (const Part& ball : balls_) {
        const double reach = std::sqrt(ball.reachSquared);
        double k = 0.0;
        for (const Part& other : balls_) {
            k += glm::distance(ball.center, other.center) < reach + std::sqrt(other.reachSquared) ? 1.0 : 0.0;
        }
        const double most = reach * std::sqrt(1.0 - std::cbrt(kThreshold / k)) * (1.0 + 1e-12);
        box_.extend(ball.center - most);
        box_.extend(ball.center + most);
    }
}

double SmoothUnion::value(const Vec3d& x) const {
    double f = kThreshold;
    for (const Part& ball : balls_) {
        const Vec3d r = x - ball.center;
        const double w = std::max(0.0, 1.0 - glm::dot(r, r) / ball.reachSquared);
        f -= w * w * w;
    }
    return f;
}

Vec3d SmoothUnion::gradient(const Vec3d& x) const {
    Vec3d g(0.0);
    for (const Part& ball : balls_) {
        const Vec3d r = x - ball.center;
        const double w = std::max(0.0, 1.0 - glm::dot(r, r) / ball.reachSquared);
        g += (6.0 * w * w / ball.reachSquared) * r;
    }
    return g;
}

std::optional<ProjectedPoint> SmoothUnion::intersect(const Vec3d& origin, const Vec3d& direction,
                                                     double tNear, double tFar) const {
    const double squared = glm::dot(direction, direction);
    if (!(squared > 0.0)) {
        return std::nullopt;
    }
    // Measured from the foot of the object's middle, so that digits survive a far origin.
    const double shift = glm::dot(box_.center() - origin, direction) / squared;
    const Vec3d base = origin + shift * direction;
    // Where the ray enters and leaves each ball's reach; between these places f is one polynomial.
    std::array<Interval, kMaxBalls> within;
    std::array<double, 2 * kMaxBalls + 2> stops;
    std::size_t stopCount = 0;
    const double start = tNear - shift;
    const double end = tFar - shift;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        const Vec3d r = base - balls_[i].center;
        const double half = -glm::dot(r, direction) / squared;
        const Vec3d foot = r + half * direction;
        const double room = (balls_[i].reachSquared - glm::dot(foot, foot)) / squared;
        if (!(room > 0.0)) {
            continue;
        }
        const double root = std::sqrt(room);
        within[i] = {std::max(start, half - root), std::min(end, half + root)};
        if (within[i].low < within[i].high) {
            stops[stopCount++] = within[i].low;
            stops[stopCount++] = within[i].high;
        }
    }
    std::sort(stops.begin(), stops.begin() + static_cast<std::ptrdiff_t>(stopCount));
    for (std::size_t k = 0; k + 1 < stopCount; ++k) {
        const double a = stops[k];
        const double b = stops[k + 1];
        if (!(a < b)) {
            continue;
        }
        Bernstein<7> f;
        f.fill(kThreshold);
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            if (!(within[i].low <= a && within[i].high >= b)) {
                continue;
            }
            const Vec3d from = base + a * direction - balls_[i].center;
            const Vec3d to = base + b * direction - balls_[i].center;
            const double scale = 1.0 / balls_[i].reachSquared;
            const Bernstein<3> w{1.0 - scale * glm::dot(from, from), 1.0 - scale * glm::dot(from, to),
                                 1.0 - scale * glm::dot(to, to)};
            const Bernstein<7> cubed = multiply(multiply(w, w), w);
            for (std::size_t c = 0; c < 7; ++c) {
                f[c] -= cubed[c];
            }
        }
        double from = a;
        while (const auto s = firstCrossing(f)) {
            const double along = from + *s * (b - from);
            const double t = shift + along;
            if (t > tNear && t < tFar) {
                const Vec3d position = base + along * direction;
                const Vec3d g = gradient(position);
                const double length = glm::length(g);
                return ProjectedPoint{position, length > 0.0 ? g / length : -direction / std::sqrt(squared),
                                      t};
            }
            // A ray that starts on the surface: the part behind the crossing may hold another.
            const double behind = std::min(1.0, *s + 1e-14);
            Bernstein<7> passed;
            cut(Bernstein<7>(f), behind, passed, f);
            from += behind * (b - from);
        }
    }
    return std::nullopt;
}

std::optional<ProjectedPoint> SmoothUnion::closestPoint(const Vec3d& position) const {
    // Alternates between the surface below x and the foot of `position` in the tangent plane at x.
    constexpr int kMostSteps = 300;
    const double size = box_.diagonal();
    double smallest = std::numeric_limits<double>::infinity();
    double nearest = smallest;
    Vec3d x = position;
    for (const Part& ball : balls_) {
        smallest = std::min(smallest, ball.radius);
        // Start on the nearest ball: far from all of them f is flat.
        const Vec3d r = position - ball.center;
        const double distance = glm::length(r);
        if (distance - ball.radius < nearest) {
            nearest = distance - ball.radius;
            x = distance > 0.0 ? ball.center + (ball.radius / distance) * r
                               : ball.center + Vec3d(ball.radius, 0.0, 0.0);
        }
    }
    for (int step = 0; step < kMostSteps; ++step) {
        const Vec3d g = gradient(x);
        const double slope = glm::length(g);
        if (!(slope > 0.0)) {
            return std::nullopt;
        }
        const Vec3d normal = g / slope;
        // Newton on sqrt(1 - cbrt(sum)), which is linear in the distance from a single ball's middle; f bends
        // too much for it.
        const double sum = kThreshold - value(x);
        const double root = std::cbrt(sum);
        const double squared = 1.0 - root;
        double climb = 0.1 * smallest;
        if (sum > 0.0 && squared > 0.01) {
            const double relative = std::sqrt(squared);
            climb = (std::sqrt(kRelativeSquared) - relative) * 6.0 * relative * root * root / slope;
        }
        climb = std::clamp(climb, -0.5 * smallest, 0.5 * smallest);
        const Vec3d offset = position - x;
        const Vec3d along = offset - glm::dot(offset, normal) * normal;
        // The farther away the position, the more the foot moves when x does.
        const Vec3d move = smallest / (smallest + glm::length(offset)) * along + climb * normal;
        if (glm::length(move) < 1e-13 * size) {
            return ProjectedPoint{x, normal, 0.0};
        }
        x += move;
    }
    return std::nullopt;
}

double SmoothUnion::normalVariation(const Vec3d& point, double radius) const {
    // The gradient is sum k (x - c) with k = 6 w^2 / S^2, and k of a point in the ball lies in an interval:
    // g(x) = G + sum dk (c' - c) + sum k (x - c'), c' the ball's middle, G with the intervals' middles.
    const auto factor = [&](const Part& ball, double distance) {
        const double w = std::max(0.0, 1.0 - distance * distance / ball.reachSquared);
        return 6.0 * w * w / ball.reachSquared;
    };
    const Vec3d normal = glm::normalize(gradient(point));
    Vec3d middle(0.0);
    double across = 0.0;
    double along = 0.0;
    for (const Part& ball : balls_) {
        const Vec3d r = point - ball.center;
        const double distance = glm::length(r);
        const double most = factor(ball, std::max(0.0, distance - radius));
        const double least = factor(ball, distance + radius);
        const double deviation = 0.5 * (most - least);
        const double ahead = glm::dot(r, normal);
        middle += 0.5 * (most + least) * r;
        across += deviation * glm::length(r - ahead * normal) + radius * most;
        along -= deviation * std::abs(ahead) + radius * most;
    }
    const double toward = glm::dot(middle, normal);
    across += glm::length(middle - toward * normal);
    along += toward;
    return along > 0.0 ? std::atan2(across, along) : base::kPi;
}

}  // namespace fluxwalk::surface
