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

    /// Whether the rays are there.
    bool isReady();
    /// Height (y, metres) of what lies below a point; nothing while the rays are being built or over nothing.
    std::optional<double> below(const base::Vec3d& point);
    /// What the visitor stands on and bumps into; null while the rays are being built.
    const ui::Walls* walls();

  private:
    std::future<std::unique_ptr<Solid>> building_;
    std::unique_ptr<Solid> solid_;
    ui::Walls walls_;
};

}  // namespace fluxwalk::app
