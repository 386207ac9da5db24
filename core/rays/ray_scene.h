#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/base/ids.h"
#include "core/base/parallel.h"
#include "core/rays/patch_tree.h"
#include "core/rays/ray.h"
#include "core/scene/scene.h"

/// Rays against the original objects, through Embree or the tree over the patches.
namespace fluxwalk::rays {

using base::Vec2d;
using base::Vec3;
using base::Vec3d;

struct Hit {
    float t = 0.0f;
    base::ObjectId object{};
    std::uint32_t patch = 0;
    bool back = false;  ///< met from behind the surface's normal
};

/// Origins are lifted off their surface by this part of the scene's extent: 250 times the rounding of float,
/// and less than a quarter of the thinnest wall worth modelling.
inline constexpr double kLift = 0x1.0p-16;
/// Segments by no more than this part of their length and of their ends' coordinates together: a lift of
/// 1.5 cm, as in a scene of 1 km, would take .6 % of what a cylinder of 2 m sees of itself past another.
inline constexpr double kLiftOfReach = 4.0 * kLift;
/// But at least by this part of the largest lift: quads count as flat that are not quite.
inline constexpr double kLeastLift = 0.125;

/// What answers whether a ray is occluded.
enum class RayEngine : std::uint8_t {
    embree,
    /// The tree over the patches, the same kind as that of the clusters (TreeRays).
    clusters
};

class RayScene {
  public:
    /// Keeps references to the scene's surfaces and images: `scene` must outlive it. Nearest hits are
    /// Embree's with either engine; `builder` is for RayEngine::clusters.
    RayScene(const scene::Scene& scene, const base::Executor& executor, RayEngine engine = RayEngine::embree,
             TreeBuilder builder = TreeBuilder::sah);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// The tree that answers, for others to share; nullptr with RayEngine::embree.
    std::shared_ptr<const PatchTree> patchTree() const;

    /// Lift in metres for this scene, at most.
    double lift() const { return lift_; }

    /// Least lift in metres of segments between points of two balls.
    double leastLift(const Vec3d& a, double radiusA, const Vec3d& b, double radiusB) const;

    /// Segment between two surface points, both lifted along their normals (unit, towards the side that sees
    /// the other).
    Ray segment(const Vec3d& from, const Vec3d& fromNormal, const Vec3d& to, const Vec3d& toNormal) const;
    /// Half-line from a lifted surface point.
    Ray halfLine(const Vec3d& from, const Vec3d& fromNormal, const Vec3d& direction) const;

    /// Nearest hit; nothing also for rays that make no sense: not finite, coordinates beyond 1.8e18, a
    /// negative tNear, tFar below tNear (Embree could not bear them).
    std::optional<Hit> closest(const Ray& ray) const;
    /// The same for a bundle of rays; hits[i] belongs to rays[i].
    void closest(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const;
    /// Rays that make no sense count as occluded: nothing is known to be free.
    bool isOccluded(const Ray& ray) const;
    /// Occlusion of a bundle of rays with common ends or directions; blocked[i] becomes 1 or 0. Best with 16
    /// to 256 rays.
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

  private:
    double liftOver(double reach) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
    double lift_ = 0.0;
};

}  // namespace fluxwalk::rays
