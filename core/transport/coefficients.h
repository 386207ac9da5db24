#pragma once

#include <cstdint>
#include <span>

#include "core/base/parallel.h"
#include "core/hierarchy/hierarchy.h"
#include "core/rays/ray_scene.h"
#include "core/transport/cluster_model.h"
#include "core/transport/visibility.h"

namespace fluxwalk::transport {

using base::NodeId;

/// A pair whose coefficient is asked for. `isOpen`: a pair above it was found with an empty shaft.
struct Query {
    NodeId a{};
    NodeId b{};
    bool isOpen = false;
};

/// What a pair exchanges. `b` may be a light source, where `a` is an element; either may be a cluster.
struct Coefficient {
    float coupling = 0.0f;  ///< unoccluded, m2, between the exposed parts
    float visibility = 1.0f;
    base::Vec2 gradientA{0.0f};  ///< of the kernel over a, relative (PairFactor)
    base::Vec2 gradientB{0.0f};
    base::Vec2 shadowA{0.0f};  ///< part of the gradients that partial visibility adds, between elements
    base::Vec2 shadowB{0.0f};
    float spreadA = 0.0f;  ///< relative deviation of the kernel over a from the linear function
    float spreadB = 0.0f;
    bool isOpen = false;
    bool isBlocked = false;  ///< certain
    bool isMixed = false;
    std::uint16_t rays = 0;
    std::uint16_t evaluations = 0;
};

/// Computes batches of coefficients; the narrow interface that other machines can implement too. Pure:
/// results depend on the names of the pairs and the original objects only.
class CoefficientService {
  public:
    CoefficientService(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays,
                       ClusterModel model = ClusterModel::oriented, RayCount rayCount = RayCount::usual)
        : hierarchy_(hierarchy), rays_(rays), model_(model), rayCount_(rayCount) {}

    /// out.size() == queries.size(). Safe to call from several threads on disjoint spans.
    void compute(std::span<const Query> queries, std::span<Coefficient> out) const;

    /// Looks more closely at a partly blocked pair that stays as it is, if it is one of planar elements that
    /// touch and exchange much (contact_visibility.h): returns whether the coefficient was changed.
    bool settleContact(const Query& query, Coefficient& coefficient) const;

  private:
    Coefficient betweenElements(const Query& query) const;
    Coefficient withClusters(const Query& query) const;
    Coefficient fromSource(const Query& query) const;

    const hierarchy::Hierarchy& hierarchy_;
    const rays::RayScene& rays_;
    ClusterModel model_;
    RayCount rayCount_;
};

/// Largest visibility that k of n unblocked rays still allow: (k + 1) / (n + 2) and one standard deviation; 1
/// where none was blocked.
float visibilityUpperBound(float visibility, unsigned rays);

}  // namespace fluxwalk::transport
