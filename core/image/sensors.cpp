#include "core/image/sensors.h"

namespace fluxwalk::image {

namespace {

using base::Vec3d;

/// A sensor this close to a surface along its normal, as a part of the scene's extent, sits on it.
constexpr double kCapture = 1e-3;

}  // namespace

std::optional<solve::GatherPoint> findSurfacePoint(const solve::Problem& problem,
                                                   const scene::Sensor& sensor) {
    const double reach = kCapture * problem.scene->bounds().diagonal();
    // From above, looking back along the normal: what is met first is the side that the sensor lies on.
    const Vec3d from = sensor.position + reach * sensor.normal;
    const rays::Ray ray{base::Vec3(from), 0.0f, base::Vec3(-sensor.normal), static_cast<float>(2.0 * reach)};
    const auto hit = problem.rays.closest(ray);
    if (!hit) {
        return std::nullopt;
    }
    const surface::Surface& surface = *problem.scene->objects[base::index(hit->object)].surface;
    const Vec3d met = from - static_cast<double>(hit->t) * sensor.normal;
    const base::Vec2d uv = surface.locate(hit->patch, met);
    const surface::SurfacePoint p = surface.evaluate(hit->patch, uv);
    const bool back = glm::dot(p.normal, sensor.normal) < 0.0;
    const Vec3d normal = back ? -p.normal : p.normal;
    if (glm::dot(normal, sensor.normal) < 0.9) {
        return std::nullopt;
    }
    const auto leaf = solve::findLeaf(problem, base::index(hit->object), hit->patch, back, uv);
    // What lies wholly in a narrow gap has no links, though some light may get there.
    if (!leaf || problem.hierarchy.shape(*leaf).exposedArea() <= 0.0f) {
        return std::nullopt;
    }
    return solve::GatherPoint{*leaf, p.position, normal};
}

std::vector<base::Rgb> measure(const solve::Solver& solver, std::span<const scene::Sensor> sensors) {
    const solve::Problem& problem = solver.problem();
    std::vector<base::Rgb> values(sensors.size());
    problem.executor.forRange(sensors.size(), 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto point = findSurfacePoint(problem, sensors[i]);
            values[i] = point ? solve::gatherAtPoint(problem, *point)
                              : solve::gatherInSpace(problem, sensors[i].position, sensors[i].normal);
        }
    });
    return values;
}

}  // namespace fluxwalk::image
