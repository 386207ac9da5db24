#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace fluxwalk::hierarchy {

using base::NodeId;

/// Relative uncertainty in one byte: 2^((code - 160) / 8), from 1e-6 to 3700; 0 stands for none.
class UncertaintyCode {
  public:
    static std::uint8_t encode(float relative) {
        if (!(relative > 1e-6f)) {
            return 0;
        }
        const float code = std::ceil(8.0f * std::log2(relative)) + 160.0f;
        return static_cast<std::uint8_t>(std::clamp(code, 1.0f, 255.0f));
    }
    static float decode(std::uint8_t code) {
        return code == 0 ? 0.0f : std::exp2((static_cast<float>(code) - 160.0f) / 8.0f);
    }
};

/// Relative gradient of a kernel over an element in one byte for each direction. Where elements touch it
/// reaches 8 over triangles; what is cut off does not cancel where all is uniform.
struct GradientCode {
    static constexpr float kLargest = 8.0f;

    std::int8_t s = 0;
    std::int8_t t = 0;

    static GradientCode encode(const base::Vec2& gradient) {
        const auto code = [](float g) {
            return static_cast<std::int8_t>(
                std::lround(std::clamp(g, -kLargest, kLargest) * (127.0f / kLargest)));
        };
        return {code(gradient.x), code(gradient.y)};
    }
    base::Vec2 decode() const {
        return base::Vec2(static_cast<float>(s), static_cast<float>(t)) * (kLargest / 127.0f);
    }
};

/// Transport between an unordered pair of nodes: one symmetric coefficient serves both directions, so
/// reciprocity is exact. H_a += coupling * visibility * B_b / A_a and the other way round, A being exposed
/// areas. Where `b` is a light source without area, coupling is A_a times the mean over `a` of cos / r2 (or
/// cos, or the view of the sky) and there is no way back. Clusters share what they send and receive among
/// their patches (transport/cluster_factor.h); their gradients are 0.
struct Link {
    NodeId a{};
    NodeId b{};
    float coupling = 0.0f;  ///< unoccluded g = A_a F(a<-b) in m2, between the exposed parts
    /// Visibility in 1/32767 steps; the top bit marks it as certain (an empty shaft).
    std::uint16_t visibilityBits = 0;
    std::uint8_t spreadA =
        0;  ///< UncertaintyCode: deviation of F(x<-b) over a from a linear function, relative
    std::uint8_t spreadB = 0;
    GradientCode gradientA;  ///< of F(x<-b) over a in its local frame: ends are linear (ALGORITHMS 2.2)
    GradientCode gradientB;

    float visibility() const { return static_cast<float>(visibilityBits & 0x7fffu) * (1.0f / 32767.0f); }
    bool isOpen() const { return (visibilityBits & 0x8000u) != 0; }
    void setVisibility(float visibility, bool open) {
        const auto steps = static_cast<std::uint16_t>(std::lround(visibility * 32767.0f));
        visibilityBits = static_cast<std::uint16_t>(steps | (open ? 0x8000u : 0u));
    }
    /// Coupling of the light that arrives.
    float transfer() const { return coupling * visibility(); }
};
static_assert(sizeof(Link) == 20);

/// Links and, for each node, those that end at it.
class LinkStore {
  public:
    std::vector<Link> links;
    /// Of these, the first ones have a cluster at one end or at both.
    std::size_t clusterLinks = 0;

    /// Rebuilds the lists of ends after `links` changed.
    void index(std::size_t nodeCount);

    /// Indices into `links` of all links that end at a node, in the order of `links`.
    std::span<const std::uint32_t> endingAt(NodeId id) const {
        const std::size_t i = base::index(id);
        return {ends_.data() + first_[i], first_[i + 1] - first_[i]};
    }
    /// Bytes of the links themselves and of the lists.
    std::size_t bytes() const;

  private:
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> ends_;
};

}  // namespace fluxwalk::hierarchy
