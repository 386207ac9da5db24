#pragma once

#include <cmath>

#include "core/transport/form_factor.h"

/// Exchange with clusters. What a link carries to or from a cluster is shared among its patches by their own
/// directions and distances to the other end (Schaefer, section 3; ALGORITHMS 1.10), in two traversals: the
/// source's patches add up what they send there, the receiver's take their shares.
namespace fluxwalk::transport {

/// A node as a cluster sees it.
struct Ball {
    base::Vec3 center{};
    float radius = 0.0f;
};

/// The ball that stands for the other end of a cluster's link: of clusters the bounding sphere, of planar
/// elements, which may be large and near, one with the direction and size of the light that they send to the
/// cluster's centre (Lambert's vector of the polygon).
Ball findBall(const hierarchy::Hierarchy& hierarchy, NodeId cluster, NodeId other);

/// Share of a patch, in 1/m2: the part of a ball's light that it would receive, over the squared distance.
/// The cosine where all of the ball is above the patch's horizon; where it is cut, fitted to the exact factor
/// of a ball, which tends to (cos + s)^2 / (4 s) for small and is (1 + cos) / 2 for touching ones, s being
/// the sine of the angle that the ball and the patch's own cone of normals take up. Inside the ball as on its
/// surface.
inline float patchShare(const hierarchy::Shape& patch, const Ball& ball) {
    const base::Vec3 d = ball.center - patch.center;
    const float r = std::sqrt(std::max(glm::dot(d, d), 1e-30f));
    const float cosine = glm::dot(patch.axis, d) / r;
    float s = std::min(1.0f, ball.radius / r);
    if (patch.halfAngle > 0.0f) {
        s = std::min(1.0f, s + std::min(1.0f, patch.halfAngle));
    }
    if (cosine <= -s) {
        return 0.0f;
    }
    float lit = cosine;
    if (cosine < s) {
        const float t = 0.5f * (cosine + s) / s;
        const float touching = s * s * s;
        lit = s * t * (t + touching * (1.0f - t));
    }
    const float away = std::max(r, ball.radius);
    return lit / std::max(away * away, 1e-30f);
}
/// Sum of the shares of a cluster's patches, times their exposed areas.
float sumShares(const hierarchy::Hierarchy& hierarchy, NodeId cluster, const Ball& other);

/// Unoccluded exchange of a pair of which at least one is a cluster, from 32 points of each cluster; an
/// element's factor is exact at these. Spreads of clusters: twice the mean deviation from the shares of the
/// patches, relative to the mean. Coupling 0: no point sees another, which proves nothing.
PairFactor computeClusterFactor(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b);

}  // namespace fluxwalk::transport
