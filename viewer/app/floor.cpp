#include "viewer/app/floor.h"

#include <chrono>
#include <limits>

namespace fluxwalk::app {

// One thread: the others are the solver's.
Solid::Solid(std::shared_ptr<const scene::Scene> shapes)
    : scene(std::move(shapes)), executor(1), rays(*scene, executor) {}

Floor::Floor(std::shared_ptr<const scene::Scene> scene)
    : building_(std::async(std::launch::async, [scene = std::move(scene)]() mutable {
          return std::make_unique<Solid>(std::move(scene));
      })) {}

bool Floor::isReady() {
    if (building_.valid() && building_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        solid_ = building_.get();
    }
    return solid_ != nullptr;
}

std::optional<double> Floor::below(const base::Vec3d& point) {
    if (!isReady()) {
        return std::nullopt;
    }
    const auto hit = solid_->rays.closest(
        {base::Vec3(point), 0.0f, base::Vec3(0.0f, -1.0f, 0.0f), std::numeric_limits<float>::max()});
    return hit ? std::optional(point.y - static_cast<double>(hit->t)) : std::nullopt;
}

}  // namespace fluxwalk::app
