#pragma once

#include "core/hierarchy/hierarchy.h"

/// What refinement asks of pairs with clusters.
namespace fluxwalk::solve {

/// Whether points stand for a cluster in its exchange with another node: clusters must be apart by their
/// spheres, an element, whose factor is exact, by its box.
bool areApart(const hierarchy::Hierarchy& h, base::NodeId a, base::NodeId b);

/// All that a pair could exchange, were nothing lost on the way, as an error in lux over the whole scene.
float boundExchange(const hierarchy::Hierarchy& h, base::NodeId a, base::NodeId b);

}  // namespace fluxwalk::solve
