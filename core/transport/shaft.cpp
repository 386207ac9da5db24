#include "core/transport/shaft.h"

#include <algorithm>
#include <cmath>

#include "core/surface/polygon_mesh.h"

namespace fluxwalk::transport {

namespace {

/// More occluders than this and the shaft counts as unknown: rays are cheaper.
constexpr std::size_t kMaxCandidates = 12;

struct Extent {
    Vec3d lower{};
    Vec3d upper{};
};

Extent extentOf(const hierarchy::Shape& shape) {
    const Vec3d center(shape.center);
    const auto r = static_cast<double>(shape.radius);
    Extent e{center - Vec3d(r), center + Vec3d(r)};
    if (shape.isPlanar) {
        e = {Vec3d(shape.corners[0]), Vec3d(shape.corners[0])};
        for (std::uint32_t i = 1; i < shape.cornerCount; ++i) {
            e.lower = glm::min(e.lower, Vec3d(shape.corners[i]));
            e.upper = glm::max(e.upper, Vec3d(shape.corners[i]));
        }
    }
    return e;
}

/// Corners of an occluding patch, if it is a planar polygon.
struct Polygon {
    std::array<Vec3d, 4> corners{};
    std::uint32_t count = 0;
    Vec3d normal{};
};

bool readPolygon(const surface::Surface& surface, std::uint32_t patch, Polygon& out) {
    if (!surface.isPlanar(patch)) {
        return false;
    }
    const surface::Region whole = surface::wholePatch(surface.domain(patch));
    out.count = whole.cornerCount;
    for (std::uint32_t i = 0; i < out.count; ++i) {
        out.corners[i] = surface.evaluate(patch, whole.corners[i]).position;
    }
    out.normal = surface.evaluate(patch, whole.corners[0]).normal;
    return true;
}

// Whether every line between two corners crosses the polygon's inside: then every line between any two points
// does, since the crossing points of all lines lie in the hull of those of the corners.
bool cutsAll(const Polygon& polygon, std::span<const Vec3d> a, std::span<const Vec3d> b, double tolerance) {
    const double offset = glm::dot(polygon.normal, polygon.corners[0]);
    const auto height = [&](const Vec3d& p) { return glm::dot(polygon.normal, p) - offset; };
    const double side = height(a[0]) > 0.0 ? 1.0 : -1.0;
    if (std::any_of(a.begin(), a.end(), [&](const Vec3d& p) { return side * height(p) <= tolerance; }) ||
        std::any_of(b.begin(), b.end(), [&](const Vec3d& p) { return -side * height(p) <= tolerance; })) {
        return false;
    }
    std::array<Vec3d, 4> inward{};
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
        const Vec3d edge = polygon.corners[(k + 1) % polygon.count] - polygon.corners[k];
        inward[k] = glm::normalize(glm::cross(polygon.normal, edge));
    }
    for (const Vec3d& from : a) {
        const double h = height(from);
        for (const Vec3d& to : b) {
            const Vec3d p = from + (h / (h - height(to))) * (to - from);
            for (std::uint32_t k = 0; k < polygon.count; ++k) {
                if (glm::dot(inward[k], p - polygon.corners[k]) < tolerance) {
                    return false;
                }
            }
        }
    }
    return true;
}

/// Points whose hull holds a node: corners of a planar element, of the box of anything else.
struct HullPoints {
    std::array<Vec3d, 8> points{};
    std::size_t count = 0;

    explicit HullPoints(const hierarchy::Shape& shape) {
        for (std::uint32_t i = 0; i < shape.cornerCount; ++i) {
            points[count++] = Vec3d(shape.corners[i]);
        }
    }
    HullPoints(const Vec3d& lower, const Vec3d& upper) {
        for (unsigned i = 0; i < 8; ++i) {
            points[count++] = Vec3d((i & 1u) != 0 ? upper.x : lower.x, (i & 2u) != 0 ? upper.y : lower.y,
                                    (i & 4u) != 0 ? upper.z : lower.z);
        }
    }
    std::span<const Vec3d> span() const { return {points.data(), count}; }
};

HullPoints hullOf(const hierarchy::Hierarchy& hierarchy, NodeId id) {
    if (hierarchy.kind(id) == hierarchy::NodeKind::cluster) {
        const hierarchy::Extent& box = hierarchy.extent(id);
        return {Vec3d(box.lower), Vec3d(box.upper)};
    }
    const hierarchy::Shape& shape = hierarchy.shape(id);
    if (shape.isPlanar) {
        return HullPoints(shape);
    }
    const Extent e = extentOf(shape);
    return {e.lower, e.upper};
}

}  // namespace

Shaft::Shaft(const hierarchy::Shape& a, const hierarchy::Shape& b, double tolerance) {
    const Extent ea = extentOf(a);
    const Extent eb = extentOf(b);
    lower_ = Vec3(glm::min(ea.lower, eb.lower) + Vec3d(tolerance));
    upper_ = Vec3(glm::max(ea.upper, eb.upper) - Vec3d(tolerance));
    for (int i = 0; i < 3; ++i) {
        // A shaft that is flat along an axis keeps its thickness.
        if (lower_[i] > upper_[i]) {
            lower_[i] = upper_[i] = 0.5f * (lower_[i] + upper_[i]);
        }
    }
    // In each axis plane the hull of two rectangles has one slanted edge for every quadrant whose extreme
    // corners' line faces it.
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        for (const double si : {-1.0, 1.0}) {
            for (const double sj : {-1.0, 1.0}) {
                const Vec3d& pa0 = si > 0 ? ea.upper : ea.lower;
                const Vec3d& pa1 = sj > 0 ? ea.upper : ea.lower;
                const Vec3d& pb0 = si > 0 ? eb.upper : eb.lower;
                const Vec3d& pb1 = sj > 0 ? eb.upper : eb.lower;
                const double di = pb0[i] - pa0[i];
                const double dj = pb1[j] - pa1[j];
                // Normal (dj, -di) up to sign must lie in the quadrant (si, sj).
                const double length = std::sqrt(di * di + dj * dj);
                if (length == 0.0 || si * sj * di * dj >= 0.0) {
                    continue;
                }
                Vec3d n(0.0);
                n[i] = si * std::abs(dj) / length;
                n[j] = sj * std::abs(di) / length;
                addPlane(n, n[i] * pa0[i] + n[j] * pa1[j] - tolerance);
            }
        }
    }
    for (const hierarchy::Shape* shape : {&a, &b}) {
        if (shape->isPlanar) {
            const Vec3d n(shape->axis);
            double least = glm::dot(n, Vec3d(shape->corners[0]));
            for (std::uint32_t i = 1; i < shape->cornerCount; ++i) {
                least = std::min(least, glm::dot(n, Vec3d(shape->corners[i])));
            }
            addPlane(-n, -least - tolerance);
        }
    }
}

void Shaft::addPlane(const Vec3d& normal, double offset) {
    normals_[planeCount_] = Vec3(normal);
    offsets_[planeCount_] = static_cast<float>(offset);
    ++planeCount_;
}

bool Shaft::excludes(const Vec3& lower, const Vec3& upper) const {
    if (lower.x > upper_.x || lower.y > upper_.y || lower.z > upper_.z || upper.x < lower_.x ||
        upper.y < lower_.y || upper.z < lower_.z) {
        return true;
    }
    for (std::size_t i = 0; i < planeCount_; ++i) {
        const Vec3& n = normals_[i];
        const float nearest = n.x * (n.x > 0.0f ? lower.x : upper.x) +
                              n.y * (n.y > 0.0f ? lower.y : upper.y) + n.z * (n.z > 0.0f ? lower.z : upper.z);
        if (nearest >= offsets_[i]) {
            return true;
        }
    }
    return false;
}

bool Shaft::excludes(std::span<const Vec3d> polygon) const {
    for (std::size_t i = 0; i < planeCount_; ++i) {
        const Vec3d n(normals_[i]);
        const auto offset = static_cast<double>(offsets_[i]);
        if (std::all_of(polygon.begin(), polygon.end(),
                        [&](const Vec3d& p) { return glm::dot(n, p) >= offset; })) {
            return true;
        }
    }
    return false;
}

double shaftTolerance(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a, NodeId b) {
    const hierarchy::Shape& shapeA = hierarchy.shape(a);
    const hierarchy::Shape& shapeB = hierarchy.shape(b);
    return 0.5 * rays.leastLift(Vec3d(shapeA.center), static_cast<double>(shapeA.radius),
                                Vec3d(shapeB.center), static_cast<double>(shapeB.radius));
}

namespace {

// Objects with a convex inside that holds both ends, where it is known of one: a vault, a lampshade, the
// inside of a sphere. They stand between no two points of the ends.
class Shells {
  public:
    Shells(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b)
        : scene_(hierarchy.scene()), ends_{End(hierarchy, a), End(hierarchy, b)} {}

    bool holdBoth(std::uint32_t object) {
        if (object != last_) {
            last_ = object;
            const surface::Surface& surface = *scene_.objects[object].surface;
            holds_ = holds(surface, object, ends_[0]) && holds(surface, object, ends_[1]);
        }
        return holds_;
    }

  private:
    struct End {
        base::Box box;
        hierarchy::ElementName name;

        End(const hierarchy::Hierarchy& hierarchy, NodeId id) : name(hierarchy.name(id)) {
            const Extent extent = extentOf(hierarchy.shape(id));
            box = {extent.lower, extent.upper};
        }
    };

    static bool holds(const surface::Surface& surface, std::uint32_t object, const End& end) {
        if (end.name.object != object) {
            return surface.isConvexAround(end.box);
        }
        // Of its own surface the hollow side; what is convex around a point is so around all it holds.
        const base::Vec3d middle = surface.bounds().center();
        return surface.canSeeItself(end.name.patch, end.name.back) &&
               surface.isConvexAround({middle, middle});
    }

    const scene::Scene& scene_;
    std::array<End, 2> ends_;
    std::uint32_t last_ = 0xffffffffu;
    bool holds_ = false;
};

}  // namespace

ShaftContent inspectShaft(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b, double tolerance) {
    const hierarchy::Shape& shapeA = hierarchy.shape(a);
    const hierarchy::Shape& shapeB = hierarchy.shape(b);
    const hierarchy::ElementName nameA = hierarchy.name(a);
    const hierarchy::ElementName nameB = hierarchy.name(b);
    const Shaft shaft(shapeA, shapeB, tolerance);
    const bool bothPlanar = shapeA.isPlanar && shapeB.isPlanar;
    Shells shells(hierarchy, a, b);
    const auto nodes = hierarchy.shaftTree().nodes();
    std::array<std::uint32_t, 128> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    std::size_t candidates = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const rays::SpatialTree::Node& node = nodes[at];
        if (shaft.excludes(node.lower, node.upper)) {
            continue;
        }
        if (!node.isLeaf()) {
            if (depth + 2 > stack.size()) {
                return ShaftContent::unknown;
            }
            stack[depth++] = node.right;
            stack[depth++] = at + 1;
            continue;
        }
        const auto [object, patch] = hierarchy.shaftItems()[node.item];
        const surface::Surface& surface = *hierarchy.scene().objects[object].surface;
        const bool isPlanar = surface.isPlanar(patch);
        if (!isPlanar && shells.holdBoth(object)) {
            continue;
        }
        if (isPlanar && ((object == nameA.object && patch == nameA.patch) ||
                         (object == nameB.object && patch == nameB.patch))) {
            continue;
        }
        const scene::AlphaMode alpha =
            hierarchy.scene().materials[hierarchy.scene().objects[object].material].alphaMode;
        if (alpha == scene::AlphaMode::blend) {
            continue;
        }
        Polygon polygon;
        if (isPlanar && readPolygon(surface, patch, polygon)) {
            if (shaft.excludes(std::span<const Vec3d>(polygon.corners.data(), polygon.count))) {
                continue;
            }
            if (bothPlanar && alpha == scene::AlphaMode::opaque &&
                cutsAll(polygon, HullPoints(shapeA).span(), HullPoints(shapeB).span(), tolerance)) {
                return ShaftContent::blocked;
            }
        }
        if (++candidates > kMaxCandidates) {
            return ShaftContent::unknown;
        }
    }
    return candidates == 0 ? ShaftContent::empty : ShaftContent::unknown;
}

bool isCutOff(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a, NodeId b,
              double tolerance) {
    const Vec3 from = hierarchy.shape(a).center;
    const auto hit = rays.closest({from, 0.0f, hierarchy.shape(b).center - from, 1.0f});
    if (!hit) {
        return false;
    }
    const scene::Object& object = hierarchy.scene().objects[base::index(hit->object)];
    Polygon polygon;
    return hierarchy.scene().materials[object.material].alphaMode == scene::AlphaMode::opaque &&
           readPolygon(*object.surface, hit->patch, polygon) &&
           cutsAll(polygon, hullOf(hierarchy, a).span(), hullOf(hierarchy, b).span(), tolerance);
}

}  // namespace fluxwalk::transport
