#pragma once

#include <vector>

#include "core/surface/bezier_piece.h"
#include "core/surface/control_cage.h"

namespace fluxwalk::surface {

/// A polynomial piece of a patch's limit surface: a part of the patch's domain that `depth` quarterings lead
/// to, and the map from the piece's own coordinates to the patch's.
struct LimitPiece {
    std::uint32_t patch = 0;
    unsigned depth = 0;
    ParameterMap map;
    BezierPiece bezier;
};

/// The limit surface of a sound cage in pieces. Patches are the cage's faces in order; in the Catmull-Clark
/// scheme a face of n != 4 corners is n patches, the k-th with corners at vertex k, the middle of the edge to
/// the next one, the middle of the face, and the middle of the edge before.
///
/// Away from extraordinary vertices the pieces are the limit surface itself. Around those they are exact down
/// to 2^-10 of the face; the rest is capped by one cubic (quartic) with the surface's own boundary curves,
/// limit point and tangents (a Gregory patch whose inner points are averaged), within 1e-5 of the length of
/// the face's edges.
std::vector<LimitPiece> findLimitPieces(const ControlCage& cage);

}  // namespace fluxwalk::surface
