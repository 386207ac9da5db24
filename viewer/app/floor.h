#pragma once

#include <future>
#include <memory>

#include "core/rays/ray_scene.h"
#include "viewer/ui/body.h"

namespace fluxwalk::app {

/// Rays against what is shown, for the ground under the visitor's feet and the first view.
struct Solid {
    explicit Solid(std::shared_ptr<const scene::Scene> shapes);

    std::shared_ptr<const scene::Scene> scene;
    base::Executor executor;
    rays::RayScene rays;
};

/// Finds the floor once its rays are ready; they are built beside, so that the window need not wait.
class Floor {
  public:
    explicit Floor(std::shared_ptr<const scene::Scene> scene);

    /// Something that a ray met.
    struct Met {
        base::Vec3d point{0.0};
        base::Box bounds;  ///< of the object
    };

    /// Whether the rays are there.
    bool isReady();
    /// Height (y, metres) of what lies below a point; nothing while the rays are being built or over nothing.
    std::optional<double> below(const base::Vec3d& point);
    /// What the visitor stands on and bumps into; null while the rays are being built.
    const ui::Walls* walls();
    /// The first thing that a ray meets; nothing while the rays are being built.
    std::optional<Met> meet(const rays::Ray& ray);
    /// What the scene is known by, once it is read.
    std::optional<std::uint64_t> sceneHash();

  private:
    struct Built {
        std::unique_ptr<Solid> solid;
        std::uint64_t hash = 0;
    };

    std::future<Built> building_;
    std::unique_ptr<Solid> solid_;
    std::uint64_t hash_ = 0;
    ui::Walls walls_;
};

}  // namespace fluxwalk::app
