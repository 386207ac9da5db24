#include "viewer/render/light_meter.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "tests/viewer/test_room.h"
#include "viewer/gl/context.h"
#include "viewer/gl/render_target.h"
#include "viewer/render/camera.h"
#include "viewer/render/scene_renderer.h"

namespace fluxwalk::render {
namespace {

TEST(LightMeter, MiddleCountsMost) {
    const gl::PixelSize size = meterSize(16.0 / 9.0);
    // A third of the pixels are bright: enough in the middle, not at the edge.
    const auto exposureWith = [&](auto isBright) {
        std::vector<float> pixels;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                pixels.insert(pixels.end(), {isBright(x) ? 100.0f : 1.0f, 0.0f, 0.0f});
            }
        }
        return meterExposure(pixels, size);
    };
    const int band = size.width / 6;
    EXPECT_NEAR(exposureWith([&](int x) { return std::abs(x - size.width / 2) < band; }), 0.0085, 0.001);
    EXPECT_NEAR(exposureWith([&](int x) { return x < band; }), 0.5, 0.06);
}

TEST(LightMeter, SeesTheRoomItIsInAndNotTheOneBehindTheWall) {
    auto scene = std::make_shared<scene::Scene>();
    scene->materials.emplace_back();
    scene->materials[0].reflectance = base::Rgb(0.5f);
    scene::LitMesh wall = testing::makeQuad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, 2);
    wall.irradiance.assign(wall.positions.size(), base::Rgb(100.0f));
    scene::LitMesh behind = testing::makeQuad({-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}, 2);
    behind.object = 1;
    behind.irradiance.assign(behind.positions.size(), base::Rgb(1e4f));
    const auto context = gl::makeHeadlessContext(gl::HeadlessKind::automatic);
    SceneRenderer renderer(context->functions(), scene);
    renderer.setMeshes(
        {std::make_shared<const scene::LitMesh>(wall), std::make_shared<const scene::LitMesh>(behind)});
    const gl::PixelSize size{40, 30};
    const gl::RenderTarget target(context->functions(), size, 1);
    target.bind();
    const double exposure = renderer.meterExposure(lookAt({0, 0, 2}, {0, 0, 0}, 50.0), 4.0 / 3.0);
    EXPECT_NEAR(exposure * 0.5 * 100.0 / base::kPi, 0.5, 0.05);
    // What was bound is bound again.
    GLint viewport[4] = {};
    context->functions().GetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(viewport[2], size.width);
    EXPECT_EQ(context->functions().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace fluxwalk::render
