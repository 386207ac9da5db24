#include "tests/viewer/test_room.h"

#include <cmath>

#include "core/base/photometry.h"
#include "viewer/render/camera.h"

namespace fluxwalk::testing {
namespace {

using base::Rgb;
using base::Vec3;

constexpr Vec3 kLampCenter{0.0f, 1.98f, 0.0f};
constexpr float kLampHalf = 0.3f;

/// Irradiance in lux of a small lamp that faces down, and of the light that went around the room.
Rgb irradianceAt(const Vec3& position, const Vec3& normal) {
    const Vec3 toLamp = kLampCenter - position;
    const float distance2 = glm::dot(toLamp, toLamp) + 0.02f;
    const Vec3 direction = toLamp / std::sqrt(distance2);
    const float atPoint = std::max(0.0f, glm::dot(direction, normal));
    const float atLamp = std::max(0.0f, direction.y);
    const Rgb redBounce = Rgb(6.0f, 1.5f, 1.0f) * std::exp(-1.2f * (position.x + 1.0f));
    const Rgb greenBounce = Rgb(1.0f, 5.0f, 1.2f) * std::exp(-1.2f * (1.0f - position.x));
    return Rgb(170.0f, 150.0f, 120.0f) * (atPoint * atLamp / distance2) + Rgb(14.0f, 13.0f, 11.0f) +
           redBounce + greenBounce;
}

void light(scene::LitMesh& mesh) {
    mesh.irradiance.clear();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.irradiance.push_back(irradianceAt(mesh.positions[i], mesh.normals[i]));
    }
}

scene::Image makeCheckers() {
    scene::Image image;
    image.name = "checkers";
    image.width = image.height = 64;
    for (std::uint32_t y = 0; y < 64; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const bool isDark = (x / 8 + y / 8) % 2 == 1;
            const std::uint8_t alpha = (x / 8) % 2 == 0 ? 255 : 40;
            const auto ramp = static_cast<std::uint8_t>(2 * x);
            image.rgba.insert(image.rgba.end(),
                              {static_cast<std::uint8_t>(isDark ? 70 : 230),
                               static_cast<std::uint8_t>(isDark ? 60 + ramp / 2 : 220),
                               static_cast<std::uint8_t>(isDark ? 50 : 200 - ramp / 3), alpha});
        }
    }
    return image;
}

scene::Material makeMaterial(const char* name, const Rgb& reflectance) {
    scene::Material material;
    material.name = name;
    material.reflectance = reflectance;
    return material;
}

}  // namespace

scene::LitMesh makeQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::uint32_t cells) {
    scene::LitMesh mesh;
    const Vec3 normal = glm::normalize(glm::cross(b - a, d - a));
    for (std::uint32_t j = 0; j <= cells; ++j) {
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(cells);
            const float v = static_cast<float>(j) / static_cast<float>(cells);
            mesh.positions.push_back((1.0f - v) * ((1.0f - u) * a + u * b) + v * ((1.0f - u) * d + u * c));
            mesh.normals.push_back(normal);
            mesh.texcoords[0].emplace_back(u, 1.0f - v);
            mesh.irradiance.emplace_back(0.0f);
        }
    }
    const std::uint32_t row = cells + 1;
    for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t k = j * row + i;
            mesh.triangles.insert(mesh.triangles.end(), {k, k + 1, k + row + 1, k, k + row + 1, k + row});
        }
    }
    return mesh;
}

TestRoom makeTestRoom(bool textured) {
    auto scene = std::make_shared<scene::Scene>();
    scene->name = "test room";
    scene->materials = {makeMaterial("white", Rgb(0.75f)),
                        makeMaterial("red", {0.63f, 0.06f, 0.05f}),
                        makeMaterial("green", {0.14f, 0.45f, 0.09f}),
                        makeMaterial("lamp", Rgb(0.5f)),
                        makeMaterial("floor", Rgb(0.9f)),
                        makeMaterial("fence", Rgb(0.8f))};
    scene->materials[3].emission = Rgb(700.0f, 600.0f, 450.0f);
    scene->images.push_back(makeCheckers());
    if (textured) {
        scene::TextureRef& texture = scene->materials[4].reflectanceTexture;
        texture.image = 0;
        texture.scale = {2.0f, 2.0f};
        texture.rotation = 0.4f;
        texture.offset = {0.1f, 0.2f};
        texture.wrapU = scene::Wrap::mirror;
        scene->materials[5].reflectanceTexture.image = 0;
        scene->materials[5].alphaMode = scene::AlphaMode::mask;
    }

    TestRoom room;
    const auto add = [&](scene::LitMesh mesh, std::uint32_t material) {
        mesh.material = material;
        mesh.object = static_cast<std::uint32_t>(room.meshes.size());
        light(mesh);
        room.meshes.push_back(std::make_shared<const scene::LitMesh>(std::move(mesh)));
    };
    constexpr std::uint32_t kCells = 24;
    const float l = -1.0f;
    const float r = 1.0f;
    add(makeQuad({l, 0, r}, {r, 0, r}, {r, 0, l}, {l, 0, l}, kCells), 4);
    add(makeQuad({l, 2, l}, {r, 2, l}, {r, 2, r}, {l, 2, r}, kCells), 0);
    add(makeQuad({l, 0, l}, {r, 0, l}, {r, 2, l}, {l, 2, l}, kCells), 0);
    add(makeQuad({l, 0, r}, {l, 0, l}, {l, 2, l}, {l, 2, r}, kCells), 1);
    add(makeQuad({r, 0, l}, {r, 0, r}, {r, 2, r}, {r, 2, l}, kCells), 2);
    const float y = kLampCenter.y;
    const float h = kLampHalf;
    add(makeQuad({-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}, 1), 3);
    if (textured) {
        add(makeQuad({-0.5f, 0, 0}, {0.5f, 0, 0}, {0.5f, 0.7f, 0}, {-0.5f, 0.7f, 0}, 8), 5);
    }
    room.scene = std::move(scene);
    room.camera = render::lookAt({0.0, 1.0, 4.2}, {0.0, 1.0, 0.0}, 36.0);
    return room;
}

}  // namespace fluxwalk::testing
