#pragma once

#include "core/display/display_mesh.h"
#include "core/display/leaf_light.h"

namespace fluxwalk::display {

/// Display meshes whose vertices have irradiance that was found at their points, where some was: cells are
/// cut as the leaves' light asks for, balanced, and cut on for the eye.
///
/// `lights` is parallel to `leaves`, nullptr for a leaf whose light is not known: its vertices have what
/// buildDisplayMeshes() gives them, but those that it shares with a leaf that is known. A vertex has the mean
/// of what the leaves about it found, where no crease is between; hidden ones that of the nearest that are
/// not, so that no solid that stands on a face casts a dark rim around itself. Does not depend on the leaves'
/// order. The layouts stay empty.
DisplayMeshes buildGatheredMeshes(const PatchTopology& topology, std::uint32_t object, std::uint32_t material,
                                  std::span<const Leaf> leaves, std::span<const LeafLight* const> lights,
                                  const MeshOptions& options);

}  // namespace fluxwalk::display
