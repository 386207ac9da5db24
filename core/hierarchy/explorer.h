#pragma once

#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/rays/ray_scene.h"

/// Walks of light through a scene, from surface to surface.
namespace fluxwalk::hierarchy {

/// A point on one side of an object.
struct Stand {
    base::Vec3d position{};
    base::Vec3d normal{};  ///< towards the side
};

/// Cosine-weighted direction about n.
base::Vec3d cosineDirection(const base::Vec3d& n, const base::Vec2d& u);

class Explorer {
  public:
    Explorer(const scene::Scene& scene, const rays::RayScene& rays);

    /// Objects that emit.
    const std::vector<std::uint32_t>& emitters() const { return emitters_; }
    bool emits(std::uint32_t object, bool back) const;

    /// A random point on an object; `turn` of `turns` runs through the patches.
    Stand stand(std::uint32_t object, bool back, unsigned turn, unsigned turns,
                base::RandomStream& random) const;

    /// What a walk finds on its way.
    struct Step {
        bool escaped = false;
        bool escapedUp = false;
        std::uint32_t object = 0;
        std::uint32_t patch = 0;
        bool back = false;
        Stand at;
    };
    Step step(const Stand& from, const base::Vec3d& direction) const;

    /// Whether a point of a random emitter, or any light without area, is seen from here.
    bool seesEmitter(const Stand& at, base::RandomStream& random) const;

  private:
    const scene::Scene& scene_;
    const rays::RayScene& rays_;
    std::vector<std::uint32_t> emitters_;
};

}  // namespace fluxwalk::hierarchy
