#include "viewer/app/screenshot.h"

#include "viewer/gl/render_target.h"
#include "viewer/render/scene_renderer.h"

namespace fluxwalk::app {
namespace {

constexpr int kSamples = 8;

}  // namespace

std::vector<std::uint8_t> drawPicture(gl::Context& context, const std::shared_ptr<const scene::Scene>& scene,
                                      const scene::LitMeshes& meshes, const scene::Camera& camera,
                                      gl::PixelSize size, render::ToneCurve curve) {
    const gl::Functions& gl = context.functions();
    const gl::RenderTarget target(gl, size, kSamples);
    render::SceneRenderer renderer(gl, scene);
    renderer.setMeshes(meshes);
    target.bind();
    renderer.draw(camera, static_cast<double>(size.width) / size.height,
                  {renderer.automaticExposure(), curve});
    target.resolve();
    return target.readRgb();
}

}  // namespace fluxwalk::app
