#pragma once

#include <optional>
#include <vector>

#include "core/image/sensors.h"
#include "core/rays/ray.h"

/// What can be said of one point of a solution.
namespace fluxwalk::image {

/// What one object, light or the sky brings to a point.
struct Contributor {
    hierarchy::NodeKind kind = hierarchy::NodeKind::element;  ///< element: of the object
    std::uint32_t index = 0;                                  ///< into the scene's objects or lights
    base::Rgb irradiance{0.0f};                               ///< lux
};

/// One link that brings light to an element.
struct Connection {
    base::Vec3 source{};  ///< centre of the other end; for the sky and directional lights a point towards it
    hierarchy::NodeKind kind = hierarchy::NodeKind::element;
    unsigned above = 0;          ///< levels from the element up to the node at which the link ends
    float visibility = 1.0f;     ///< 0 to 1
    base::Rgb irradiance{0.0f};  ///< mean over the node at which it ends, lux
};

struct Inspection {
    /// On the surface. Along a ray: position and normal (not quite unit) have six decimals, so that measuring
    /// at what is printed gives the very same values.
    scene::Sensor point;
    std::uint32_t object = 0;
    std::uint32_t patch = 0;
    bool back = false;
    base::Rgb irradiance{0.0f};  ///< lux at the point, as measure() gives it
    base::Rgb luminance{0.0f};   ///< cd/m2, with the element's mean reflectance and emission
    /// The element that holds the point: levels below its patch, area in m2, centre and outline on the
    /// surface.
    unsigned level = 0;
    double area = 0.0;
    base::Vec3 center{};
    std::vector<base::Vec3> outline;
    /// Light of its links and of those of all that it is part of, most first.
    std::vector<Connection> connections;
    /// Sum is the irradiance; most first.
    std::vector<Contributor> contributors;
};

/// The point at a sensor; nothing where it sits on no lit side.
std::optional<Inspection> inspectAt(const solve::Problem& problem, const scene::Sensor& sensor);

/// The first point of a lit side along a ray (what is not lit is not shown either); nothing if it meets none.
std::optional<Inspection> inspectAlong(const solve::Problem& problem, const rays::Ray& ray);

}  // namespace fluxwalk::image
