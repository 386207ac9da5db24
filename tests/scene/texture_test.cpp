#include "core/scene/texture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"

namespace fluxwalk {
namespace {

using base::Rgb;
using base::Vec2d;
using base::Vec4;

float linear(int byte) {
    return static_cast<float>(base::linearFromSrgb(byte / 255.0));
}

scene::Image greyImage(std::uint32_t width, std::uint32_t height, const std::vector<int>& greys) {
    scene::Image image{"grey", width, height, {}};
    for (const int g : greys) {
        const auto byte = static_cast<std::uint8_t>(g);
        image.rgba.insert(image.rgba.end(), {byte, byte, byte, 255});
    }
    return image;
}

/// A square of side 2 in the plane z = 0 with texture coordinates 0 to 1 (v downwards), of one material.
class Textures : public testing::Test {
  protected:
    Textures() {
        surface::TriangleSoup soup;
        soup.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
        soup.triangles = {{0, 1, 2}, {0, 2, 3}};
        soup.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        scene_.objects.push_back({"square", std::make_shared<surface::PolygonMesh>(soup), 0});
        scene_.materials.emplace_back();
        scene_.materials[0].reflectance = Rgb(1.0f);
    }

    void useImage(scene::Image image) {
        scene_.images = {std::move(image)};
        scene_.materials[0].reflectanceTexture.image = 0;
    }
    scene::RegionMaterial regionAt(const surface::Region& region) {
        return scene::regionMaterial(scene_, scene::TextureSet(scene_), scene_.objects[0], 0, region);
    }
    surface::Region whole() { return surface::wholePatch(scene_.objects[0].surface->domain(0)); }

    scene::Scene scene_;
};

TEST_F(Textures, SamplesTexelCentresExactlyAndBetweenThemLinearly) {
    useImage(greyImage(2, 1, {0, 255}));
    const scene::TextureSet textures(scene_);
    const scene::TextureRef& ref = scene_.materials[0].reflectanceTexture;
    EXPECT_EQ(textures.sample(ref, {0.25, 0.5}).r, 0.0f);
    EXPECT_EQ(textures.sample(ref, {0.75, 0.5}).r, 1.0f);
    EXPECT_NEAR(textures.sample(ref, {0.5, 0.5}).r, 0.5f, 1e-6f);
    EXPECT_NEAR(textures.sample(ref, {0.375, 0.5}).r, 0.25f, 1e-6f);
    EXPECT_EQ(textures.sample(scene::TextureRef{}, {0.3, 0.3}), Vec4(1.0f));
}

TEST_F(Textures, Wraps) {
    useImage(greyImage(2, 1, {0, 255}));
    const scene::TextureSet textures(scene_);
    scene::TextureRef ref = scene_.materials[0].reflectanceTexture;
    const auto at = [&](double u) { return textures.sample(ref, {u, 0.5}).r; };
    EXPECT_EQ(at(1.25), 0.0f);
    EXPECT_EQ(at(-0.25), 1.0f);
    EXPECT_NEAR(at(1.0), 0.5f, 1e-6f);
    ref.wrapU = scene::Wrap::mirror;
    EXPECT_EQ(at(1.25), 1.0f);
    EXPECT_EQ(at(-0.25), 0.0f);
    EXPECT_EQ(at(1.0), 1.0f);
    EXPECT_EQ(at(2.25), 0.0f);
    ref.wrapU = scene::Wrap::clamp;
    EXPECT_EQ(at(1.25), 1.0f);
    EXPECT_EQ(at(-7.0), 0.0f);
    for (const scene::Wrap wrap : {scene::Wrap::repeat, scene::Wrap::mirror, scene::Wrap::clamp}) {
        ref.wrapU = wrap;
        for (const double u : {1e30, -1e30, 1e300}) {
            EXPECT_TRUE(at(u) >= 0.0f && at(u) <= 1.0f);
        }
    }
}

// Khronos' matrix: offset * rotation * scale, rotation counter-clockwise with v downwards.
TEST_F(Textures, TransformsCoordinates) {
    // Texels: 0 10 / 20 30, rows from the top.
    useImage(greyImage(2, 2, {0, 80, 160, 240}));
    const scene::TextureSet textures(scene_);
    scene::TextureRef ref = scene_.materials[0].reflectanceTexture;
    const auto at = [&](double u, double v) { return textures.sample(ref, {u, v}).r; };
    EXPECT_EQ(at(0.75, 0.25), linear(80));
    ref.offset = {0.5f, 0.0f};
    EXPECT_EQ(at(0.25, 0.25), linear(80));
    ref = scene_.materials[0].reflectanceTexture;
    ref.scale = {0.5f, 1.0f};
    EXPECT_EQ(at(0.5, 0.25), linear(0));
    ref = scene_.materials[0].reflectanceTexture;
    ref.rotation = static_cast<float>(0.5 * base::kPi);
    // (u, v) becomes (v, -u): (0.25, 0.75) -> (0.75, -0.25), which repeats to (0.75, 0.75).
    EXPECT_NEAR(at(0.25, 0.75), linear(240), 1e-5f);
    ref.scale = {3.0f, 1.0f};
    // Scale first: (0.25, 0.75) -> (0.75, 0.75) -> (0.75, -0.75), the upper right texel.
    EXPECT_NEAR(at(0.25, 0.75), linear(80), 1e-5f);
}

TEST_F(Textures, EveryLevelKeepsTheMeanInLinearLight) {
    // 5 x 3: odd sizes need fractional weights.
    std::vector<int> greys;
    double mean = 0.0;
    for (int i = 0; i < 15; ++i) {
        greys.push_back((i * 97) % 256);
        mean += base::linearFromSrgb(greys.back() / 255.0) / 15.0;
    }
    useImage(greyImage(5, 3, greys));
    const scene::TextureSet textures(scene_);
    const scene::TextureRef& ref = scene_.materials[0].reflectanceTexture;
    EXPECT_NEAR(textures.sample(ref, {0.1, 0.9}, 2.0f).r, mean, 1e-6);
    EXPECT_NEAR(textures.sample(ref, {0.1, 0.9}, 99.0f).r, mean, 1e-6);
    // Level 1 is 2 x 1 texels.
    const float left = textures.sample(ref, {0.25, 0.5}, 1.0f).r;
    const float right = textures.sample(ref, {0.75, 0.5}, 1.0f).r;
    EXPECT_NEAR(0.5f * (left + right), mean, 1e-6);
    EXPECT_NEAR(textures.sample(ref, {0.25, 0.5}, 1.5f).r, 0.5 * (static_cast<double>(left) + mean), 1e-6);
}

TEST_F(Textures, LevelsFollowTheFootprint) {
    useImage(greyImage(64, 32, std::vector<int>(64 * 32, 9)));
    const scene::TextureSet textures(scene_);
    scene::TextureRef ref = scene_.materials[0].reflectanceTexture;
    EXPECT_FLOAT_EQ(textures.levelFor(ref, 1.0 / 32.0), 0.0f);
    EXPECT_FLOAT_EQ(textures.levelFor(ref, 1.0 / 8.0), 2.0f);
    EXPECT_FLOAT_EQ(textures.levelFor(ref, 1e9), 6.0f);
    ref.scale = {4.0f, 4.0f};
    EXPECT_FLOAT_EQ(textures.levelFor(ref, 1.0 / 8.0), 4.0f);
}

TEST_F(Textures, RegionMeansAreExactAndDoNotLeak) {
    // Quadrants of one colour each.
    std::vector<int> greys;
    const std::array<int, 4> quadrant{250, 50, 100, 0};
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            greys.push_back(quadrant[static_cast<std::size_t>((y / 16) * 2 + x / 16)]);
        }
    }
    useImage(greyImage(32, 32, greys));
    const surface::Surface& surface = *scene_.objects[0].surface;
    double sum = 0.0;
    for (unsigned child = 0; child < 4; ++child) {
        const surface::Region region =
            surface::childRegion(surface, 0, whole(), surface::Split::quarters, child);
        const surface::RegionPoint middle = surface::mapToRegion(region, {0.5, 0.5});
        const Vec2d uv = surface.texcoord(0, middle.uv, 0);
        const auto q = static_cast<std::size_t>((uv.y > 0.5 ? 2 : 0) + (uv.x > 0.5 ? 1 : 0));
        EXPECT_NEAR(regionAt(region).reflectance.r, linear(quadrant[q]), 1e-6f);
        sum += 0.25 * static_cast<double>(regionAt(region).reflectance.r);
    }
    EXPECT_NEAR(regionAt(whole()).reflectance.r, sum, 1e-6);
}

TEST_F(Textures, RegionMeansOfFineTexturesAreTheirMean) {
    std::vector<int> greys;
    double mean = 0.0;
    for (int i = 0; i < 128 * 128; ++i) {
        greys.push_back((i * 7919 + (i / 128) * 104729) % 251);
        mean += base::linearFromSrgb(greys.back() / 255.0) / (128.0 * 128.0);
    }
    useImage(greyImage(128, 128, greys));
    EXPECT_NEAR(regionAt(whole()).reflectance.r, mean, 2e-3);
    // Repeated many times over a region, any part has the same mean.
    scene_.materials[0].reflectanceTexture.scale = {50.0f, 70.0f};
    EXPECT_NEAR(regionAt(whole()).reflectance.r, mean, 1e-6);
}

TEST_F(Textures, WithoutATextureTheFactorsAreTheMaterial) {
    scene_.materials[0].reflectance = {0.2f, 0.99f, 0.4f};
    scene_.materials[0].emission = {1, 2, 3};
    const scene::RegionMaterial m = regionAt(whole());
    EXPECT_EQ(m.reflectance, Rgb(0.2f, scene::kMaxReflectance, 0.4f));
    EXPECT_EQ(m.emission, Rgb(1, 2, 3));
}

TEST_F(Textures, EmissionHasItsOwnTexture) {
    useImage(greyImage(1, 1, {128}));
    scene_.materials[0].emission = {100, 200, 300};
    scene_.materials[0].emissionTexture.image = 0;
    const scene::RegionMaterial m = regionAt(whole());
    EXPECT_NEAR(m.emission.g, 200.0f * linear(128), 1e-3f);
    EXPECT_NEAR(m.reflectance.g, linear(128), 1e-6f);
}

TEST_F(Textures, HolesNeitherReflectNorEmit) {
    // Left half there, right half a hole.
    scene::Image image{"fence", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};
    useImage(image);
    scene::Material& material = scene_.materials[0];
    material.reflectanceTexture.wrapU = scene::Wrap::clamp;
    material.reflectance = Rgb(0.5f);
    material.emission = Rgb(10.0f);
    material.alphaMode = scene::AlphaMode::mask;
    EXPECT_NEAR(regionAt(whole()).reflectance.r, 0.25f, 1e-6f);
    EXPECT_NEAR(regionAt(whole()).emission.r, 5.0f, 1e-5f);
    const scene::TextureSet textures(scene_);
    const auto there = scene::pointMaterial(scene_, textures, scene_.objects[0], 0,
                                            scene_.objects[0].surface->locate(0, {0.4, 1.0, 0.0}));
    const auto hole = scene::pointMaterial(scene_, textures, scene_.objects[0], 0,
                                           scene_.objects[0].surface->locate(0, {1.6, 1.0, 0.0}));
    EXPECT_EQ(there.reflectance.r, 0.5f);
    EXPECT_EQ(hole.reflectance.r, 0.0f);
    material.alphaMode = scene::AlphaMode::opaque;
    EXPECT_NEAR(regionAt(whole()).reflectance.r, 0.5f, 1e-6f);
}

// On a sphere, rows of the texture cover areas in proportion to the difference of the cosines of their edges.
TEST_F(Textures, MeansAreByTrueArea) {
    scene_.objects[0].surface = std::make_shared<surface::Sphere>(base::Vec3d(0.0), 2.0);
    // White above 45 degrees of latitude: a cap of 1 - cos(45 deg) of a hemisphere.
    std::vector<int> greys(64 * 64, 0);
    std::fill(greys.begin(), greys.begin() + 64 * 16, 255);
    useImage(greyImage(64, 64, greys));
    const double expected = static_cast<double>(scene::kMaxReflectance) * (1.0 - std::sqrt(0.5));
    const surface::Surface& sphere = *scene_.objects[0].surface;
    // Mean over the leaves of an octant, four levels down, each weighted by its true area.
    double sum = 0.0;
    double area = 0.0;
    std::vector<surface::Path> paths{surface::kRootPath};
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const surface::Region region = surface::regionOf(sphere, 0, paths[i]);
        if (surface::pathLevel(paths[i]) < 4) {
            for (unsigned child = 0; child < 4; ++child) {
                paths.push_back(surface::childPath(paths[i], child));
            }
            continue;
        }
        const double a = sphere.area(0, region);
        sum += a * static_cast<double>(regionAt(region).reflectance.r);
        area += a;
    }
    EXPECT_NEAR(sum / area, expected, 0.005 * expected);
}

}  // namespace
}  // namespace fluxwalk
