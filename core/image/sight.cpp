#include "core/image/sight.h"

#include <cmath>
#include <limits>

#include "core/base/photometry.h"
#include "core/image/relief.h"
#include "core/solve/point_gather.h"

namespace fluxwalk::image {

Lens::Lens(const scene::Camera& camera, std::uint32_t width, std::uint32_t height) : eye_(camera.position) {
    const Vec3d forward = glm::normalize(camera.forward);
    const Vec3d right = glm::normalize(glm::cross(forward, camera.up));
    const Vec3d up = glm::cross(right, forward);
    const double high = std::tan(0.5 * camera.verticalFov);
    const double pixel = 2.0 * high / height;
    right_ = pixel * right;
    down_ = -pixel * up;
    corner_ = forward - 0.5 * width * right_ - 0.5 * height * down_;
}

Vec3d Lens::directionAt(const base::Vec2d& pixel) const {
    return glm::normalize(corner_ + pixel.x * right_ + pixel.y * down_);
}

std::optional<Seen> lookAlong(const solve::Problem& problem, const Vec3d& eye, const Vec3d& direction) {
    const rays::Ray ray{base::Vec3(eye), 0.0f, base::Vec3(direction), std::numeric_limits<float>::max()};
    const auto hit = problem.rays.closest(ray);
    if (!hit) {
        return std::nullopt;
    }
    const scene::Scene& scene = *problem.scene;
    const hierarchy::Hierarchy& h = problem.hierarchy;
    Seen seen;
    seen.object = base::index(hit->object);
    const scene::Object& object = scene.objects[seen.object];
    const scene::Material& material = scene.materials[object.material];
    const Vec3d met = Vec3d(ray.origin) + static_cast<double>(hit->t) * Vec3d(ray.direction);
    const base::Vec2d uv = object.surface->locate(hit->patch, met);
    const surface::SurfacePoint p = object.surface->evaluate(hit->patch, uv);
    const double side = hit->back ? -1.0 : 1.0;
    seen.point.position = p.position;
    seen.point.normal = side * p.normal;
    seen.point.shading = seen.point.normal;
    seen.hasRelief = hasRelief(material);
    if (seen.hasRelief) {
        seen.point.shading = side * findReliefNormal(scene, h.textures(), object, hit->patch, uv, p.normal);
    }
    seen.leaf = solve::findLeaf(problem, seen.object, hit->patch, hit->back, uv).value_or(NodeId::none);
    seen.hasTexture = material.reflectanceTexture.isSet() || material.emissionTexture.isSet();
    const scene::RegionMaterial here = scene::pointMaterial(scene, h.textures(), object, hit->patch, uv);
    seen.reflectance = here.reflectance;
    if (!hit->back || material.doubleSided) {
        seen.emission = here.emission * h.lighting().ofMaterial(object.material);
    }
    return seen;
}

Rgb skyLuminance(const solve::Problem& problem, const Vec3d& direction) {
    if (direction.y <= 0.0) {
        return Rgb(0.0f);
    }
    return problem.scene->sky * problem.hierarchy.lighting().sky * static_cast<float>(1.0 / base::kPi);
}

}  // namespace fluxwalk::image
