#include "viewer/render/glow.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/viewer/test_room.h"
#include "viewer/gl/context.h"
#include "viewer/render/camera.h"
#include "viewer/render/scene_renderer.h"

namespace fluxwalk::render {
namespace {

/// Light of a small lamp in the dark as Glow blurs it: what there is before and after.
struct Blurred {
    double before = 0.0;
    double after = 0.0;
    double widthOfHalf =
        0.0;  ///< about the lamp, in parts of the picture's height, that holds half of the light
};

Blurred blurLamp(int height) {
    const auto context = gl::makeHeadlessContext(gl::HeadlessKind::automatic);
    const gl::Functions& gl = context->functions();
    auto scene = std::make_shared<scene::Scene>();
    scene->materials.emplace_back();
    scene->materials[0].emission = base::Rgb(1e6f);
    scene::LitMesh lamp =
        testing::makeQuad({-0.2f, -0.2f, 0}, {0.2f, -0.2f, 0}, {0.2f, 0.2f, 0}, {-0.2f, 0.2f, 0}, 1);
    SceneRenderer renderer(gl, scene);
    renderer.setMeshes({std::make_shared<const scene::LitMesh>(lamp)});
    const scene::Camera camera = lookAt({0, 0, 10}, {0, 0, 0}, 50.0);
    Glow glow(gl);
    const gl::PixelSize size = glow.begin({height, height});
    renderer.drawLight(camera, 1.0);
    const GlowLayer layer = glow.finish();
    const auto read = [&](GLuint texture) {
        std::vector<float> pixels(static_cast<std::size_t>(3 * size.width * size.height));
        gl.ActiveTexture(GL_TEXTURE0);
        gl.BindTexture(GL_TEXTURE_2D, texture);
        gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_FLOAT, pixels.data());
        return pixels;
    };
    const gl::RenderTarget sharp(gl, size, 8, gl::PixelFormat::full);
    sharp.bind();
    renderer.drawLight(camera, 1.0);
    sharp.resolve();
    Blurred result;
    for (const float light : sharp.readLight()) {
        result.before += static_cast<double>(light);
    }
    const std::vector<float> pixels = read(layer.texture);
    for (const float light : pixels) {
        result.after += static_cast<double>(light);
    }
    double inside = 0.0;
    for (int half = 1; inside < 0.5 * result.after && half < size.height / 2; ++half) {
        inside = 0.0;
        for (int y = size.height / 2 - half; y < size.height / 2 + half; ++y) {
            for (int x = size.width / 2 - half; x < size.width / 2 + half; ++x) {
                for (int c = 0; c < 3; ++c) {
                    inside +=
                        static_cast<double>(pixels[static_cast<std::size_t>(3 * (y * size.width + x) + c)]);
                }
            }
        }
        result.widthOfHalf = 2.0 * half / size.height;
    }
    return result;
}

TEST(Glow, AddsNoLight) {
    const Blurred blurred = blurLamp(720);
    EXPECT_NEAR(blurred.after / blurred.before, 1.0, 0.03);
}

TEST(Glow, IsAsWideInSmallPictures) {
    const double large = blurLamp(1080).widthOfHalf;
    const double small = blurLamp(192).widthOfHalf;
    EXPECT_GT(large, 0.04);
    EXPECT_LT(large, 0.5);
    EXPECT_NEAR(small / large, 1.0, 0.5);
}

}  // namespace
}  // namespace fluxwalk::render
