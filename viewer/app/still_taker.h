#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/app/still_saver.h"
#include "viewer/app/tour.h"
#include "viewer/gl/window_context.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/render/still_pass.h"
#include "viewer/session/solver_session.h"
#include "viewer/ui/panel.h"

namespace fluxwalk::app {

/// The still of the window: asks the solver for it, shows how it comes to be, keeps it until it is dismissed.
/// At first it is large; it goes to a corner while somebody walks on.
class StillTaker {
  public:
    /// Parts of the window that it works with: what tells, what draws, and what is chosen.
    struct Parts {
        Tour& tour;
        render::SceneRenderer& renderer;
        const ui::ViewSettings& settings;
    };
    /// Files are named after `name`.
    StillTaker(gl::WindowContext& window, const Parts& parts, std::string name);

    /// What one frame brings.
    struct Frame {
        session::SolverSession* session = nullptr;  ///< null for a lit file, which has nothing to gather from
        const scene::Camera& camera;
        double now = 0.0;            ///< seconds of the window's clock
        bool isMoving = false;       ///< in this frame
        std::uint64_t solution = 0;  ///< number of the snapshot that the renderer shows
        ui::Canvas canvas;
    };
    /// The key: takes one, or changes the size of the one that is there.
    void press(const Frame& frame);
    /// Esc: brings a large one that is being made to the corner, closes one that is done.
    void dismiss();
    /// Writes the large still; false where there is none that covers the window.
    bool keep(bool asLight, const Frame& frame);
    bool isLarge() const { return job_ != nullptr && isLarge_; }

    /// For the panel, as of the last draw().
    const ui::StillInfo& info() const { return info_; }
    /// Does what was chosen in the panel, takes what is new of the still and draws it.
    void draw(const Frame& frame, const ui::StillActions& chosen);

    /// The file that is still being written, to be waited for elsewhere. Nothing may be called afterwards.
    std::future<void> release() { return saver_.release(); }

  private:
    void take(const Frame& frame);
    void close();
    void follow(const Frame& frame);
    void finish(const Frame& frame);
    void act(const ui::StillActions& actions, const Frame& frame);
    void save(bool asLight, const Frame& frame);
    void meter();
    void paintUnder(const Frame& frame, gl::PixelSize size);
    void paint(const Frame& frame);
    void tell(const session::StillStatus& status);
    double exposure() const;

    gl::WindowContext& window_;
    Tour& tour_;
    render::SceneRenderer& renderer_;
    const ui::ViewSettings& settings_;
    const std::string name_;
    std::shared_ptr<session::StillJob> job_;  ///< null for none
    bool isLarge_ = false;
    bool isFinished_ = false;  ///< its end was seen
    ui::StillInfo info_;
    /// As `render` would expose it, once that is known.
    std::optional<double> ownExposure_;
    std::future<double> metering_;
    /// Of stills that were closed; nobody waits for them before the end.
    std::vector<std::future<double>> abandoned_;
    StillSaver saver_;
    std::unique_ptr<render::StillPass> pass_;
    std::unique_ptr<gl::RenderTarget> under_;
    std::uint64_t underSolution_ = 0;
    double underTime_ = 0.0;
    std::unique_ptr<gl::RenderTarget> shown_;
    render::StillPass::Look look_;
    bool isOld_ = true;
    /// Done in the next frame, since this one still shows what they may close.
    ui::StillActions clicked_;
};

}  // namespace fluxwalk::app
