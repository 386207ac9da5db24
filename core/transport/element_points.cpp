#include "core/transport/element_points.h"

#include <algorithm>
#include <cmath>

#include "core/transport/gauss_points.h"

namespace fluxwalk::transport {

namespace {

using base::Vec2d;

constexpr double kGauss2 = 0.21132486540518713;  ///< 2-point Gauss-Legendre on [0, 1]

/// Half angle of the cone of normals in radians up to which an element counts as flat.
constexpr float kFlatAngle = 1e-5f;

// Bilinear (quad) or linear (triangle; barycentric s, t) map of the corners.
Vec3d planarPoint(const ElementPoints& e, double s, double t) {
    const auto& c = e.corners;
    if (e.cornerCount == 3) {
        return (1.0 - s - t) * c[0] + s * c[1] + t * c[2];
    }
    return (1.0 - t) * ((1.0 - s) * c[0] + s * c[1]) + t * ((1.0 - s) * c[3] + s * c[2]);
}

double planarMeasure(const ElementPoints& e, double s, double t) {
    if (e.cornerCount == 3) {
        return 1.0;
    }
    const auto& c = e.corners;
    const Vec3d ds = (1.0 - t) * (c[1] - c[0]) + t * (c[2] - c[3]);
    const Vec3d dt = (1.0 - s) * (c[3] - c[0]) + s * (c[2] - c[1]);
    return glm::length(glm::cross(ds, dt));
}

/// Points of a region in its own coordinates: (s,t) of quads, barycentric of triangles.
struct LocalPoints {
    std::array<Vec2d, base::kLanes> at;
    std::array<double, base::kLanes> weight;
};

constexpr double kThird = 1.0 / 3.0;
constexpr double kSixth = 1.0 / 6.0;

LocalPoints localPoints(std::uint32_t cornerCount) {
    if (cornerCount == 3) {
        return {{Vec2d{kSixth, kSixth}, Vec2d{2 * kThird, kSixth}, Vec2d{kSixth, 2 * kThird},
                 Vec2d{kThird, kThird}, Vec2d{0, 0}, Vec2d{1, 0}, Vec2d{0, 1}, Vec2d{kThird, kThird}},
                {kThird, kThird, kThird, 0, 0, 0, 0, 0}};
    }
    const double g = kGauss2;
    return {{Vec2d{g, g}, Vec2d{1 - g, g}, Vec2d{1 - g, 1 - g}, Vec2d{g, 1 - g}, Vec2d{0, 0}, Vec2d{1, 0},
             Vec2d{1, 1}, Vec2d{0, 1}},
            {0.25, 0.25, 0.25, 0.25, 0, 0, 0, 0}};
}

void setLane(base::Lanes3& v, int lane, const Vec3d& p) {
    v.x.set(lane, p.x);
    v.y.set(lane, p.y);
    v.z.set(lane, p.z);
}

// Sets the weights, whose sum becomes 1. Returns what it was.
double setWeights(ElementPoints& e, const std::array<double, base::kLanes>& weight) {
    double sum = 0.0;
    for (const double w : weight) {
        sum += w;
    }
    for (int i = 0; i < base::kLanes; ++i) {
        e.weight.set(i, weight[static_cast<std::size_t>(i)] / sum);
    }
    return sum;
}

// Of an element with its corners and axis.
void fillPlanar(ElementPoints& e) {
    e.normal = {base::splat(e.axis.x), base::splat(e.axis.y), base::splat(e.axis.z)};
    std::copy(e.corners.begin(), e.corners.end(), e.contour.begin());
    e.contourCount = e.cornerCount;
    const LocalPoints local = localPoints(e.cornerCount);
    std::array<double, base::kLanes> weight = local.weight;
    for (int i = 0; i < base::kLanes; ++i) {
        const Vec2d at = local.at[static_cast<std::size_t>(i)];
        setLane(e.position, i, planarPoint(e, at.x, at.y));
        weight[static_cast<std::size_t>(i)] *= planarMeasure(e, at.x, at.y);
    }
    setWeights(e, weight);
}

// Likewise of a curved one, whose corners have the parameters `c`. Returns its mean area measure per
// parameters.
double fillCurved(ElementPoints& e, const surface::Surface& surface, const hierarchy::ElementName& name,
                  const std::array<Vec2d, 4>& c) {
    const LocalPoints local = localPoints(e.cornerCount);
    std::array<double, base::kLanes> weight = local.weight;
    for (int i = 0; i < base::kLanes; ++i) {
        const Vec2d at = local.at[static_cast<std::size_t>(i)];
        const Vec2d uv = e.cornerCount == 3 ? (1.0 - at.x - at.y) * c[0] + at.x * c[1] + at.y * c[2]
                                            : (1.0 - at.y) * ((1.0 - at.x) * c[0] + at.x * c[1]) +
                                                  at.y * ((1.0 - at.x) * c[3] + at.x * c[2]);
        const surface::SurfacePoint p = surface.evaluate(name.patch, uv);
        setLane(e.position, i, p.position);
        setLane(e.normal, i, name.back ? -p.normal : p.normal);
        weight[static_cast<std::size_t>(i)] *= p.jacobian;
    }
    constexpr double kArea = 4.0 / 3.0;
    for (std::uint32_t i = 0; i < e.cornerCount; ++i) {
        const std::uint32_t next = (i + 1) % e.cornerCount;
        const Vec3d chord = 0.5 * (e.corners[i] + e.corners[next]);
        const Vec3d middle = surface.evaluate(name.patch, 0.5 * (c[i] + c[next])).position;
        e.contour[2 * i] = e.corners[i];
        e.contour[2 * i + 1] = chord + kArea * (middle - chord);
    }
    e.contourCount = 2 * e.cornerCount;
    return setWeights(e, weight);
}

// Corners' parameters in the order of the shape's corners, which run the other way round on a back side.
std::array<Vec2d, 4> shapeOrder(const surface::Region& region, bool back) {
    std::array<Vec2d, 4> c = region.corners;
    if (back) {
        std::reverse(c.begin(), c.begin() + region.cornerCount);
    }
    return c;
}

double parameterArea(const surface::Region& region) {
    const auto& c = region.corners;
    const auto cross = [](const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; };
    return 0.5 * std::abs(region.cornerCount == 3 ? cross(c[1] - c[0], c[2] - c[0])
                                                  : cross(c[2] - c[0], c[3] - c[1]));
}

}  // namespace

const std::array<base::Vec2d, base::kLanes>& localPointCoordinates(std::uint32_t cornerCount) {
    static const std::array<std::array<Vec2d, base::kLanes>, 2> kCoordinates = [] {
        std::array<std::array<Vec2d, base::kLanes>, 2> both{};
        for (std::size_t i = 0; i < base::kLanes; ++i) {
            both[0][i] = localPoints(3).at[i] - Vec2d(kThird);
            both[1][i] = 2.0 * localPoints(4).at[i] - Vec2d(1.0);
        }
        return both;
    }();
    return kCoordinates[cornerCount == 3 ? 0 : 1];
}

ElementPoints makeElementPoints(const hierarchy::Hierarchy& hierarchy, NodeId id) {
    const hierarchy::Shape& shape = hierarchy.shape(id);
    ElementPoints e;
    e.cornerCount = shape.cornerCount;
    for (std::uint32_t i = 0; i < 4; ++i) {
        e.corners[i] = Vec3d(shape.corners[i]);
    }
    e.axis = Vec3d(shape.axis);
    e.center = Vec3d(shape.center);
    e.radius = static_cast<double>(shape.radius);
    e.area = static_cast<double>(shape.area);
    e.isPlanar = shape.isPlanar;
    e.isFlat = shape.isPlanar || shape.halfAngle < kFlatAngle;
    if (e.isPlanar) {
        fillPlanar(e);
    } else {
        const hierarchy::ElementName name = hierarchy.name(id);
        fillCurved(e, hierarchy.surfaceOf(id), name, shapeOrder(hierarchy.region(id), name.back));
    }
    return e;
}

ElementPoints makeRegionPoints(const hierarchy::Hierarchy& hierarchy, NodeId element,
                               const surface::Region& region) {
    const hierarchy::Shape& shape = hierarchy.shape(element);
    const hierarchy::ElementName name = hierarchy.name(element);
    const surface::Surface& surface = hierarchy.surfaceOf(element);
    const std::array<Vec2d, 4> c = shapeOrder(region, name.back);
    ElementPoints e;
    e.cornerCount = region.cornerCount;
    for (std::uint32_t i = 0; i < 4; ++i) {
        e.corners[i] = surface.evaluate(name.patch, c[std::min(i, e.cornerCount - 1)]).position;
        e.center += 0.25 * e.corners[i];
    }
    e.axis = Vec3d(shape.axis);
    e.isPlanar = shape.isPlanar;
    e.isFlat = shape.isPlanar || shape.halfAngle < kFlatAngle;
    if (e.isPlanar) {
        fillPlanar(e);
        for (std::uint32_t i = 2; i < e.cornerCount; ++i) {
            e.area += 0.5 * glm::dot(e.axis, glm::cross(e.corners[i - 1] - e.corners[0],
                                                        e.corners[i] - e.corners[0]));
        }
    } else {
        e.area = parameterArea(region) * fillCurved(e, surface, name, c);
    }
    for (int i = 0; i < base::kLanes; ++i) {
        e.radius = std::max(
            e.radius, glm::distance(e.center, Vec3d(e.position.x[i], e.position.y[i], e.position.z[i])));
    }
    return e;
}

DensePoints makeDensePoints(const ElementPoints& element) {
    DensePoints dense;
    double sum = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
            const int lane = static_cast<int>(4 * (j % 2) + i);
            const std::size_t block = j / 2;
            double s = kGauss4[i];
            double t = kGauss4[j];
            double weight = kGauss4Weight[i] * kGauss4Weight[j];
            if (element.cornerCount == 3) {
                // Collapsed square: (s, t) -> (s (1 - t), t) with measure 1 - t.
                weight *= 1.0 - t;
                s *= 1.0 - t;
            }
            weight *= planarMeasure(element, s, t);
            setLane(dense.position[block], lane, planarPoint(element, s, t));
            dense.weight[block].set(lane, weight);
            sum += weight;
        }
    }
    for (Lanes& w : dense.weight) {
        w = w / base::splat(sum);
    }
    return dense;
}

}  // namespace fluxwalk::transport
