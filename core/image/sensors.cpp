#include "core/image/sensors.h"

#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"

namespace fluxwalk::image {

namespace {

using base::Vec3d;

}  // namespace

std::optional<solve::GatherPoint> findSurfacePoint(const solve::Problem& problem,
                                                   const scene::Sensor& sensor) {
    const double reach = kCaptureReach * problem.scene->bounds().diagonal();
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

bool isInSolid(const rays::RayScene& rays, const hierarchy::ReachedSides& reached,
               const scene::Sensor& sensor) {
    constexpr unsigned kRays = 32;
    unsigned dark = 0;
    for (unsigned i = 0; i < kRays; ++i) {
        const base::Vec2d p = base::r2Point(i, base::Vec2d(0.5));
        const double height = 2.0 * p.x - 1.0;
        const double flat = std::sqrt(std::max(0.0, 1.0 - height * height));
        const double turn = 2.0 * base::kPi * p.y;
        const Vec3d direction(flat * std::cos(turn), height, flat * std::sin(turn));
        const auto hit = rays.closest(rays.halfLine(sensor.position, sensor.normal, direction));
        dark += hit && !reached.isReached(base::index(hit->object), hit->patch, hit->back) ? 1u : 0u;
    }
    return 4 * dark >= kRays;
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
