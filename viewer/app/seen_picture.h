#pragma once

#include <memory>

#include "viewer/app/sample_choice.h"
#include "viewer/gl/render_target.h"
#include "viewer/gl/window_context.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/ui/exposure_control.h"

namespace fluxwalk::app {

/// The window's picture of the scene, drawn again only where something changed, and the exposure it is seen
/// with.
class SeenPicture {
  public:
    SeenPicture(gl::WindowContext& window, std::shared_ptr<const scene::Scene> scene);

    render::SceneRenderer& renderer() { return renderer_; }
    /// Something that is seen has changed, beside what draw() is given.
    void renew() { isOld_ = true; }

    /// Follows what is seen with the exposure, as eyes do; times in seconds. Returns whether it changed.
    bool adapt(const scene::Camera& camera, ui::ExposureControl& exposure, double now, double seconds);

    struct Wanted {
        scene::Camera camera;
        render::DrawSettings look;
        bool hasSmoothEdges = true;
        bool isMoving = false;  ///< fewer samples will do
    };
    /// Draws it if it is old.
    void draw(const Wanted& wanted, double now);
    /// To the window; false where nothing was drawn yet.
    bool copyToWindow() const;
    /// What the frame took that began at `now`, in seconds.
    void report(double seconds, double now);

    /// 0 while the picture stands still.
    double framesPerSecond() const { return framesPerSecond_; }
    /// Seconds of the window's clock when it was drawn last, and what that took.
    double lastDraw() const { return lastDraw_; }
    double drawSeconds() const { return drawSeconds_; }

  private:
    gl::WindowContext& window_;
    render::SceneRenderer renderer_;
    std::unique_ptr<gl::RenderTarget> target_;
    SampleChoice samples_;
    render::DrawSettings drawn_;
    bool isSharp_ = true;
    bool isOld_ = true;
    double automaticExposure_ = 0.0;
    bool isMeteringOld_ = true;
    double lastMetering_ = -1.0;
    double lastDraw_ = 0.0;
    double drawSeconds_ = 0.0;
    double framesPerSecond_ = 0.0;
};

}  // namespace fluxwalk::app
