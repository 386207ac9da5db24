#include "viewer/app/floor.h"

#include <chrono>

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
        walls_ = {solid_->scene.get(), &solid_->rays};
    }
    return solid_ != nullptr;
}

std::optional<double> Floor::below(const base::Vec3d& point) {
    return isReady() ? ui::Body::findGround(walls_, point) : std::nullopt;
}

const ui::Walls* Floor::walls() {
    return isReady() ? &walls_ : nullptr;
}

}  // namespace fluxwalk::app
