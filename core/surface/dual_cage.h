#pragma once

#include <memory>
#include <optional>

#include "core/surface/projected_surface.h"
#include "core/surface/smooth_union.h"

namespace fluxwalk::surface {

/// Closed manifold cage of quads about a smooth union: the dual faces of a grid of cubes (one vertex for each
/// cube that the surface passes), evened out on the surface. The grid is the coarsest of those tried from
/// which every lattice point of every face comes onto the object along a ray; none where 24 cubes along the
/// longest side do not suffice, as where balls only just touch.
std::optional<Cage> buildDualCage(const std::shared_ptr<const SmoothUnion>& object);

}  // namespace fluxwalk::surface
