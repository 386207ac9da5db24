#pragma once

#include "core/base/named_arrays.h"
#include "core/solve/state.h"

/// Nodes and links in a checkpoint.
namespace fluxwalk::solve {

void saveNodes(base::NamedArrays& arrays, const hierarchy::Hierarchy& h);
void saveLinks(base::NamedArrays& arrays, const hierarchy::LinkStore& store);
/// Pairs that wait to be split, within a level of refinement.
void savePending(base::NamedArrays& arrays, const std::vector<Decision>& pending);

/// Splits what was split, in the same order, so that nodes get the same places, shapes and names, and gives
/// them their light. Throws base::FileError.
void restoreNodes(Problem& problem, const base::ArrayReader& reader);
/// After restoreNodes; `isOrdered`: the level's refinement is over, and links with clusters stand first.
/// Throws base::FileError.
void restoreLinks(Problem& problem, const base::ArrayReader& reader, bool isOrdered);
/// After restoreNodes. Throws base::FileError.
void restorePending(Problem& problem, const base::ArrayReader& reader);

}  // namespace fluxwalk::solve
