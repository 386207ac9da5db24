#include "core/reference/shaded_scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/surface/region.h"

namespace fluxwalk::reference {

namespace {

using base::kPi;

// Uniform point of a patch's parameter domain, for two numbers in [0, 1).
Vec2d domainPoint(surface::PatchDomain domain, const Vec2d& random) {
    if (domain == surface::PatchDomain::quad) {
        return random;
    }
    return random.x + random.y <= 1.0 ? random : Vec2d(1.0) - random;
}

double domainArea(surface::PatchDomain domain) {
    return domain == surface::PatchDomain::quad ? 1.0 : 0.5;
}

bool isTextured(const scene::Material& material) {
    return material.reflectanceTexture.isSet() || material.emissionTexture.isSet();
}

bool isFlat(const surface::Surface& surface) {
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        if (!surface.isPlanar(patch)) {
            return false;
        }
    }
    return true;
}

}  // namespace

ShadedScene::ShadedScene(const scene::Scene& scene, const rays::RayScene& rays)
    : scene_(scene),
      rays_(rays),
      textures_(scene),
      planes_(scene.objects.size()),
      power_(scene.objects.size()) {
    double cumulative = 0.0;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const scene::Object& object = scene.objects[i];
        const scene::Material& material = scene.materials[object.material];
        if (!material.isEmissive()) {
            if (!isTextured(material) && isFlat(*object.surface)) {
                for (std::uint32_t patch = 0; patch < object.surface->patchCount(); ++patch) {
                    const surface::SurfacePoint p = object.surface->evaluate(patch, Vec2d(0.25));
                    planes_[i].push_back({p.normal, glm::dot(p.normal, p.position)});
                }
            }
            continue;
        }
        for (std::uint32_t patch = 0; patch < object.surface->patchCount(); ++patch) {
            const surface::Region whole = surface::wholePatch(object.surface->domain(patch));
            Rgb emission = material.emission;
            if (material.emissionTexture.isSet()) {
                // Some share stays with the dark parts: a texel that the mean overlooks can still be drawn.
                emission = 0.95f * scene::regionMaterial(scene, textures_, object, patch, whole).emission +
                           0.05f * emission;
            }
            const double sides = material.doubleSided ? 2.0 : 1.0;
            const double power =
                sides * object.surface->area(patch, whole) * static_cast<double>(base::channelMean(emission));
            cumulative += power;
            emitters_.push_back({i, patch, cumulative, addFlatEmitter(object, patch)});
            power_[i].push_back(power);
        }
    }
    guide_.resize(emitters_.size());
    std::uint32_t first = 0;
    for (std::size_t part = 0; part < guide_.size(); ++part) {
        const double before = cumulative * static_cast<double>(part) / static_cast<double>(guide_.size());
        while (first + 1 < emitters_.size() && emitters_[first].cumulative <= before) {
            ++first;
        }
        guide_[part] = first;
    }
}

// kNotFlat for what is curved, textured, or a quad whose area measure changes over it.
std::uint32_t ShadedScene::addFlatEmitter(const scene::Object& object, std::uint32_t patch) {
    const surface::Surface& surface = *object.surface;
    if (!surface.isPlanar(patch) || isTextured(scene_.materials[object.material])) {
        return kNotFlat;
    }
    const surface::SurfacePoint origin = surface.evaluate(patch, Vec2d(0.0));
    const surface::SurfacePoint atU = surface.evaluate(patch, Vec2d(1.0, 0.0));
    const surface::SurfacePoint atV = surface.evaluate(patch, Vec2d(0.0, 1.0));
    constexpr double kSame = 1e-9;
    if (std::abs(atU.jacobian - origin.jacobian) > kSame * origin.jacobian ||
        std::abs(atV.jacobian - origin.jacobian) > kSame * origin.jacobian) {
        return kNotFlat;
    }
    flatEmitters_.push_back({origin.position, atU.position - origin.position, atV.position - origin.position,
                             origin.normal, origin.jacobian * domainArea(surface.domain(patch))});
    return static_cast<std::uint32_t>(flatEmitters_.size() - 1);
}

SidePoint ShadedScene::at(std::uint32_t objectIndex, std::uint32_t patch, const Vec2d& uv, bool back) const {
    const scene::Object& object = scene_.objects[objectIndex];
    const scene::Material& material = scene_.materials[object.material];
    const surface::SurfacePoint point = object.surface->evaluate(patch, uv);
    SidePoint side;
    side.object = objectIndex;
    side.patch = patch;
    side.back = back;
    side.position = point.position;
    side.normal = back ? -point.normal : point.normal;
    side.measure = point.jacobian * domainArea(object.surface->domain(patch));
    side.reflectance = material.reflectance;
    side.emission = material.emission;
    if (isTextured(material)) {
        const scene::RegionMaterial here = scene::pointMaterial(scene_, textures_, object, patch, uv);
        side.reflectance = here.reflectance;
        side.emission = here.emission;
    }
    if (back && !material.doubleSided) {
        side.emission = Rgb(0.0f);
    }
    return side;
}

std::optional<SidePoint> ShadedScene::closest(const rays::Ray& ray) const {
    const std::optional<rays::Hit> hit = rays_.closest(ray);
    if (!hit) {
        return std::nullopt;
    }
    return at(ray, *hit);
}

SidePoint ShadedScene::at(const rays::Ray& ray, const rays::Hit& hit) const {
    const Vec3d position = Vec3d(ray.origin) + static_cast<double>(hit.t) * Vec3d(ray.direction);
    const std::uint32_t object = base::index(hit.object);
    if (!planes_[object].empty()) {
        const Plane& plane = planes_[object][hit.patch];
        SidePoint side;
        side.object = object;
        side.patch = hit.patch;
        side.back = hit.back;
        side.position = position - (glm::dot(plane.normal, position) - plane.offset) * plane.normal;
        side.normal = hit.back ? -plane.normal : plane.normal;
        side.reflectance = scene_.materials[scene_.objects[object].material].reflectance;
        return side;
    }
    return at(object, hit.patch, scene_.objects[object].surface->locate(hit.patch, position), hit.back);
}

SidePoint ShadedScene::sampleEmitter(base::RandomStream& random) const {
    FLUXWALK_CHECK(hasEmissivePatches());
    const double place = random.next();
    const double choice = place * emitters_.back().cumulative;
    std::size_t i = guide_[static_cast<std::size_t>(place * static_cast<double>(guide_.size()))];
    while (i + 1 < emitters_.size() && choice >= emitters_[i].cumulative) {
        ++i;
    }
    const Emitter& emitter = emitters_[i];
    const scene::Object& object = scene_.objects[emitter.object];
    const Vec2d uv = domainPoint(object.surface->domain(emitter.patch), random.next2());
    if (emitter.flat == kNotFlat) {
        return at(emitter.object, emitter.patch, uv, false);
    }
    const FlatEmitter& flat = flatEmitters_[emitter.flat];
    const scene::Material& material = scene_.materials[object.material];
    return {emitter.object,
            emitter.patch,
            false,
            flat.origin + uv.x * flat.alongU + uv.y * flat.alongV,
            flat.normal,
            flat.measure,
            material.reflectance,
            material.emission};
}

double ShadedScene::emitterProbability(std::uint32_t object, std::uint32_t patch) const {
    return power_[object].empty() ? 0.0 : power_[object][patch] / emitters_.back().cumulative;
}

Vec3d cosineDirection(const Vec3d& normal, const Vec2d& random) {
    // Branchless frame (Duff et al. 2017).
    const double sign = std::copysign(1.0, normal.z);
    const double a = -1.0 / (sign + normal.z);
    const double b = normal.x * normal.y * a;
    const Vec3d tangent(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const Vec3d bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    const double radius = std::sqrt(random.x);
    const double phi = 2.0 * kPi * random.y;
    return radius * std::cos(phi) * tangent + radius * std::sin(phi) * bitangent +
           std::sqrt(std::max(0.0, 1.0 - random.x)) * normal;
}

}  // namespace fluxwalk::reference
