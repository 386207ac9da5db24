#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/rays/ray_scene.h"
#include "core/scene/scene.h"
#include "core/scene/texture.h"

/// What the Monte-Carlo references see of a scene: points with their materials, and emitters to draw from.
namespace fluxwalk::reference {

using base::Rgb;
using base::Vec2d;
using base::Vec3d;

/// A point on a surface, seen from one of its sides.
struct SidePoint {
    std::uint32_t object = 0;
    std::uint32_t patch = 0;
    bool back = false;
    Vec3d position{};
    Vec3d normal{};  ///< unit, towards this side
    /// Reciprocal density, in m2, with which a uniform draw of the patch's parameters gives this point (the
    /// area of a flat triangle or parallelogram).
    double measure = 0.0;
    Rgb reflectance{0.0f};  ///< both sides reflect
    Rgb emission{0.0f};     ///< lm/m2 that leave this side
};

/// A scene with its rays, textures and a table of its emissive patches.
class ShadedScene {
  public:
    /// Keeps references: both must outlive it.
    ShadedScene(const scene::Scene& scene, const rays::RayScene& rays);

    const scene::Scene& scene() const { return scene_; }
    const rays::RayScene& rays() const { return rays_; }

    /// Nearest point along a ray, as at() gives it.
    std::optional<SidePoint> closest(const rays::Ray& ray) const;
    /// The point that a ray met. Where the surface does not emit, `measure` may be left out.
    SidePoint at(const rays::Ray& ray, const rays::Hit& hit) const;

    /// Side point at the parameters of a patch.
    SidePoint at(std::uint32_t object, std::uint32_t patch, const Vec2d& uv, bool back) const;

    bool hasEmissivePatches() const { return !emitters_.empty(); }
    /// A point on the front of an emissive patch. Its density in 1/m2 is emitterProbability / measure.
    SidePoint sampleEmitter(base::RandomStream& random) const;
    /// Probability with which sampleEmitter chooses a patch: its share of the power.
    double emitterProbability(std::uint32_t object, std::uint32_t patch) const;
    /// Power in lm, mean of the channels, of all emissive patches (textured ones roughly).
    double emitterPower() const { return emitters_.empty() ? 0.0 : emitters_.back().cumulative; }

  private:
    /// A triangle or parallelogram that emits alike all over: its points need no evaluation.
    struct FlatEmitter {
        Vec3d origin{};
        Vec3d alongU{};
        Vec3d alongV{};
        Vec3d normal{};
        double measure = 0.0;
    };
    struct Emitter {
        std::uint32_t object = 0;
        std::uint32_t patch = 0;
        double cumulative = 0.0;
        std::uint32_t flat = kNotFlat;  ///< index into flatEmitters_
    };
    static constexpr std::uint32_t kNotFlat = 0xffffffffu;

    std::uint32_t addFlatEmitter(const scene::Object& object, std::uint32_t patch);

    /// Plane of a flat patch, with the normal of its front: dot(normal, x) = offset.
    struct Plane {
        Vec3d normal{};
        double offset = 0.0;
    };

    const scene::Scene& scene_;
    const rays::RayScene& rays_;
    scene::TextureSet textures_;
    /// By object and patch, for objects of flat patches whose material is the same all over and does not
    /// emit: what meets them needs no parameters. Empty for others.
    std::vector<std::vector<Plane>> planes_;
    std::vector<Emitter> emitters_;
    std::vector<FlatEmitter> flatEmitters_;
    /// For each of as many equal parts of the power: the first emitter that has some of it.
    std::vector<std::uint32_t> guide_;
    /// Power by object and patch; empty for objects that do not emit.
    std::vector<std::vector<double>> power_;
};

/// Unit direction about `normal` with density cos / pi.
Vec3d cosineDirection(const Vec3d& normal, const Vec2d& random);

}  // namespace fluxwalk::reference
