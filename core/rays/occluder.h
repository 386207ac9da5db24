#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/texture.h"

namespace fluxwalk::rays {

/// An object as rays meet it.
struct Occluder {
    /// nullptr where the object lets all light pass.
    const surface::Surface* surface = nullptr;
    /// Patch of each triangle; empty where the surface meets rays itself.
    std::span<const std::uint32_t> patches;
    /// Set where the object has holes: an AlphaMode::mask material with a texture, and the scene's textures.
    const scene::Material* cutOut = nullptr;
    const scene::TextureSet* textures = nullptr;

    bool isHole(std::uint32_t patch, const base::Vec2d& uv) const;
    /// First hit in (tNear, tFar) that is no hole, by Surface::intersect.
    std::optional<surface::SurfaceHit> meet(const base::Vec3d& origin, const base::Vec3d& direction,
                                            double tNear, double tFar) const;
};

/// All objects of a scene, in its order, and what they point to.
struct Occluders {
    /// `scene` must outlive it.
    explicit Occluders(const scene::Scene& scene);
    Occluders(const Occluders&) = delete;
    Occluders& operator=(const Occluders&) = delete;

    std::vector<Occluder> objects;
    /// The scene's pictures, where some object has holes.
    std::optional<scene::TextureSet> textures;
};

}  // namespace fluxwalk::rays
