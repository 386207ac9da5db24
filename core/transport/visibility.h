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

/// Rays of a pair.
enum class RayCount : std::uint8_t { few, usual, many };
constexpr unsigned raysOf(RayCount count) {
    return count == RayCount::few ? 16 : count == RayCount::usual ? 64 : 256;
}
/// Of those between clusters many face away and are not cast: where less than half are left, others are
/// drawn, this many times at most in all.
inline constexpr unsigned kFacingRounds = 4;
/// Pairs nearer than this many times the sum of their radii exchange much through a kernel that varies much:
/// if they see each other partly, as many rays are cast again and again. They are few. (Furnace of check 7:
/// row sums within 1.5 to 3 %, 99 % of them within .8 % instead of 1.1 %, for 3 % more rays.)
inline constexpr float kNearPair = 1.5f;
inline constexpr unsigned kNearRounds = 16;

/// Between two elements or clusters: stratified on both, every stratum of each used once, kernel-weighted.
/// Keyed by the names of the pair, so the same for (a, b) and (b, a).
///
/// There is no first stage of few rays that decides whether more are needed: it would take many a thin beam
/// or thin shadow for none, and what is taken for simple is not looked at again, so that light would be lost
/// through every opening and gained behind every small thing. (Room behind an opening: 1.4 % lost at 50,000
/// links. Cloud of 1,000 triangles in a closed room: 1.3 % too much in the balance, .2 % without the stage,
/// for 3 % more rays in furnished rooms.)
VisibilitySample sampleVisibility(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a,
                                  NodeId b, RayCount count = RayCount::usual);

/// Between an element and a light source without area, or the sky.
VisibilitySample sampleSourceVisibility(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays,
                                        NodeId element, NodeId source, RayCount count = RayCount::usual);

}  // namespace fluxwalk::transport
