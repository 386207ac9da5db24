#pragma once

#include <algorithm>
#include <cmath>

#include "core/transport/form_factor.h"

/// Exchange with clusters. What a link carries to or from a cluster is shared among its patches by their own
/// directions and distances to the other end (Schaefer, section 3; ALGORITHMS 1.10), in two traversals: the
/// source's patches add up what they send there, the receiver's take their shares.
namespace fluxwalk::transport {

/// Share of a patch with mean normal `axis` at `position`, in 1/m2: the cosine towards a ball, for balls that
/// cross the patch's horizon the smooth mean of the visible part, over the squared distance from its centre,
/// within the ball over that of its surface.
inline float patchShare(const base::Vec3& position, const base::Vec3& axis, const base::Vec3& center,
                        float radius) {
    const base::Vec3 d = center - position;
    const float r2 = glm::dot(d, d);
    if (r2 <= 0.0f) {
        return 0.0f;
    }
    const float r = std::sqrt(r2);
    const float cosine = glm::dot(axis, d) / r;
    const float s = std::min(1.0f, radius / r);
    if (cosine <= -s) {
        return 0.0f;
    }
    const float lit = cosine >= s ? cosine : (cosine + s) * (cosine + s) / (4.0f * s);
    return lit / std::max(r2, radius * radius);
}
inline float patchShare(const hierarchy::Shape& patch, const hierarchy::Shape& other) {
    return patchShare(patch.center, patch.axis, other.center, other.radius);
}

/// Sum of the shares of a cluster's patches, times their exposed areas.
float sumShares(const hierarchy::Hierarchy& hierarchy, NodeId cluster, const hierarchy::Shape& other);

/// Unoccluded exchange of a pair of which at least one is a cluster, from 32 points of each cluster; an
/// element's factor is exact at these. Spreads of clusters: twice the mean deviation from the shares of the
/// patches, relative to the mean; a part of it stands for the coupling's own error at the other end. Coupling
/// 0: no point sees another, which proves nothing. No patch gets more than the ball about the other end could
/// send it.
PairFactor computeClusterFactor(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b);

}  // namespace fluxwalk::transport
