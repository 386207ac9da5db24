#pragma once

#include "core/hierarchy/hierarchy.h"
#include "core/rays/ray_scene.h"

/// Visibility of planar elements that touch.
namespace fluxwalk::transport {

using base::NodeId;

struct ContactSample {
    double seen = 0.0;  ///< directions whose light arrives, weighed by area
    double sent = 0.0;  ///< directions that meet the other element
    /// What the shadow adds to the kernel's gradients (VisibilitySample).
    base::Vec2d gradientA{0.0};
    base::Vec2d gradientB{0.0};
    unsigned rays = 0;
};

/// From points of either end, cosine-distributed directions that meet the exposed part of the other: each
/// stands for the same power. Pairs of points would have to be weighted by the kernel, and where the ends
/// touch a few of them outweigh all others, so that their ratio falls short (furnace of check 7: by 2 % where
/// a wall stands on the floor). `coupling`: the unoccluded one in m2, which says how many directions will do.
/// Symmetric in `a` and `b` as long as `key` is.
ContactSample sampleContact(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a,
                            NodeId b, double coupling, std::uint64_t key);

}  // namespace fluxwalk::transport
