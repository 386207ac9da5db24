#pragma once

#include "core/transport/kernel_bounds.h"

namespace fluxwalk::transport {

/// What a pair certainly exchanges, at least and at most, without occlusion.
struct PairBounds {
    FactorBounds atA{0.0, 0.0};  ///< of F(x<-b) for all x of a; where b has no area, of cos / r2 or the like
    FactorBounds atB{0.0, 0.0};  ///< of F(x<-a) for all x of b; 0 where b has no area
};

/// `a` is an element, `b` another one, a light source or the sky. Which parts of an element are hidden in
/// other solids was sampled, so a partly hidden one may send nothing.
PairBounds boundPair(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b);

}  // namespace fluxwalk::transport
