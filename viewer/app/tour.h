#pragma once

#include <optional>
#include <string>

#include "viewer/app/exhibit.h"
#include "viewer/app/floor.h"
#include "viewer/app/recorder.h"
#include "viewer/app/scene_opener.h"
#include "viewer/app/visitor_book.h"
#include "viewer/gl/window_context.h"
#include "viewer/ui/message.h"
#include "viewer/ui/places.h"
#include "viewer/ui/walker.h"

namespace fluxwalk::app {

/// All that moves the visitor other than walking, and what the window says about it: orbit, focus, bookmarks,
/// recorded paths, other scenes, help, full screen.
class Tour {
  public:
    Tour(gl::WindowContext& window, const Exhibit& exhibit, SceneOpener& opener);

    /// What one frame brings.
    struct Frame {
        ui::Walker& walker;
        Floor& floor;
        double now = 0.0;         ///< seconds of the window's clock
        bool isSteered = false;   ///< the visitor walks or looks around: that ends a playback
        bool isCaptured = false;  ///< the mouse is; the middle of the window is pointed at
    };
    /// Takes keys and mouse; after ImGui::NewFrame(). Returns whether the camera was led: then it shall not
    /// walk.
    bool lead(const Frame& frame);
    /// To be called once the camera stands.
    void record(const Frame& frame) { recorder_.follow(frame.walker.camera(), frame.now); }
    /// Whether something goes on that needs every frame.
    bool isMoving() const { return playback_.isPlaying(); }
    /// Whether help or an error is open, which Esc closes first.
    bool isOpen() const { return isHelpOpen_ || (message_ && message_->isError); }
    /// Whether the mouse belongs to an orbit.
    bool isOrbiting() const { return pivot_.has_value(); }

    ui::Places places() const;
    /// What was chosen in the panel. Returns whether the camera changed.
    bool act(const ui::PlaceActions& actions, const Frame& frame);
    /// Messages and the help.
    void draw(double now, float scale);

    /// Tells what was done, or what is wrong, for some seconds.
    void say(const std::string& text, double now);
    void complain(const std::string& text, double now);

  private:
    /// Goes to a camera, unless nothing can be seen through it.
    void goTo(const scene::Camera& camera, ui::Walker& walker, double now);
    bool takeKeys(const Frame& frame);
    bool orbit(const Frame& frame);
    std::optional<Floor::Met> pick(const Frame& frame) const;
    void focus(const Frame& frame);
    bool changeFov(ui::Walker& walker);
    void toggleRecording(const Frame& frame);
    void togglePlaying(const Frame& frame);
    void keep(const Frame& frame);
    bool goToBookmark(std::size_t bookmark, const Frame& frame);
    void followOpener(double now);

    gl::WindowContext& window_;
    SceneOpener& opener_;
    const std::vector<scene::Camera> cameras_;
    const std::shared_ptr<const scene::Scene> solid_;
    VisitorBook book_;
    Recorder recorder_;
    Playback playback_;
    /// Played last, or recorded last, or asked for; empty for none.
    scene::CameraPath path_;
    bool wantsToPlay_ = false;
    std::optional<base::Vec3d> pivot_;
    bool isHelpOpen_ = false;
    std::optional<ui::Message> message_;
};

}  // namespace fluxwalk::app
