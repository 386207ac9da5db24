#include "viewer/app/sight.h"

#include <limits>

#include "viewer/render/camera.h"

namespace fluxwalk::app {

rays::Ray rayThrough(const scene::Camera& camera, gl::PixelSize size, const base::Vec2d& pixel) {
    const base::Vec2d place(2.0 * pixel.x / size.width - 1.0, 1.0 - 2.0 * pixel.y / size.height);
    const double aspect = static_cast<double>(size.width) / size.height;
    return {base::Vec3(camera.position), 0.0f, base::Vec3(render::directionAt(camera, aspect, place)),
            std::numeric_limits<float>::max()};
}

}  // namespace fluxwalk::app
