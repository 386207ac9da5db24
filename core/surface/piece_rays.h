#pragma once

#include "core/surface/piece_tree.h"

namespace fluxwalk::surface {

/// First point of the surface on the ray with t in (tNear, tFar). No ray passes between pieces: each reaches
/// over its border by 1e-7 of a facet. A ray that touches the surface without crossing it, within 1e-10 of
/// the surface's size, may count as meeting it.
std::optional<SurfaceHit> intersectPieces(const PieceTree& tree, const Vec3d& origin, const Vec3d& direction,
                                          double tNear, double tFar);

}  // namespace fluxwalk::surface
