#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/scene/lit_mesh.h"
#include "core/surface/region.h"

/// From leaves of the solution to arrays for the GPU: balanced, without T-vertices, smooth within an object's
/// creases.
namespace fluxwalk::display {

/// One leaf element of an object with its mean irradiance.
struct Leaf {
    std::uint32_t patch = 0;
    bool back = false;
    surface::Path path = surface::kRootPath;
    base::Rgb irradiance{0.0f};  ///< lux, each channel
};

struct MeshOptions {
    /// Vertex values are not averaged across edges whose faces' normals differ by more (radians).
    double creaseAngle = 0.5236;
};

/// Triangulates the leaves of one object: one mesh for each side that has leaves (front first). The leaves of
/// a patch and side must tile it. `object` and `material` are copied into the result.
std::vector<std::shared_ptr<const scene::LitMesh>> buildDisplayMeshes(const surface::Surface& surface,
                                                                      std::uint32_t object,
                                                                      std::uint32_t material,
                                                                      std::span<const Leaf> leaves,
                                                                      const MeshOptions& options);

}  // namespace fluxwalk::display
