#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "tests/viewer/test_room.h"
#include "viewer/app/screenshot.h"
#include "viewer/gl/render_target.h"
#include "viewer/render/camera.h"
#include "viewer/render/scene_renderer.h"

namespace fluxwalk::render {
namespace {

constexpr gl::PixelSize kSize{320, 240};

solve::Snapshot snapshotOf(const testing::TestRoom& room) {
    solve::Snapshot snapshot;
    snapshot.meshes = room.meshes;
    return snapshot;
}

std::vector<std::uint8_t> drawRoom(gl::HeadlessKind kind, bool textured, ToneCurve curve) {
    const auto context = gl::makeHeadlessContext(kind);
    const testing::TestRoom room = testing::makeTestRoom(textured);
    return app::drawPicture(*context, room.scene, snapshotOf(room), room.camera, kSize, {{}, curve});
}

struct Pixel {
    int r, g, b;
};
Pixel pixelAt(const std::vector<std::uint8_t>& picture, gl::PixelSize size, int x, int y) {
    const std::size_t i = 3 * static_cast<std::size_t>(y * size.width + x);
    return {picture[i], picture[i + 1], picture[i + 2]};
}

class EqualPictures : public ::testing::TestWithParam<bool> {};

TEST_P(EqualPictures, EglAndOsmesa) {
    for (const ToneCurve curve : {ToneCurve::linear, ToneCurve::filmic, ToneCurve::reinhard}) {
        const auto egl = drawRoom(gl::HeadlessKind::egl, GetParam(), curve);
        const auto osmesa = drawRoom(gl::HeadlessKind::osmesa, GetParam(), curve);
        EXPECT_EQ(egl, osmesa);
        // The same again, and not merely a flat field.
        EXPECT_EQ(egl, drawRoom(gl::HeadlessKind::egl, GetParam(), curve));
        const Pixel left = pixelAt(egl, kSize, 62, 120);
        const Pixel right = pixelAt(egl, kSize, 257, 120);
        EXPECT_GT(left.r, left.g + 40);
        EXPECT_GT(right.g, right.r + 30);
    }
}

TEST(SharpTextures, AreLaidAsideAndTakenUpAgain) {
    const auto context = gl::makeHeadlessContext(gl::HeadlessKind::automatic);
    const testing::TestRoom room = testing::makeTestRoom(true);
    SceneRenderer renderer(context->functions(), room.scene);
    renderer.setMeshes(snapshotOf(room).meshes);
    const gl::RenderTarget target(context->functions(), kSize, 1);
    // Along a textured wall.
    scene::Camera camera = room.camera;
    camera.forward = glm::normalize(camera.forward + base::Vec3d(0.0, -0.4, 0.0));
    const auto draw = [&](bool areSharp) {
        renderer.setSharpTextures(areSharp);
        target.bind();
        renderer.draw(camera, 4.0 / 3.0, {0.01});
        target.resolve();
        return target.readRgb();
    };
    const auto sharp = draw(true);
    EXPECT_NE(draw(false), sharp);
    EXPECT_EQ(draw(true), sharp);
}

TEST(EqualFalseColors, EglAndOsmesa) {
    const auto drawValues = [](gl::HeadlessKind kind) {
        const auto context = gl::makeHeadlessContext(kind);
        const testing::TestRoom room = testing::makeTestRoom(true);
        return app::drawPicture(*context, room.scene, snapshotOf(room), room.camera, kSize,
                                {{}, ToneCurve::filmic, Shown::illuminance});
    };
    EXPECT_EQ(drawValues(gl::HeadlessKind::egl), drawValues(gl::HeadlessKind::osmesa));
}

INSTANTIATE_TEST_SUITE_P(FlatAndTextured, EqualPictures, ::testing::Bool());

/// A square of 2 m about the origin that faces +z, seen from 3 m before it.
class OneQuad : public ::testing::Test {
  protected:
    void SetUp() override {
        scene_ = std::make_shared<scene::Scene>();
        scene_->materials.emplace_back();
        mesh_ = testing::makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 1);
    }
    /// The picture's centre. `exposure` per cd/m2.
    Pixel drawCenter(double exposure, ToneCurve curve, const base::Vec3d& eye = {0.0, 0.0, 3.0}) {
        return draw({exposure, curve}, eye);
    }
    Pixel draw(const DrawSettings& settings, const base::Vec3d& eye = {0.0, 0.0, 3.0}) {
        SceneRenderer renderer(context_->functions(), scene_);
        renderer.setMeshes({std::make_shared<const scene::LitMesh>(mesh_)});
        const gl::RenderTarget target(context_->functions(), size_, 1);
        target.bind();
        renderer.draw(lookAt(eye, base::Vec3d(0.0), 40.0), 1.0, settings);
        target.resolve();
        return pixelAt(target.readRgb(), size_, size_.width / 2, size_.height / 2);
    }

    const gl::PixelSize size_{32, 32};
    std::unique_ptr<gl::Context> context_ = gl::makeHeadlessContext(gl::HeadlessKind::automatic);
    std::shared_ptr<scene::Scene> scene_;
    scene::LitMesh mesh_;
};

TEST_F(OneQuad, ShaderAgreesWithFalseColorInCpp) {
    scene_->materials[0].reflectance = {0.8f, 0.5f, 0.2f};
    scene_->materials[0].emission = {0.0f, 30.0f, 100.0f};
    const ColorMap map;
    for (const double lux : {0.0, 3.0, 20.0, 77.0, 200.0, 900.0}) {
        const base::Rgb irradiance(static_cast<float>(lux));
        mesh_.irradiance.assign(mesh_.positions.size(), irradiance);
        const double exitance = static_cast<double>(
            base::luminance(scene_->materials[0].reflectance * irradiance + scene_->materials[0].emission));
        for (const Shown shown : {Shown::illuminance, Shown::luminance}) {
            for (const ValueScale scale : {ValueScale::logarithmic, ValueScale::linear}) {
                DrawSettings settings{1.0, ToneCurve::linear, shown, scale, ValueRange{5.0, 500.0}};
                const double value = shown == Shown::illuminance ? lux : exitance / base::kPi;
                const Color8& wanted = map.at(placeOf(value, *settings.range, scale));
                const Pixel drawn = draw(settings);
                EXPECT_NEAR(drawn.r, wanted[0], 2) << lux;
                EXPECT_NEAR(drawn.g, wanted[1], 2) << lux;
                EXPECT_NEAR(drawn.b, wanted[2], 2) << lux;
            }
        }
    }
}

TEST_F(OneQuad, IsolinesStandAtRoundNumbers) {
    // 10 lx at the left edge to 1000 lx at the right, in the logarithm nearly linear over many cells.
    mesh_ = testing::makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 64);
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
        mesh_.irradiance[i] = base::Rgb(std::pow(10.0f, 2.0f + mesh_.positions[i].x));
    }
    constexpr gl::PixelSize kWide{512, 16};
    SceneRenderer renderer(context_->functions(), scene_);
    renderer.setMeshes({std::make_shared<const scene::LitMesh>(mesh_)});
    const gl::RenderTarget target(context_->functions(), kWide, 1);
    // From far away, so that 512 pixels are 2 m.
    const double fov = 2.0 * std::atan(1.0 / 32.0 / 100.0) * 180.0 / base::kPi;
    const auto row = [&](bool isolines) {
        DrawSettings settings{
            1.0,     ToneCurve::linear, Shown::illuminance, ValueScale::logarithmic, ValueRange{10.0, 1000.0},
            isolines};
        target.bind();
        renderer.draw(lookAt({0.0, 0.0, 100.0}, base::Vec3d(0.0), fov), 32.0, settings);
        target.resolve();
        return target.readRgb();
    };
    const auto with = row(true);
    const auto without = row(false);
    std::vector<double> lines;
    for (int x = 4; x < 508; ++x) {
        const Pixel a = pixelAt(with, kWide, x, 8);
        const Pixel b = pixelAt(without, kWide, x, 8);
        const bool isLine = std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) > 60;
        if (isLine && (lines.empty() || x > lines.back() + 3.0)) {
            lines.push_back(x);
        }
    }
    const std::vector<double> round{20.0, 50.0, 100.0, 200.0, 500.0};
    ASSERT_EQ(lines.size(), round.size());
    for (std::size_t i = 0; i < round.size(); ++i) {
        EXPECT_NEAR(lines[i], 256.0 * (std::log10(round[i]) - 1.0), 2.0) << round[i];
    }
}

TEST_F(OneQuad, ShaderAgreesWithToneCurveInCpp) {
    scene_->materials[0].reflectance = {0.8f, 0.5f, 0.2f};
    scene_->materials[0].emission = {0.0f, 30.0f, 100.0f};
    const base::Rgb irradiance(500.0f, 300.0f, 100.0f);
    mesh_.irradiance.assign(mesh_.positions.size(), irradiance);
    const base::Rgb luminance =
        (scene_->materials[0].reflectance * irradiance + scene_->materials[0].emission) /
        static_cast<float>(base::kPi);
    for (const ToneCurve curve :
         {ToneCurve::linear, ToneCurve::filmic, ToneCurve::reinhard, ToneCurve::hue}) {
        for (const double exposure : {0.0, 1e-5, 1e-3, 0.004, 0.01, 0.05, 1.0}) {
            const Pixel drawn = drawCenter(exposure, curve);
            const base::Rgb wanted = applyToneCurve(luminance * static_cast<float>(exposure), curve);
            // Half a step from rounding and half from dithering.
            EXPECT_NEAR(drawn.r, 255.0f * encodeSrgb(wanted.r), 1.01f) << exposure;
            EXPECT_NEAR(drawn.g, 255.0f * encodeSrgb(wanted.g), 1.01f) << exposure;
            EXPECT_NEAR(drawn.b, 255.0f * encodeSrgb(wanted.b), 1.01f) << exposure;
        }
    }
}

TEST_F(OneQuad, TextureMultipliesInLinearLight) {
    scene::Image image;
    image.width = image.height = 1;
    image.rgba = {188, 99, 255, 255};
    scene_->images.push_back(image);
    scene_->materials[0].reflectance = base::Rgb(0.5f);
    scene_->materials[0].reflectanceTexture.image = 0;
    mesh_.irradiance.assign(mesh_.positions.size(), base::Rgb(static_cast<float>(base::kPi)));
    const Pixel drawn = drawCenter(1.0, ToneCurve::linear);
    EXPECT_NEAR(drawn.r, 255.0f * encodeSrgb(0.5f * decodeSrgb(188)), 1.5f);
    EXPECT_NEAR(drawn.g, 255.0f * encodeSrgb(0.5f * decodeSrgb(99)), 1.5f);
    EXPECT_NEAR(drawn.b, 255.0f * encodeSrgb(0.5f), 1.5f);
}

TEST_F(OneQuad, EmissionLeavesTheFrontOnly) {
    scene_->materials[0].reflectance = base::Rgb(0.0f);
    scene_->materials[0].emission = base::Rgb(1000.0f);
    EXPECT_EQ(drawCenter(1.0, ToneCurve::linear).g, 255);
    mesh_.back = true;
    EXPECT_EQ(drawCenter(1.0, ToneCurve::linear).g, 0);
    scene_->materials[0].doubleSided = true;
    EXPECT_EQ(drawCenter(1.0, ToneCurve::linear).g, 255);
}

TEST_F(OneQuad, OneLooksThroughItFromBehind) {
    scene_->sky = base::Rgb(static_cast<float>(base::kPi));
    mesh_.irradiance.assign(mesh_.positions.size(), base::Rgb(0.0f));
    EXPECT_EQ(drawCenter(1.0, ToneCurve::linear).g, 0);
    // From below behind, the sky shows at its own luminance: L = E / pi = 1.
    EXPECT_EQ(drawCenter(1.0, ToneCurve::linear, {0.0, -0.5, -3.0}).g, 255);
}

TEST_F(OneQuad, HolesAreCutWhereAlphaIsLow) {
    scene::Image image;
    image.width = image.height = 1;
    image.rgba = {255, 255, 255, 100};
    scene_->images.push_back(image);
    scene::Material& material = scene_->materials[0];
    material.reflectance = base::Rgb(1.0f);
    material.reflectanceTexture.image = 0;
    mesh_.irradiance.assign(mesh_.positions.size(), base::Rgb(100.0f));
    EXPECT_EQ(drawCenter(1.0, ToneCurve::linear).g, 255);
    material.alphaMode = scene::AlphaMode::mask;
    EXPECT_LT(drawCenter(1.0, ToneCurve::linear).g, 60);
    material.alphaCutoff = 0.3f;
    EXPECT_EQ(drawCenter(1.0, ToneCurve::linear).g, 255);
    // Blended: 100/255 of white over the background, which is darker than 60.
    material.alphaMode = scene::AlphaMode::blend;
    EXPECT_NEAR(drawCenter(1.0, ToneCurve::linear).g, 118, 20);
}

TEST_F(OneQuad, SendsOnlyWhatChanged) {
    SceneRenderer renderer(context_->functions(), scene_);
    const auto a = std::make_shared<const scene::LitMesh>(mesh_);
    const auto b = std::make_shared<const scene::LitMesh>(mesh_);
    EXPECT_EQ(renderer.setMeshes({a, b}), 2u);
    EXPECT_EQ(renderer.triangleCount(), 4u);
    EXPECT_EQ(renderer.setMeshes({a, b}), 0u);
    // Another array with the same content is on the GPU already.
    const auto c = std::make_shared<const scene::LitMesh>(mesh_);
    EXPECT_EQ(renderer.setMeshes({c, b}), 0u);
    EXPECT_EQ(a.use_count(), 1);  // let go
    mesh_.irradiance[2] += 1.0f;
    EXPECT_EQ(renderer.setMeshes({std::make_shared<const scene::LitMesh>(mesh_), b}), 1u);
    EXPECT_EQ(renderer.setMeshes({}), 0u);
    EXPECT_TRUE(renderer.bounds().isEmpty());
    EXPECT_EQ(context_->functions().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(TexcoordTransform, TurnsCounterClockwiseSeenWithVDownwards) {
    scene::TextureRef texture;
    texture.scale = {0.5f, 0.5f};
    texture.offset = {0.0f, 1.0f};
    texture.rotation = static_cast<float>(0.5 * base::kPi);
    const glm::mat3 map = texcoordTransform(texture);
    // The example of KHR_texture_transform: the lower left quadrant, turned.
    const glm::vec3 origin = map * glm::vec3(0.0f, 0.0f, 1.0f);
    const glm::vec3 corner = map * glm::vec3(1.0f, 1.0f, 1.0f);
    EXPECT_NEAR(origin.x, 0.0f, 1e-6f);
    EXPECT_NEAR(origin.y, 1.0f, 1e-6f);
    EXPECT_NEAR(corner.x, 0.5f, 1e-6f);
    EXPECT_NEAR(corner.y, 0.5f, 1e-6f);
}

TEST(MeanColor, IsTakenInLinearLight) {
    scene::Image image;
    image.width = 2;
    image.height = 1;
    image.rgba = {255, 0, 188, 255, 0, 0, 188, 255};
    const base::Rgb mean = meanColor(image);
    EXPECT_NEAR(mean.r, 0.5f, 1e-6f);
    EXPECT_EQ(mean.g, 0.0f);
    EXPECT_NEAR(mean.b, decodeSrgb(188), 1e-6f);
}

}  // namespace
}  // namespace fluxwalk::render
