#include "core/transport/kernel_bounds.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/photometry.h"
#include "core/transport/gauss_points.h"

namespace fluxwalk::transport {

namespace {

using base::kPi;
using hierarchy::Shape;
using surface::Region;

/// Shapes are stored as float: their rounding, relative to lengths and in radians.
constexpr double kRounding = 2e-6;

/// A bound this near to what a factor reaches for certain, relative to the largest, is good enough.
constexpr double kGoodEnough = 0.03;

using Corners = std::array<Vec3d, 4>;

// As regions are quartered: each of the first keeps its corner, a triangle's last is the middle.
std::array<Corners, 4> quartersOf(const Corners& c, std::uint32_t count) {
    Corners edge{};
    for (std::uint32_t i = 0; i < count; ++i) {
        edge[i] = 0.5 * (c[i] + c[(i + 1) % count]);
    }
    if (count == 3) {
        return {Corners{c[0], edge[0], edge[2]}, Corners{c[1], edge[1], edge[0]},
                Corners{c[2], edge[2], edge[1]}, Corners{edge[0], edge[1], edge[2]}};
    }
    const Vec3d middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    return {Corners{c[0], edge[0], middle, edge[3]}, Corners{c[1], edge[1], middle, edge[0]},
            Corners{c[2], edge[2], middle, edge[1]}, Corners{c[3], edge[3], middle, edge[2]}};
}

/// A planar element, with what it needs to be cut.
struct PlanarCutter {
    using Part = Corners;
    /// How often parts of a receiver are quartered for a pair's bounds. (Cornell box, elements at four times
    /// their radii: the median width of the bounds is .73 of the factor with 4, .70 with 20.)
    static constexpr unsigned kCuts = 4;

    std::uint32_t count = 0;
    Vec3d axis{};

    std::array<Part, 4> quarters(const Part& corners) const { return quartersOf(corners, count); }
    ElementHull hullOf(const Part& corners) const {
        ElementHull hull;
        std::copy(corners.begin(), corners.end(), hull.points.begin());
        hull.pointCount = count;
        hull.axis = axis;
        return hull;
    }
    void measure(SourcePart& part, const Part& corners) const;
};

// Triangle by triangle.
void PlanarCutter::measure(SourcePart& part, const Part& corners) const {
    const auto forTriangles = [&](const auto& action) {
        for (std::uint32_t i = 1; i + 1 < count; ++i) {
            const std::array<Vec3d, 3> c{corners[0], corners[i], corners[i + 1]};
            action(c, 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0])));
        }
    };
    Vec3d weighted(0.0);
    forTriangles([&](const std::array<Vec3d, 3>& c, double area) {
        part.area += area;
        weighted += area / 3.0 * (c[0] + c[1] + c[2]);
    });
    part.vectorArea = part.area * axis;
    part.centroid = part.area > 0.0 ? weighted / part.area : corners[0];
    forTriangles([&](const std::array<Vec3d, 3>& c, double area) {
        const Vec3d a = c[0] - part.centroid;
        const Vec3d b = c[1] - part.centroid;
        const Vec3d d = c[2] - part.centroid;
        const double squares = glm::dot(a, a) + glm::dot(b, b) + glm::dot(d, d);
        part.inertia += area / 6.0 * (squares + glm::dot(a, b) + glm::dot(b, d) + glm::dot(d, a));
    });
}

/// A curved element, towards the side that takes part.
struct CurvedCutter {
    using Part = Region;
    /// As above. (Curved objects: 1.45 with 12, 1.40 with 20, 1.38 with 32; the factor itself varies
    /// by 1.12.)
    static constexpr unsigned kCuts = 20;

    const surface::Surface& surface;
    std::uint32_t patch = 0;
    bool isBack = false;

    std::array<Part, 4> quarters(const Part& region) const {
        return surface::childRegions(surface, patch, region, surface::Split::quarters);
    }
    ElementHull hullOf(const Part& region) const;
    void measure(SourcePart& part, const Part& region) const;
};

ElementHull CurvedCutter::hullOf(const Part& region) const {
    const surface::RegionBounds bounds = surface.bounds(patch, region);
    ElementHull hull;
    hull.pointCount = 8;
    for (std::size_t i = 0; i < 8; ++i) {
        hull.points[i] = {(i & 1) != 0 ? bounds.box.upper.x : bounds.box.lower.x,
                          (i & 2) != 0 ? bounds.box.upper.y : bounds.box.lower.y,
                          (i & 4) != 0 ? bounds.box.upper.z : bounds.box.lower.z};
    }
    hull.axis = isBack ? -bounds.normals.axis : bounds.normals.axis;
    const double halfAngle = std::min(kPi, bounds.normals.halfAngle + kRounding);
    hull.cosine = std::cos(halfAngle);
    hull.sine = std::sin(halfAngle);
    return hull;
}

void CurvedCutter::measure(SourcePart& part, const Part& region) const {
    struct Point {
        Vec3d position{};
        Vec3d normal{};
        double area = 0.0;
    };
    constexpr std::size_t kSide = kGauss4.size();
    std::array<Point, kSide * kSide> points{};
    const bool isTriangle = region.cornerCount == 3;
    for (std::size_t i = 0; i < points.size(); ++i) {
        // The square root in a triangle's map is undone, so that the integrand stays smooth.
        const double s = kGauss4[i % kSide];
        const std::size_t row = i / kSide;
        const surface::RegionPoint at = surface::mapToRegion(region, {isTriangle ? s * s : s, kGauss4[row]});
        const surface::SurfacePoint p = surface.evaluate(patch, at.uv);
        const double weight = kGauss4Weight[i % kSide] * kGauss4Weight[row] * (isTriangle ? 2.0 * s : 1.0);
        points[i] = {p.position, isBack ? -p.normal : p.normal, weight * at.jacobian * p.jacobian};
        part.area += points[i].area;
        part.vectorArea += points[i].area * points[i].normal;
        part.centroid += points[i].area * p.position;
    }
    part.centroid /= part.area;
    const Vec3d mean = part.vectorArea / part.area;
    for (const Point& p : points) {
        const double away = glm::distance(p.position, part.centroid);
        part.turning += p.area * glm::distance(p.normal, mean) * away;
        part.inertia += p.area * away * away;
    }
}

template <class Cutter>
void addSource(SourceParts& out, const Cutter& cutter, const typename Cutter::Part& whole) {
    SourcePart& part = out.parts[out.count++];
    part.hull = cutter.hullOf(whole);
    cutter.measure(part, whole);
}

struct Interval {
    double lower = 0.0;
    double upper = 0.0;
    double least = -1.0;  ///< as `lower`, but below 0 where something faces away
};

/// The lengths of vectors from one hull to another, and a cone that holds their directions.
struct Vectors {
    std::array<Vec3d, 64> ends{};
    std::array<double, 64> lengths{};
    std::size_t count = 0;
    double shortest = 0.0;
    double longest = 0.0;
    Vec3d axis{};
    double cosine = 1.0;  ///< of the half angle about `axis`
};

// All vectors are convex combinations of those between points; those between two boxes fill a box.
Vectors vectorsBetween(const ElementHull& from, std::span<const Vec3d> to) {
    Vectors v;
    Vec3d sum(0.0);
    constexpr std::uint32_t kBoxCorners = 8;
    if (from.pointCount == kBoxCorners && to.size() == kBoxCorners) {
        for (std::uint32_t i = 0; i < kBoxCorners; ++i) {
            v.ends[i] = to[i] - from.points[kBoxCorners - 1 - i];
            sum += v.ends[i];
        }
        v.count = kBoxCorners;
    } else {
        for (std::uint32_t i = 0; i < from.pointCount; ++i) {
            for (const Vec3d& end : to) {
                v.ends[v.count] = end - from.points[i];
                sum += v.ends[v.count++];
            }
        }
    }
    const double length = glm::length(sum);
    v.axis = length > 0.0 ? sum / length : Vec3d(0.0);
    v.shortest = length;
    for (std::size_t i = 0; i < v.count; ++i) {
        const double along = glm::dot(v.ends[i], v.axis);
        v.lengths[i] = glm::length(v.ends[i]);
        v.shortest = std::min(v.shortest, along);
        v.longest = std::max(v.longest, v.lengths[i]);
        v.cosine = std::min(v.cosine, along / v.lengths[i]);
    }
    v.shortest -= kRounding * v.longest;
    v.longest *= 1.0 + kRounding;
    return v;
}

/// Normals about an axis.
struct Normals {
    Vec3d axis{};
    double cosine = 1.0;  ///< of the half angle
    double sine = 0.0;

    // Largest part of a vector along any of the normals, from its length and its part along the axis.
    double nearest(double along, double length) const {
        if (along >= cosine * length) {
            return length;
        }
        return along * cosine + std::sqrt(std::max(0.0, length * length - along * along)) * sine;
    }
};

// Of the cosines between an end's normals and the vectors that leave it (`sign` 1) or reach it (-1).
Interval boundCosine(const Normals& normals, const Vectors& v, double sign) {
    // The largest part along any normal is convex in the vector: an end has the extreme. So has the least
    // cosine among directions within a right angle of an axis.
    double highest = 0.0;
    double least = 1.0;
    for (std::size_t i = 0; i < v.count; ++i) {
        const double along = sign * glm::dot(normals.axis, v.ends[i]);
        least = std::min(least, -normals.nearest(-along, v.lengths[i]) / v.lengths[i]);
        highest = std::max(highest, normals.nearest(along, v.lengths[i]));
    }
    // The normals nearest to the axis of all directions, which may lean to them by the cone's half angle.
    const double along = normals.nearest(sign * glm::dot(normals.axis, v.axis), 1.0);
    const Normals directions{v.axis, v.cosine, std::sqrt(std::max(0.0, 1.0 - v.cosine * v.cosine))};
    const double inCone = directions.nearest(along, 1.0);
    Interval cosine;
    cosine.least = least - kRounding;
    cosine.lower = std::max(0.0, cosine.least);
    cosine.upper = std::max(0.0, std::min({1.0, inCone, highest / v.shortest}) + kRounding);
    return cosine;
}

Normals normalsOf(const ElementHull& hull) {
    return {hull.axis, hull.cosine, hull.sine};
}

FactorBounds boundParts(const ElementHull& receiver, const SourcePart& source) {
    const Vectors v = vectorsBetween(receiver, std::span(source.hull.points.data(), source.hull.pointCount));
    if (v.shortest <= 0.0) {
        return {};
    }
    const Interval here = boundCosine(normalsOf(receiver), v, 1.0);
    if (here.upper <= 0.0) {
        return {0.0, 0.0};
    }
    const Interval there = boundCosine(normalsOf(source.hull), v, -1.0);
    if (there.upper <= 0.0) {
        return {0.0, 0.0};
    }
    const double r2 = v.shortest * v.shortest;
    // The source's area projected on the directions to it: were these all one, it would be what the vector
    // area says, and what faces away.
    const double away = source.area * std::max(0.0, -there.least);
    const double turn = source.area * (std::sqrt(std::max(0.0, 2.0 - 2.0 * v.cosine)) + kRounding);
    const double projected = turn - glm::dot(source.vectorArea, v.axis) + away;
    FactorBounds bounds{source.area * here.lower * there.lower / (kPi * v.longest * v.longest),
                        here.upper * std::min(source.area * there.upper, projected) / (kPi * r2)};
    const double vectorArea = glm::length(source.vectorArea);
    if (here.least < 0.0 || vectorArea <= 0.0) {
        return bounds;
    }
    // Seen from above the horizon the factor is the integral of normal . W, W = cos d / (pi r3), d being the
    // vector to x. About the source's centroid W is linear but for 3 / (pi r4) times the distance squared;
    // its slope is 2 / (pi r3) at most, and adds up to nothing where all normals are alike.
    const Vectors w = vectorsBetween(receiver, std::span(&source.centroid, 1));
    const Interval atCentroid = boundCosine(normalsOf(receiver), w, 1.0);
    const Interval seen = boundCosine({source.vectorArea / vectorArea}, w, -1.0);
    const double rest = (2.0 * source.turning / v.shortest + 3.0 * source.inertia / r2) / r2;
    const double lower = vectorArea * atCentroid.lower * seen.lower / (w.longest * w.longest) - rest;
    bounds.lower = std::max(bounds.lower, lower / kPi);
    const double upper = vectorArea * atCentroid.upper * seen.upper / (w.shortest * w.shortest) + rest +
                         away * here.upper / r2;
    bounds.upper = std::min(bounds.upper, upper / kPi);
    return bounds;
}

// Most that any point of an element may see of a source: nothing subtends more than the sphere around it.
double mostInSphere(const Shape& receiver, const SourceParts& source) {
    const double nearest = glm::distance(source.center, Vec3d(receiver.center)) -
                           static_cast<double>(receiver.radius) * (1.0 + kRounding);
    if (nearest <= source.radius) {
        return 1.0;
    }
    const double sine = source.radius / nearest;
    return 2.0 * (1.0 - std::sqrt(1.0 - sine * sine));
}

template <class Cutter>
FactorBounds boundReceiver(const Cutter& cutter, const typename Cutter::Part& whole,
                           const SourceParts& source, double most) {
    struct Receiver {
        typename Cutter::Part part{};
        FactorBounds bounds;
    };
    std::array<Receiver, 4 + 3 * Cutter::kCuts> receivers;
    std::size_t count = 0;
    // What holds for all of a part holds for its quarters, whatever rounding makes of their bounds.
    const auto boundPart = [&](const typename Cutter::Part& part, const FactorBounds& all) {
        const ElementHull hull = cutter.hullOf(part);
        FactorBounds sum{0.0, 0.0};
        for (std::size_t j = 0; j < source.count; ++j) {
            const FactorBounds one = boundParts(hull, source.parts[j]);
            sum.lower += one.lower;
            sum.upper += one.upper;
        }
        return FactorBounds{std::max(sum.lower, all.lower), std::min(sum.upper, all.upper)};
    };
    for (const auto& quarter : cutter.quarters(whole)) {
        receivers[count++] = {quarter, boundPart(quarter, {0.0, most})};
    }
    for (unsigned cuts = 0;; ++cuts) {
        std::size_t lowest = 0;
        std::size_t highest = 0;
        double reached = 0.0;  // by the largest factor
        double left = 1.0;     // by the least
        for (std::size_t i = 0; i < count; ++i) {
            const FactorBounds& b = receivers[i].bounds;
            lowest = b.lower < receivers[lowest].bounds.lower ? i : lowest;
            highest = b.upper > receivers[highest].bounds.upper ? i : highest;
            reached = std::max(reached, b.lower);
            left = std::min(left, b.upper);
        }
        const double lower = receivers[lowest].bounds.lower;
        const double upper = receivers[highest].bounds.upper;
        // What either bound may be off by.
        const double above = upper - reached;
        const double below = left - lower;
        if (cuts == Cutter::kCuts || std::max(above, below) <= kGoodEnough * upper) {
            // Areas are stored as float too.
            return {lower * (1.0 - kRounding), std::min(1.0, upper * (1.0 + kRounding))};
        }
        Receiver& cut = receivers[above >= below ? highest : lowest];
        const FactorBounds all = cut.bounds;
        const auto quarters = cutter.quarters(cut.part);
        cut = {quarters[0], boundPart(quarters[0], all)};
        for (std::size_t i = 1; i < quarters.size(); ++i) {
            receivers[count++] = {quarters[i], boundPart(quarters[i], all)};
        }
    }
}

// Calls an action with what cuts an element and with the whole of it.
template <class Action>
auto withCutter(const hierarchy::Hierarchy& hierarchy, NodeId id, const Action& action) {
    const Shape& shape = hierarchy.shape(id);
    if (shape.isPlanar) {
        Corners corners{};
        std::copy(shape.corners.begin(), shape.corners.end(), corners.begin());
        return action(PlanarCutter{shape.cornerCount, glm::normalize(Vec3d(shape.axis))}, corners);
    }
    const hierarchy::ElementName name = hierarchy.name(id);
    return action(CurvedCutter{hierarchy.surfaceOf(id), name.patch, name.back}, hierarchy.region(id));
}

}  // namespace

SourceParts makeSourceParts(const hierarchy::Hierarchy& hierarchy, NodeId id) {
    const Shape& shape = hierarchy.shape(id);
    SourceParts out;
    out.center = Vec3d(shape.center);
    out.radius = static_cast<double>(shape.radius) * (1.0 + kRounding);
    withCutter(hierarchy, id, [&](const auto& cutter, const auto& whole) {
        for (const auto& quarter : cutter.quarters(whole)) {
            if (shape.isPlanar) {
                addSource(out, cutter, quarter);
                continue;
            }
            for (const auto& part : cutter.quarters(quarter)) {
                addSource(out, cutter, part);
            }
        }
    });
    return out;
}

FactorBounds boundPointFactor(const hierarchy::Hierarchy& hierarchy, NodeId receiver,
                              const SourceParts& source) {
    const double most = mostInSphere(hierarchy.shape(receiver), source);
    return withCutter(hierarchy, receiver, [&](const auto& cutter, const auto& whole) {
        return boundReceiver(cutter, whole, source, most);
    });
}

}  // namespace fluxwalk::transport
