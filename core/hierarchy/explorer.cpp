#include "core/hierarchy/explorer.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/surface/region.h"

namespace fluxwalk::hierarchy {

using base::Vec2d;
using base::Vec3d;

namespace {

/// Of an emitter's patches, one in so many is looked at.
constexpr unsigned kEmitterTurns = 512;

}  // namespace

Vec3d cosineDirection(const Vec3d& n, const Vec2d& u) {
    const double radius = std::sqrt(u.x);
    const double angle = 2.0 * base::kPi * u.y;
    const Vec3d helper = std::abs(n.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d t = glm::normalize(glm::cross(n, helper));
    return radius * std::cos(angle) * t + radius * std::sin(angle) * glm::cross(n, t) +
           std::sqrt(std::max(0.0, 1.0 - u.x)) * n;
}

Explorer::Explorer(const scene::Scene& scene, const rays::RayScene& rays) : scene_(scene), rays_(rays) {
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.materials[scene.objects[i].material].isEmissive() &&
            scene.objects[i].surface->patchCount() > 0) {
            emitters_.push_back(i);
        }
    }
}

bool Explorer::emits(std::uint32_t object, bool back) const {
    const scene::Material& material = scene_.materials[scene_.objects[object].material];
    return material.isEmissive() && (!back || material.doubleSided);
}

Stand Explorer::stand(std::uint32_t object, bool back, unsigned turn, unsigned turns,
                      base::RandomStream& random) const {
    const surface::Surface& surface = *scene_.objects[object].surface;
    const std::uint32_t patches = surface.patchCount();
    const auto patch = static_cast<std::uint32_t>(
        patches <= turns ? turn % patches : static_cast<std::uint64_t>(turn) * patches / turns);
    const surface::Region whole = surface::wholePatch(surface.domain(patch));
    const surface::SurfacePoint p = surface.evaluate(patch, surface::mapToRegion(whole, random.next2()).uv);
    return {p.position, back ? -p.normal : p.normal};
}

Explorer::Step Explorer::step(const Stand& from, const Vec3d& direction) const {
    Step s;
    const auto hit = rays_.closest(rays_.halfLine(from.position, from.normal, direction));
    if (!hit) {
        s.escaped = true;
        s.escapedUp = direction.y > 0.0;
        return s;
    }
    s.object = base::index(hit->object);
    s.patch = hit->patch;
    s.back = hit->back;
    const surface::Surface& surface = *scene_.objects[s.object].surface;
    const Vec3d met = from.position + static_cast<double>(hit->t) * direction;
    const surface::SurfacePoint p = surface.evaluate(hit->patch, surface.locate(hit->patch, met));
    s.at = {p.position, s.back ? -p.normal : p.normal};
    return s;
}

bool Explorer::seesEmitter(const Stand& at, base::RandomStream& random) const {
    for (const scene::Light& light : scene_.lights) {
        const bool isDirectional = light.kind == scene::LightKind::directional;
        const Vec3d d = isDirectional ? -light.direction : light.position - at.position;
        if (!isDirectional && scene::intensityToward(light, -glm::normalize(d)) == base::Rgb(0.0f)) {
            continue;
        }
        if (glm::dot(at.normal, d) > 0.0 &&
            !rays_.isOccluded(isDirectional
                                  ? rays_.halfLine(at.position, at.normal, d)
                                  : rays_.segment(at.position, at.normal, light.position, Vec3d(0.0)))) {
            return true;
        }
    }
    if (emitters_.empty()) {
        return false;
    }
    const auto pick = static_cast<std::size_t>(random.next() * static_cast<double>(emitters_.size()));
    const std::uint32_t object = emitters_[pick];
    const auto turn = static_cast<unsigned>(random.next() * kEmitterTurns);
    Stand lamp = stand(object, false, turn, kEmitterTurns, random);
    const Vec3d d = lamp.position - at.position;
    if (glm::dot(lamp.normal, d) > 0.0 && emits(object, true)) {
        lamp.normal = -lamp.normal;
    }
    return glm::dot(at.normal, d) > 0.0 && glm::dot(lamp.normal, d) < 0.0 &&
           !rays_.isOccluded(rays_.segment(at.position, at.normal, lamp.position, lamp.normal));
}

}  // namespace fluxwalk::hierarchy
