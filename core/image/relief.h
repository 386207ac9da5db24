#pragma once

#include "core/scene/texture.h"

/// Normals of surfaces that a normal map or a height map gives a finer shape than their geometry has.
namespace fluxwalk::image {

/// Whether the material has such a map.
bool hasRelief(const scene::Material& material);

/// Unit normal of the front side at (u,v) of a patch, turned by the material's normal map (glTF: x along the
/// texture's u, y against its v) and then by its height map, whose white stands Material::bumpHeight metres
/// above its black. `normal` is the surface's own there.
base::Vec3d findReliefNormal(const scene::Scene& scene, const scene::TextureSet& textures,
                             const scene::Object& object, std::uint32_t patch, const base::Vec2d& uv,
                             const base::Vec3d& normal);

}  // namespace fluxwalk::image
