#include "viewer/app/floor.h"

#include <chrono>

#include "core/scene/scene_hash.h"

namespace fluxwalk::app {

// One thread: the others are the solver's.
Solid::Solid(std::shared_ptr<const scene::Scene> shapes)
    : scene(std::move(shapes)), executor(1), rays(*scene, executor) {}

Floor::Floor(std::shared_ptr<const scene::Scene> scene)
    : building_(std::async(std::launch::async, [scene = std::move(scene)]() mutable {
          const std::uint64_t hash = scene::hashScene(*scene);
          return Built{std::make_unique<Solid>(std::move(scene)), hash};
      })) {}

bool Floor::isReady() {
    if (building_.valid() && building_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        Built built = building_.get();
        solid_ = std::move(built.solid);
        hash_ = built.hash;
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

std::optional<Floor::Met> Floor::meet(const rays::Ray& ray) {
    const auto hit = isReady() ? solid_->rays.closest(ray) : std::nullopt;
    if (!hit) {
        return std::nullopt;
    }
    const base::Vec3d point(ray.origin + hit->t * ray.direction);
    return Met{point, solid_->scene->objects[base::index(hit->object)].surface->bounds()};
}

std::optional<std::uint64_t> Floor::sceneHash() {
    return isReady() ? std::optional(hash_) : std::nullopt;
}

}  // namespace fluxwalk::app
