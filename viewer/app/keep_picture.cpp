#include "viewer/app/keep_picture.h"

#include <algorithm>

#include "viewer/app/picture_file.h"
#include "viewer/gl/render_target.h"

namespace fluxwalk::app {

std::filesystem::path keepPicture(const gl::Functions& gl, render::SceneRenderer& renderer,
                                  const KeptView& view, std::string_view name, bool asLight) {
    constexpr int kSamples = 8;
    const gl::PixelSize size{std::max(1, view.size.width), std::max(1, view.size.height)};
    const double aspect = static_cast<double>(size.width) / size.height;
    const gl::RenderTarget target(gl, size, kSamples,
                                  asLight ? gl::PixelFormat::full : gl::PixelFormat::byte);
    target.bind();
    if (asLight) {
        renderer.drawLight(view.camera, aspect);
    } else {
        renderer.draw(view.camera, aspect, view.look);
    }
    target.resolve();
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::current_path(error);
    const std::filesystem::path file = freePictureName(folder, name, asLight ? ".exr" : ".png");
    if (asLight) {
        writeLight(file, size, target.readLight());
    } else {
        writePixels(file, size, target.readRgb());
    }
    return file;
}

}  // namespace fluxwalk::app
