#include "core/io/lit_colors.h"

#include <algorithm>

#include "core/base/photometry.h"
#include "core/io/lit_gltf.h"

namespace fluxwalk::io {

namespace {

using base::Rgb;
using base::Vec2d;

/// What chooseExposure aims at: this part of the area is at most this bright.
constexpr double kPercentile = 0.95;
constexpr float kBrightness = 0.9f;

Rgb sampleAt(const scene::TextureSet& textures, const scene::TextureRef& texture, const scene::LitMesh& mesh,
             std::size_t vertex) {
    const std::vector<base::Vec2>& texcoords = mesh.texcoords[texture.texcoordSet];
    return Rgb(textures.sample(texture, texcoords.empty() ? Vec2d(0.0) : Vec2d(texcoords[vertex])));
}

}  // namespace

std::vector<Rgb> vertexExitance(const scene::Scene& scene, const scene::TextureSet& textures,
                                const scene::LitMesh& mesh, bool withTexture) {
    const scene::Material& material = scene.materials[mesh.material];
    const bool emits = material.isEmissive() && (!mesh.back || material.doubleSided);
    std::vector<Rgb> exitance;
    exitance.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        Rgb reflectance = material.reflectance;
        if (withTexture && material.reflectanceTexture.isSet()) {
            reflectance *= sampleAt(textures, material.reflectanceTexture, mesh, i);
        }
        Rgb& here = exitance.emplace_back(mesh.irradiance[i] * reflectance);
        if (emits) {
            here += material.emission * sampleAt(textures, material.emissionTexture, mesh, i);
        }
    }
    return exitance;
}

float chooseExposure(const scene::Scene& scene, const scene::LitMeshes& meshes) {
    const scene::TextureSet textures(scene);
    struct Share {
        float exitance;
        double area;
    };
    std::vector<Share> shares;
    double total = 0.0;
    for (const auto& mesh : meshes) {
        const std::vector<Rgb> exitance = vertexExitance(scene, textures, *mesh, true);
        for (std::size_t i = 0; i + 2 < mesh->triangles.size(); i += 3) {
            const std::uint32_t* t = mesh->triangles.data() + i;
            const base::Vec3d a(mesh->positions[t[0]]);
            const base::Vec3d b(mesh->positions[t[1]]);
            const base::Vec3d c(mesh->positions[t[2]]);
            const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
            const Rgb mean = (exitance[t[0]] + exitance[t[1]] + exitance[t[2]]) * (1.0f / 3.0f);
            shares.push_back({base::luminance(mean), area});
            total += area;
        }
    }
    std::sort(shares.begin(), shares.end(),
              [](const Share& a, const Share& b) { return a.exitance < b.exitance; });
    double below = 0.0;
    for (const Share& share : shares) {
        below += share.area;
        // A scene darker than its percentile is exposed for the first thing that is not black.
        if (below >= kPercentile * total && share.exitance > 0.0f) {
            return kBrightness / share.exitance;
        }
    }
    return 1.0f;
}

}  // namespace fluxwalk::io
