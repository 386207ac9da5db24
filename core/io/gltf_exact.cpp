#include "core/io/gltf_exact.h"

#include <array>
#include <cmath>
#include <string_view>

#include "core/base/check.h"
#include "core/io/gltf_meshes.h"
#include "core/surface/affine_map.h"
#include "core/surface/cone.h"
#include "core/surface/cylinder.h"
#include "core/surface/disk.h"
#include "core/surface/sphere.h"
#include "core/surface/torus.h"

namespace fluxwalk::io {

namespace {

using SurfacePtr = std::shared_ptr<const surface::Surface>;

/// Largest and smallest radius and scale that leave floats their digits.
constexpr double kLargest = 1e9;
constexpr double kSmallest = 1e-9;
/// A stand-in may be centred this far off, relative to its size: tessellations are not quite symmetric.
constexpr double kOffCentre = 0.05;
/// A cone's radius this much below the stand-in's is the smaller one.
constexpr double kSmaller = 0.999;

const tinygltf::Value& extrasOf(const GltfModel& model, const PlacedNode& node) {
    return model.data.nodes[static_cast<std::size_t>(node.index)].extras;
}

bool isUsable(const base::Mat4d& m) {
    for (int column = 0; column < 4; ++column) {
        const double length = glm::length(base::Vec3d(m[column]));
        if (!(length <= kLargest) || (column < 3 && !(length >= kSmallest))) {
            return false;
        }
    }
    // Flat: the axes span no volume compared to their lengths.
    const double volume = std::abs(glm::determinant(glm::dmat3(m)));
    return volume > 1e-9 * glm::length(base::Vec3d(m[0])) * glm::length(base::Vec3d(m[1])) *
                        glm::length(base::Vec3d(m[2]));
}

/// What a node says about its exact surface, and its stand-in where it says nothing.
struct Request {
    GltfModel& model;
    const PlacedNode& node;
    const tinygltf::Value& extras;
    std::string kind;
    bool inside = false;
    base::Box standIn;

    void warn(const std::string& message) const { model.warnings.add(message, node.place); }

    base::Vec3d half() const { return 0.5 * standIn.size(); }
    /// Radius of the stand-in about +Y.
    double standInRadius() const { return std::max(half().x, half().z); }

    /// A size from the extras; none, with a warning where there is one, if it is not above 0 (or 0, if that
    /// is one).
    std::optional<double> findSize(const char* key, bool mayBeZero = false) const {
        const std::optional<double> size = findNumber(extras, key);
        if (size && (*size > 0.0 || (mayBeZero && *size == 0.0))) {
            return size;
        }
        if (extras.Has(key)) {
            warn(std::string(key) +
                 (mayBeZero ? " is not a number of at least 0" : " is not a positive number") +
                 "; the stand-in's size is used");
        }
        return std::nullopt;
    }

    /// Whether the shape, `scale` local units large along the axes, can be placed; warns where not.
    bool isPlaceable(const base::Vec3d& scale) const {
        if (isUsable(surface::scaledMap(node.worldFromNode, scale))) {
            return true;
        }
        warn("the " + kind + "'s size or transform leaves it no area; left out");
        return false;
    }

    void warnIfOffCentre(double size) const {
        if (glm::length(standIn.center()) > kOffCentre * size) {
            warn("the stand-in mesh is not centred on its node; the " + kind + " is");
        }
    }
};

SurfacePtr readSphere(const Request& from) {
    const base::Vec3d half = from.half();
    const double radius = from.findSize("fluxwalk_radius").value_or(std::max({half.x, half.y, half.z}));
    from.warnIfOffCentre(radius);
    if (!from.isPlaceable(base::Vec3d(radius))) {
        return nullptr;
    }
    return std::make_shared<surface::Sphere>(surface::scaledMap(from.node.worldFromNode, base::Vec3d(radius)),
                                             from.inside);
}

SurfacePtr readCylinder(const Request& from) {
    const double radius = from.findSize("fluxwalk_radius").value_or(from.standInRadius());
    const double height = from.findSize("fluxwalk_height").value_or(from.standIn.size().y);
    from.warnIfOffCentre(std::max(radius, height));
    if (!from.isPlaceable({radius, height, radius})) {
        return nullptr;
    }
    return std::make_shared<surface::Cylinder>(from.node.worldFromNode, radius, height, from.inside);
}

SurfacePtr readCone(const Request& from) {
    std::optional<double> bottom = from.findSize("fluxwalk_radius_bottom", true);
    std::optional<double> top = from.findSize("fluxwalk_radius_top", true);
    // The stand-in's bounds know only the larger radius. Where the other end's is smaller it is this end's;
    // else this end is taken as the tip.
    const double larger = from.standInRadius();
    const auto other = [larger](double given) { return given < kSmaller * larger ? larger : 0.0; };
    if (!bottom) {
        bottom = top ? other(*top) : larger;
    }
    if (!top) {
        top = other(*bottom);
    }
    const double height = from.findSize("fluxwalk_height").value_or(from.standIn.size().y);
    const double radius = std::max(*bottom, *top);
    from.warnIfOffCentre(std::max(radius, height));
    if (!from.isPlaceable({radius, height, radius})) {
        return nullptr;
    }
    return std::make_shared<surface::Cone>(from.node.worldFromNode, *bottom, *top, height, from.inside);
}

SurfacePtr readDisk(const Request& from) {
    const double radius = from.findSize("fluxwalk_radius").value_or(from.standInRadius());
    double inner = 0.0;
    if (from.extras.Has("fluxwalk_inner_radius")) {
        inner = findNumber(from.extras, "fluxwalk_inner_radius").value_or(-1.0);
        if (!(inner >= 0.0 && inner < radius)) {
            from.warn("fluxwalk_inner_radius is not a number of at least 0 and below the radius; left out");
            return nullptr;
        }
    }
    from.warnIfOffCentre(radius);
    if (!from.isPlaceable(base::Vec3d(radius))) {
        return nullptr;
    }
    return std::make_shared<surface::Disk>(from.node.worldFromNode, radius, inner, from.inside);
}

SurfacePtr readTorus(const Request& from) {
    const double minor = from.findSize("fluxwalk_minor_radius").value_or(from.half().y);
    const double major = from.findSize("fluxwalk_major_radius").value_or(from.standInRadius() - minor);
    if (!(minor <= major)) {
        from.warn("the torus' tube radius is above its ring's; left out");
        return nullptr;
    }
    from.warnIfOffCentre(major);
    if (!from.isPlaceable(base::Vec3d(major)) || !from.isPlaceable(base::Vec3d(minor))) {
        return nullptr;
    }
    return std::make_shared<surface::Torus>(from.node.worldFromNode, major, minor, from.inside);
}

struct Kind {
    std::string_view name;
    SurfacePtr (*read)(const Request&);
};
constexpr std::array<Kind, 5> kKinds{{{"sphere", readSphere},
                                      {"cylinder", readCylinder},
                                      {"cone", readCone},
                                      {"disk", readDisk},
                                      {"torus", readTorus}}};

const Kind* findKind(const std::string& name) {
    for (const Kind& kind : kKinds) {
        if (kind.name == name) {
            return &kind;
        }
    }
    return nullptr;
}

}  // namespace

bool hasExactSurface(GltfModel& model, const PlacedNode& node) {
    const tinygltf::Value& extras = extrasOf(model, node);
    if (!extras.Has("fluxwalk_surface")) {
        return false;
    }
    const std::string kind = findString(extras, "fluxwalk_surface");
    if (findKind(kind) != nullptr) {
        return true;
    }
    model.warnings.add("fluxwalk_surface '" + kind + "' is not supported; the stand-in mesh is used",
                       node.place);
    return false;
}

std::shared_ptr<const surface::Surface> readExactSurface(GltfModel& model, const PlacedNode& node) {
    const tinygltf::Value& extras = extrasOf(model, node);
    const std::string name = findString(extras, "fluxwalk_surface");
    const std::optional<bool> inside = findBool(extras, "fluxwalk_inside");
    const Request request{model, node, extras, name, inside.value_or(false), localBounds(model, node, 0)};
    if (extras.Has("fluxwalk_inside") && !inside) {
        request.warn("fluxwalk_inside is neither true nor false; the front stays outside");
    }
    const Kind* kind = findKind(name);
    FLUXWALK_CHECK(kind != nullptr);
    return kind->read(request);
}

}  // namespace fluxwalk::io
