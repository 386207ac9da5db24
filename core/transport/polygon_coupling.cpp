#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/photometry.h"
#include "core/transport/exact_form_factor.h"

// g = 1/(2 pi) times the double contour integral of ln r dx_a . dx_b (ALGORITHMS 1.7, item 4). Parallel edges
// near each other have a closed form; otherwise the inner integral is closed and the outer one a quadrature
// whose nodes crowd where the edges come close.

namespace fluxwalk::transport {

namespace {

using base::kPi;

struct Edge {
    Vec3d start{};
    Vec3d direction{};
    double length = 0.0;

    Vec3d at(double s) const { return start + s * direction; }
};

/// Nodes on [0, 1], given by their distance to the nearer end, and weights.
struct Node {
    double fromStart = 0.0;
    double fromEnd = 0.0;
    double weight = 0.0;
};

// Gauss-Legendre, roots by Newton's iteration.
template <std::size_t N>
std::array<Node, N> makeGauss() {
    std::array<Node, N> nodes{};
    for (std::size_t i = 0; i < N; ++i) {
        double x = std::cos(kPi * (static_cast<double>(i) + 0.75) / (static_cast<double>(N) + 0.5));
        double slope = 1.0;
        for (int step = 0; step < 50; ++step) {
            double below = 1.0;
            double value = x;
            for (std::size_t k = 2; k <= N; ++k) {
                const auto degree = static_cast<double>(k);
                const double next = ((2.0 * degree - 1.0) * x * value - (degree - 1.0) * below) / degree;
                below = value;
                value = next;
            }
            slope = static_cast<double>(N) * (x * value - below) / (x * x - 1.0);
            const double move = value / slope;
            x -= move;
            if (std::abs(move) < 1e-15) {
                break;
            }
        }
        nodes[i] = {0.5 * (1.0 - x), 0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)};
    }
    return nodes;
}

// Takahasi and Mori's double-exponential rule: blind to singularities at either end.
std::vector<Node> makeDoubleExponential() {
    constexpr double kStep = 0.125;
    constexpr int kHalf = 25;
    std::vector<Node> nodes;
    for (int i = -kHalf; i <= kHalf; ++i) {
        const double t = kStep * i;
        const double grow = std::exp(kPi * std::sinh(t));
        const double fromStart = grow / (1.0 + grow);
        const double fromEnd = 1.0 / (1.0 + grow);
        nodes.push_back({fromStart, fromEnd, kStep * kPi * std::cosh(t) * fromStart * fromEnd});
    }
    return nodes;
}

struct Rules {
    std::array<Node, 10> smooth = makeGauss<10>();
    std::array<Node, 16> near = makeGauss<16>();
    std::vector<Node> singular = makeDoubleExponential();
};

const Rules& rules() {
    static const Rules all;
    return all;
}

// Integral of ln |p - q| over the points q of an edge.
double innerIntegral(const Vec3d& p, const Edge& edge) {
    const Vec3d toStart = edge.start - p;
    const double u0 = glm::dot(toStart, edge.direction);
    const double u1 = u0 + edge.length;
    const double h = glm::length(glm::cross(toStart, edge.direction));
    const double h2 = h * h;
    const double r0 = u0 * u0 + h2;
    const double r1 = u1 * u1 + h2;
    double sum = h * std::atan2(h * edge.length, h2 + u0 * u1) - edge.length;
    if (r0 > 0.0) {
        sum -= 0.5 * u0 * std::log(r0);
    }
    if (r1 > 0.0) {
        sum += 0.5 * u1 * std::log(r1);
    }
    return sum;
}

// Second antiderivative over x of ln sqrt(x^2 + h^2).
double secondAntiderivative(double x, double h) {
    const double x2 = x * x;
    const double h2 = h * h;
    const double r2 = x2 + h2;
    if (r2 == 0.0) {
        return 0.0;
    }
    return 0.25 * (x2 - h2) * std::log(r2) - 0.75 * x2 + h * x * std::atan2(x, h);
}

double parallelIntegral(const Edge& a, const Edge& b, double cosine) {
    const Vec3d between = b.start - a.start;
    const double start = glm::dot(between, a.direction);
    const double end = start + std::copysign(b.length, cosine);
    const double low = std::min(start, end);
    const double high = std::max(start, end);
    const double h = glm::length(glm::cross(between, a.direction));
    return secondAntiderivative(-high, h) - secondAntiderivative(a.length - high, h) +
           secondAntiderivative(a.length - low, h) - secondAntiderivative(-low, h);
}

double distanceToEdge(const Vec3d& p, const Edge& edge) {
    const double s = std::clamp(glm::dot(p - edge.start, edge.direction), 0.0, edge.length);
    return glm::distance(p, edge.at(s));
}

template <class Nodes>
double integrate(const Nodes& nodes, const Edge& outer, double from, double to, const Edge& inner) {
    const double width = to - from;
    double sum = 0.0;
    for (const Node& node : nodes) {
        const double s =
            node.fromStart < node.fromEnd ? from + width * node.fromStart : to - width * node.fromEnd;
        sum += node.weight * innerIntegral(outer.at(s), inner);
    }
    return width * sum;
}

// Outer quadrature, cut where the outer edge passes the inner one's ends and the inner line.
double quadratureIntegral(const Edge& outer, const Edge& inner) {
    const Vec3d between = inner.start - outer.start;
    const double cosine = glm::dot(outer.direction, inner.direction);
    const double along = glm::dot(between, outer.direction);
    const double sineSquared = (1.0 - cosine) * (1.0 + cosine);
    const double crossing =
        (along - cosine * glm::dot(between, inner.direction)) / std::max(sineSquared, 1e-30);
    std::array<double, 5> cuts{0.0, along, along + cosine * inner.length, crossing, outer.length};
    for (double& cut : cuts) {
        cut = std::clamp(cut, 0.0, outer.length);
    }
    std::sort(cuts.begin(), cuts.end());
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double width = cuts[i + 1] - cuts[i];
        if (width <= 0.0) {
            continue;
        }
        const double nearest =
            std::min(distanceToEdge(outer.at(cuts[i]), inner), distanceToEdge(outer.at(cuts[i + 1]), inner));
        if (nearest > width) {
            sum += integrate(rules().smooth, outer, cuts[i], cuts[i + 1], inner);
        } else if (nearest > 0.5 * width) {
            sum += integrate(rules().near, outer, cuts[i], cuts[i + 1], inner);
        } else {
            sum += integrate(rules().singular, outer, cuts[i], cuts[i + 1], inner);
        }
    }
    return sum;
}

double edgePairIntegral(const Edge& a, const Edge& b) {
    const double cosine = glm::dot(a.direction, b.direction);
    if (std::abs(cosine) < 1e-15) {
        return 0.0;
    }
    // The closed form loses digits where edges are short against their distance, which is about 1 here.
    constexpr double kLongEnough = 0.05;
    const bool isParallel = glm::length(glm::cross(a.direction, b.direction)) < 1e-11;
    if (isParallel && std::min(a.length, b.length) > kLongEnough) {
        return cosine * parallelIntegral(a, b, cosine);
    }
    return cosine * (a.length <= b.length ? quadratureIntegral(a, b) : quadratureIntegral(b, a));
}

Vec3d areaVector(std::span<const Vec3d> polygon) {
    Vec3d doubled(0.0);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        doubled += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    }
    return 0.5 * doubled;
}

// The part of a polygon in front of a plane. Corners within rounding of the plane count as on it.
std::vector<Vec3d> clip(std::span<const Vec3d> polygon, const Vec3d& planePoint, const Vec3d& planeNormal,
                        double rounding) {
    const auto heightOf = [&](const Vec3d& p) {
        const double height = glm::dot(planeNormal, p - planePoint);
        return std::abs(height) <= rounding ? 0.0 : height;
    };
    std::vector<Vec3d> kept;
    kept.reserve(polygon.size() + 2);
    bool reachesFront = false;
    Vec3d a = polygon.back();
    double heightA = heightOf(a);
    for (const Vec3d& b : polygon) {
        const double heightB = heightOf(b);
        if ((heightA < 0.0 && heightB > 0.0) || (heightA > 0.0 && heightB < 0.0)) {
            kept.push_back(a + (heightA / (heightA - heightB)) * (b - a));
        }
        if (heightB >= 0.0) {
            kept.push_back(b);
            reachesFront = reachesFront || heightB > 0.0;
        }
        a = b;
        heightA = heightB;
    }
    if (!reachesFront) {
        kept.clear();
    }
    return kept;
}

std::vector<Edge> edgesOf(std::span<const Vec3d> polygon, const Vec3d& origin, double scale) {
    std::vector<Edge> edges;
    edges.reserve(polygon.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d a = (polygon[i] - origin) / scale;
        const Vec3d b = (polygon[(i + 1) % polygon.size()] - origin) / scale;
        const double length = glm::distance(a, b);
        if (length > 0.0) {
            edges.push_back({a, (b - a) / length, length});
        }
    }
    return edges;
}

Vec3d centerOf(std::span<const Vec3d> polygon) {
    Vec3d sum(0.0);
    for (const Vec3d& p : polygon) {
        sum += p;
    }
    return sum / static_cast<double>(polygon.size());
}

double radiusOf(std::span<const Vec3d> polygon, const Vec3d& center) {
    double radius = 0.0;
    for (const Vec3d& p : polygon) {
        radius = std::max(radius, glm::distance(p, center));
    }
    return radius;
}

}  // namespace

double polygonArea(std::span<const Vec3d> polygon) {
    return glm::length(areaVector(polygon));
}

double polygonCoupling(std::span<const Vec3d> a, std::span<const Vec3d> b) {
    const Vec3d areaA = areaVector(a);
    const Vec3d areaB = areaVector(b);
    const double sizeA = glm::length(areaA);
    const double sizeB = glm::length(areaB);
    if (!(sizeA > 0.0) || !(sizeB > 0.0)) {
        return 0.0;
    }
    const Vec3d centerA = centerOf(a);
    const Vec3d centerB = centerOf(b);
    // About the distance of typical points, so that the logarithms are near zero.
    const double scale =
        glm::distance(centerA, centerB) + 0.5 * (radiusOf(a, centerA) + radiusOf(b, centerB));
    const double rounding = 1e-12 * scale;
    const std::vector<Vec3d> frontA = clip(a, b[0], areaB / sizeB, rounding);
    const std::vector<Vec3d> frontB = clip(b, a[0], areaA / sizeA, rounding);
    if (frontA.size() < 3 || frontB.size() < 3) {
        return 0.0;
    }
    double sum = 0.0;
    const std::vector<Edge> edgesB = edgesOf(frontB, centerA, scale);
    for (const Edge& edgeA : edgesOf(frontA, centerA, scale)) {
        for (const Edge& edgeB : edgesB) {
            sum += edgePairIntegral(edgeA, edgeB);
        }
    }
    return std::max(0.0, sum * scale * scale / (2.0 * kPi));
}

}  // namespace fluxwalk::transport
