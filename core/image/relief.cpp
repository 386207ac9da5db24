#include "core/image/relief.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fluxwalk::image {

namespace {

using base::Vec2d;
using base::Vec3d;

/// Step in a patch's parameters over which places of the texture are compared.
constexpr double kStep = 1e-4;
/// Normals are turned by less than a right angle: the least cosine left.
constexpr double kLeastCosine = 0.02;

/// How places move on a surface with the coordinates of its texture, in metres.
struct TextureFrame {
    Vec3d alongU{};
    Vec3d alongV{};
};

std::optional<TextureFrame> frameAt(const surface::Surface& surface, std::uint32_t patch, const Vec2d& uv,
                                    unsigned set) {
    // Inwards, so that the steps stay in the domain of quads and of triangles.
    const Vec2d stepU(uv.x > 0.5 ? -kStep : kStep, 0.0);
    Vec2d stepV(0.0, uv.y > 0.5 ? -kStep : kStep);
    if (surface.domain(patch) == surface::PatchDomain::triangle && uv.x + uv.y > 0.5) {
        stepV.y = uv.y > kStep ? -kStep : kStep;
    }
    const Vec3d here = surface.evaluate(patch, uv).position;
    const Vec2d texture = surface.texcoord(patch, uv, set);
    const Vec3d p = surface.evaluate(patch, uv + stepU).position - here;
    const Vec3d q = surface.evaluate(patch, uv + stepV).position - here;
    const Vec2d a = surface.texcoord(patch, uv + stepU, set) - texture;
    const Vec2d b = surface.texcoord(patch, uv + stepV, set) - texture;
    const double determinant = a.x * b.y - a.y * b.x;
    if (!(std::abs(determinant) > 1e-6 * (glm::dot(a, a) + glm::dot(b, b)))) {
        return std::nullopt;
    }
    return TextureFrame{(b.y * p - a.y * q) / determinant, (a.x * q - b.x * p) / determinant};
}

// `turned`, or as much of the turn away from `normal` as leaves it on the same side.
Vec3d keepSide(const Vec3d& turned, const Vec3d& normal) {
    const Vec3d unit = glm::normalize(turned);
    const double cosine = glm::dot(unit, normal);
    return cosine >= kLeastCosine ? unit : glm::normalize(unit + (kLeastCosine - cosine) * normal);
}

Vec3d applyNormalMap(const scene::Material& material, const scene::TextureSet& textures,
                     const TextureFrame& frame, const Vec2d& texcoord, const Vec3d& normal) {
    const base::Vec4 value = textures.sampleNumbers(material.normalTexture, texcoord);
    const Vec3d stored = 2.0 * Vec3d(value) - Vec3d(1.0);
    const Vec3d across = frame.alongU - glm::dot(frame.alongU, normal) * normal;
    const Vec3d upwards = -(frame.alongV - glm::dot(frame.alongV, normal) * normal);
    const auto scale = static_cast<double>(material.normalScale);
    const Vec3d turned = scale * stored.x * glm::normalize(across) +
                         scale * stored.y * glm::normalize(upwards) + std::max(stored.z, 1e-3) * normal;
    return keepSide(turned, normal);
}

Vec3d applyHeightMap(const scene::Scene& scene, const scene::Material& material,
                     const scene::TextureSet& textures, const TextureFrame& frame, const Vec2d& texcoord,
                     const Vec3d& normal, const Vec3d& base) {
    const scene::TextureRef& texture = material.bumpTexture;
    const scene::Image& image = scene.images[static_cast<std::size_t>(texture.image)];
    // One texel, in coordinates before the transform.
    const Vec2d texel =
        Vec2d(1.0 / (image.width * std::max(1e-6, std::abs(static_cast<double>(texture.scale.x)))),
              1.0 / (image.height * std::max(1e-6, std::abs(static_cast<double>(texture.scale.y)))));
    const auto heightAt = [&](double u, double v) {
        return static_cast<double>(material.bumpHeight) *
               static_cast<double>(textures.sampleNumbers(texture, texcoord + Vec2d(u, v)).r);
    };
    const double riseU = (heightAt(0.5 * texel.x, 0.0) - heightAt(-0.5 * texel.x, 0.0)) / texel.x;
    const double riseV = (heightAt(0.0, 0.5 * texel.y) - heightAt(0.0, -0.5 * texel.y)) / texel.y;
    const double volume = glm::dot(normal, glm::cross(frame.alongU, frame.alongV));
    if (!(std::abs(volume) > 0.0)) {
        return base;
    }
    const Vec3d slope =
        (riseU * glm::cross(frame.alongV, normal) + riseV * glm::cross(normal, frame.alongU)) / volume;
    return keepSide(base - slope, normal);
}

}  // namespace

bool hasRelief(const scene::Material& material) {
    return material.normalTexture.isSet() || material.bumpTexture.isSet();
}

Vec3d findReliefNormal(const scene::Scene& scene, const scene::TextureSet& textures,
                       const scene::Object& object, std::uint32_t patch, const Vec2d& uv,
                       const Vec3d& normal) {
    const scene::Material& material = scene.materials[object.material];
    Vec3d result = normal;
    if (material.normalTexture.isSet()) {
        const unsigned set = material.normalTexture.texcoordSet;
        if (const auto frame = frameAt(*object.surface, patch, uv, set)) {
            result =
                applyNormalMap(material, textures, *frame, object.surface->texcoord(patch, uv, set), normal);
        }
    }
    if (material.bumpTexture.isSet()) {
        const unsigned set = material.bumpTexture.texcoordSet;
        if (const auto frame = frameAt(*object.surface, patch, uv, set)) {
            result = applyHeightMap(scene, material, textures, *frame,
                                    object.surface->texcoord(patch, uv, set), normal, result);
        }
    }
    return result;
}

}  // namespace fluxwalk::image
