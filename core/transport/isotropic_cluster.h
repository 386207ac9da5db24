#pragma once

#include "core/transport/form_factor.h"

/// Clusters as volumes (Sillion 1995): surfaces of all directions, evenly spread. From any side a cluster
/// shows a quarter of its area (but no more than its bounding sphere does), what it receives is spread over
/// all its patches alike, and what lies between two nodes dims light like a fog. For comparison, and where
/// speed counts more than the light of single surfaces.
namespace fluxwalk::transport {

/// Exchange of a pair of which at least one is a cluster, fog left out. Spreads are those that surfaces of
/// random directions have: twice the mean deviation from the even share, relative to the mean.
PairFactor computeIsotropicFactor(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b);

/// Part of the light that passes along the line between the centres of two nodes: exp(-sum of extinction
/// times length) over the clusters and patches on it, extinction being a quarter of the exposed area over the
/// volume of the box, in 1/m. Taken as a whole are the ends, as far as they are clusters, and clusters of at
/// most half the larger end's size that hold neither; an end that is an element is no fog. Walls are fog too
/// and let light through, which the oriented model does not.
float attenuate(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b);

}  // namespace fluxwalk::transport
