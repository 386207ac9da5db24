#pragma once

#include "core/transport/form_factor.h"
#include "core/transport/patch_shares.h"

/// Exchange with clusters. What a link carries to or from a cluster is shared among its patches by their own
/// directions and distances to the other end (Schaefer, section 3; ALGORITHMS 1.10), in two traversals: the
/// source's patches add up what they send there, the receiver's take their shares.
namespace fluxwalk::transport {

/// The ball that stands for the other end of a cluster's link: of clusters the bounding sphere, of planar
/// elements, which may be large and near, one with the direction and size of the light that they send to the
/// cluster's centre (Lambert's vector of the polygon).
Ball findBall(const hierarchy::Hierarchy& hierarchy, NodeId cluster, NodeId other);

/// Sum of the shares of a cluster's patches, times their exposed areas.
inline float sumShares(const hierarchy::Hierarchy& hierarchy, NodeId cluster, const Ball& ball) {
    const std::size_t begin = hierarchy.firstPatchBelow(cluster);
    return sumShares(hierarchy.patchTable(), begin, begin + hierarchy.patchesBelow(cluster).size(), ball);
}

/// Unoccluded exchange of a pair of which at least one is a cluster, from 32 points of each cluster; an
/// element's factor is exact at these. Of eight patches or fewer, each exchanges with an element as pairs of
/// elements do. Spreads of clusters: twice the mean deviation from the shares of the patches, relative to the
/// mean; where points stand for patches, a part of it counts as the coupling's own error at the other end.
/// Coupling 0: no point sees another, which proves nothing. No patch of two clusters gets more than the ball
/// about the other end could send it.
PairFactor computeClusterFactor(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b);

}  // namespace fluxwalk::transport
