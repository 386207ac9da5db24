#pragma once

#include <filesystem>

#include "core/scene/lit_mesh.h"
#include "core/scene/scene.h"

namespace fluxwalk::io {

/// How the lit mesh's colours were exposed: COLOR_0 = min(1, exposure * reflected or emitted exitance),
/// linear.
struct LitExport {
    float exposure = 1.0f;  ///< per lm/m2
};

/// Exposure that maps the 95th percentile (by area) of the meshes' exitance to 0.9.
float chooseExposure(const scene::Scene& scene, const scene::LitMeshes& meshes);

/// Writes the lit mesh as .glb (DESIGN section 5): unlit vertex colours any viewer shows, true lux in
/// _IRRADIANCE. Written beside and renamed. Throws base::FileError.
void writeLitGltf(const std::filesystem::path& file, const scene::Scene& scene,
                  const scene::LitMeshes& meshes, const LitExport& settings);

/// A lit file to walk in: its scene (materials, cameras) and its meshes.
struct LitFile {
    scene::Scene scene;
    scene::LitMeshes meshes;
    LitExport settings;
};
/// Whether a file was written by writeLitGltf; false also where it cannot be read.
bool isLitGltf(const std::filesystem::path& file);
/// Objects come back as polygon meshes of their displayed triangles. Lights without area, and the reflectance
/// textures of emissive materials (their mean is kept), do not come back. Throws base::FileError.
LitFile readLitGltf(const std::filesystem::path& file);

}  // namespace fluxwalk::io
