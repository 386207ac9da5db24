#pragma once

#include <cstdint>

#include "core/hierarchy/hierarchy.h"
#include "core/rays/ray_scene.h"

namespace fluxwalk::transport {

using base::NodeId;

/// Fraction of the unoccluded transport that arrives, from rays between points of the original objects.
struct VisibilitySample {
    float mean = 1.0f;       ///< kernel-weighted
    float deviation = 0.0f;  ///< sky and lights: range over the quarters of the receiver
    /// What the shadow adds to the kernel's gradients (PairFactor) over a and, where that is an element, over
    /// b.
    base::Vec2d gradientA{0.0};
    base::Vec2d gradientB{0.0};
    std::uint16_t rays = 0;
    bool isMixed = false;  ///< some were blocked and some were not
};

/// Rays of a pair, and of one that matters little. Of those between clusters many face away and are not cast:
/// where less than half are left, others are drawn, this many times at most in all.
inline constexpr unsigned kAllRays = 64;
inline constexpr unsigned kFacingRounds = 4;
inline constexpr unsigned kFewRays = 16;
/// Pairs nearer than this many times the sum of their radii exchange much through a kernel that varies much:
/// if they see each other partly, as many rays are cast again and again. They are few. (Furnace of check 7:
/// row sums within 1.5 to 3 %, 99 % of them within .8 % instead of 1.1 %, for 3 % more rays.)
inline constexpr float kNearPair = 1.5f;
inline constexpr unsigned kNearRounds = 16;
/// How many rays a pair gets.
enum class RayEffort : std::uint8_t { all, few };

/// Between two elements or clusters: stratified on both, every stratum of each used once, kernel-weighted.
/// Keyed by the names of the pair, so the same for (a, b) and (b, a).
///
/// Pairs below a partly blocked one take the second stage at once: a first stage of few rays would too often
/// take a thin beam or a thin shadow for none. Which pairs were partly blocked depends on the rays that said
/// so, and what is refined once is not refined back: light would be lost through every opening (room behind
/// one: 1.4 % at 50,000 links without, .2 % with, for 5 % more time on the Cornell box).
VisibilitySample sampleVisibility(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a,
                                  NodeId b, RayEffort effort = RayEffort::staged);

/// Between an element and a light source without area, or the sky.
VisibilitySample sampleSourceVisibility(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays,
                                        NodeId element, NodeId source);

}  // namespace fluxwalk::transport
