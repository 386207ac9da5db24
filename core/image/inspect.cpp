#include "core/image/inspect.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/photometry.h"
#include "core/surface/region.h"

namespace fluxwalk::image {
namespace {

using base::NodeId;
using base::Vec3d;
using hierarchy::NodeKind;

/// Sides without light that a ray may pass before it gives up.
constexpr int kMostPassed = 64;
/// Points along each edge of an outline.
constexpr int kEdgePoints = 8;

Vec3d roundToPrint(const Vec3d& v) {
    constexpr double kScale = 1e6;
    return glm::round(v * kScale) / kScale;
}

bool brighter(const base::Rgb& a, const base::Rgb& b) {
    return base::luminance(a) > base::luminance(b);
}

std::vector<Contributor> rankContributors(const solve::Problem& problem,
                                          const std::vector<solve::Contribution>& contributions) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    std::map<std::pair<NodeKind, std::uint32_t>, Vec3d> sums;
    for (const solve::Contribution& c : contributions) {
        const NodeKind kind = h.kind(c.source);
        const std::uint32_t index = kind == NodeKind::element ? h.name(c.source).object
                                    : kind == NodeKind::light ? h.lightIndex(c.source)
                                                              : 0;
        sums.try_emplace({kind, index}, 0.0).first->second += c.irradiance;
    }
    std::vector<Contributor> result;
    result.reserve(sums.size());
    for (const auto& [key, sum] : sums) {
        result.push_back({key.first, key.second, base::Rgb(sum)});
    }
    std::stable_sort(result.begin(), result.end(), [](const Contributor& a, const Contributor& b) {
        return brighter(a.irradiance, b.irradiance);
    });
    return result;
}

base::Vec3 placeOf(const solve::Problem& problem, NodeId source, const base::Vec3& seenFrom) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const Vec3d from(seenFrom);
    const double far = problem.scene->bounds().diagonal();
    if (h.kind(source) == NodeKind::sky) {
        return base::Vec3(from + far * Vec3d(0.0, 1.0, 0.0));
    }
    if (h.kind(source) == NodeKind::light) {
        const scene::Light& light = problem.scene->lights[h.lightIndex(source)];
        return base::Vec3(light.kind == scene::LightKind::directional ? from - far * light.direction
                                                                      : light.position);
    }
    return h.shape(source).center;
}

std::vector<Connection> rankConnections(const solve::Problem& problem, NodeId leaf) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const base::Vec3 center = h.shape(leaf).center;
    std::vector<Connection> result;
    unsigned above = 0;
    for (NodeId id = leaf; id != NodeId::none; id = h.parent(id), ++above) {
        const float area = h.shape(id).exposedArea();
        for (const std::uint32_t l : problem.links.endingAt(id)) {
            const hierarchy::Link& link = problem.links.links[l];
            const NodeId source = link.a == id ? link.b : link.a;
            const base::Rgb irradiance =
                area > 0.0f ? h.light(source).radiosity * (link.transfer() / area) : base::Rgb(0.0f);
            result.push_back(
                {placeOf(problem, source, center), h.kind(source), above, link.visibility(), irradiance});
        }
    }
    std::stable_sort(result.begin(), result.end(), [](const Connection& a, const Connection& b) {
        return brighter(a.irradiance, b.irradiance);
    });
    return result;
}

std::vector<base::Vec3> outlineOf(const hierarchy::Hierarchy& h, NodeId element) {
    const surface::Surface& surface = h.surfaceOf(element);
    const std::uint32_t patch = h.name(element).patch;
    const surface::Region region = h.region(element);
    std::vector<base::Vec3> points;
    for (std::uint32_t c = 0; c < region.cornerCount; ++c) {
        const base::Vec2d& from = region.corners[c];
        const base::Vec2d& to = region.corners[(c + 1) % region.cornerCount];
        for (int i = 0; i < kEdgePoints; ++i) {
            const double part = static_cast<double>(i) / kEdgePoints;
            points.emplace_back(surface.evaluate(patch, from + part * (to - from)).position);
        }
    }
    return points;
}

}  // namespace

std::optional<Inspection> inspectAt(const solve::Problem& problem, const scene::Sensor& sensor) {
    const auto point = findSurfacePoint(problem, sensor);
    if (!point) {
        return std::nullopt;
    }
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const hierarchy::ElementName name = h.name(point->leaf);
    const hierarchy::Light& light = h.light(point->leaf);
    const hierarchy::Shape& shape = h.shape(point->leaf);
    std::vector<solve::Contribution> contributions;
    Inspection result;
    result.point = sensor;
    result.object = name.object;
    result.patch = name.patch;
    result.back = name.back;
    result.irradiance = solve::gatherAtPoint(problem, *point, &contributions);
    result.luminance =
        (light.reflectance * result.irradiance + light.emission) * static_cast<float>(1.0 / base::kPi);
    result.level = surface::pathLevel(name.path);
    result.area = static_cast<double>(shape.area);
    result.center = shape.center;
    result.outline = outlineOf(h, point->leaf);
    result.connections = rankConnections(problem, point->leaf);
    result.contributors = rankContributors(problem, contributions);
    return result;
}

std::optional<Inspection> inspectAlong(const solve::Problem& problem, const rays::Ray& ray) {
    rays::Ray rest = ray;
    for (int passed = 0; passed < kMostPassed; ++passed) {
        const auto hit = problem.rays.closest(rest);
        if (!hit) {
            return std::nullopt;
        }
        const std::uint32_t object = base::index(hit->object);
        if (problem.hierarchy.patchNode(object, hit->patch, hit->back) != NodeId::none) {
            const surface::Surface& surface = *problem.scene->objects[object].surface;
            const Vec3d met = Vec3d(ray.origin) + static_cast<double>(hit->t) * Vec3d(ray.direction);
            const surface::SurfacePoint p = surface.evaluate(hit->patch, surface.locate(hit->patch, met));
            const Vec3d normal = hit->back ? -p.normal : p.normal;
            const Vec3d printed = roundToPrint(normal);
            // As a table of sensors is read.
            const double largest = std::max({std::abs(printed.x), std::abs(printed.y), std::abs(printed.z)});
            auto result = inspectAt(problem, {roundToPrint(p.position), glm::normalize(printed / largest)});
            if (result) {
                result->point.normal = printed;
            }
            return result;
        }
        rest.tNear = std::nextafter(hit->t * (1.0f + 4e-7f), std::numeric_limits<float>::max());
    }
    return std::nullopt;
}

}  // namespace fluxwalk::image
