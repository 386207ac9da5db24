#pragma once

#include <span>

#include "core/display/cell.h"
#include "core/display/display_mesh.h"

/// What the makers of display meshes have in common.
namespace fluxwalk::display {

/// Order of the leaves of an object: front before back, then by patch, then depth-first.
bool comesBefore(const Leaf& a, const Leaf& b);

/// The leaves of each patch of one side, in order, must follow each other without gap or overlap.
void checkTiling(std::span<const Leaf> leaves);

CellTable makeTable(std::span<const Cell> cells, std::uint32_t patchCount,
                    std::vector<std::uint32_t> firstTriangle);

/// Meshes stay for long: room that was reserved for the worst case is given back.
void shrink(scene::LitMesh& mesh);

}  // namespace fluxwalk::display
