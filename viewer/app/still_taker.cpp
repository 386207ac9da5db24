#include "viewer/app/still_taker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "core/cli/progress.h"
#include "viewer/app/picture_file.h"
#include "viewer/app/still_file.h"
#include "viewer/ui/imgui_renderer.h"

namespace fluxwalk::app {
namespace {

/// Longest side of what is sent to the GPU: enough for any window, and little beside an 8k still.
constexpr std::uint32_t kLongestShown = 4096;
/// Of the picture under a still, and the seconds until another solution is shown there: it is drawn beside
/// the window's own.
constexpr int kSamples = 4;
constexpr double kUnderTime = 1.0;

// Side of the squares of pixels that are shown as one.
std::uint32_t stepFor(std::uint32_t width, std::uint32_t height) {
    std::uint32_t step = 1;
    while (std::max(width, height) > step * kLongestShown) {
        step *= 2;
    }
    return step;
}

gl::PixelSize pixelsOf(const image::StillOptions& options) {
    return {static_cast<int>(options.width), static_cast<int>(options.height)};
}

}  // namespace

StillTaker::StillTaker(gl::WindowContext& window, const Parts& parts, std::string name)
    : window_(window),
      tour_(parts.tour),
      renderer_(parts.renderer),
      settings_(parts.settings),
      name_((name.empty() ? "fluxwalk" : std::move(name)) + "-still") {}

void StillTaker::press(const Frame& frame) {
    if (job_ != nullptr) {
        isLarge_ = !isLarge_;
    } else if (frame.session == nullptr) {
        tour_.say("A lit file has no links to gather light from: stills need a scene that is solved.",
                  frame.now);
    } else {
        take(frame);
    }
}

void StillTaker::take(const Frame& frame) {
    image::StillOptions options = settings_.still.options;
    const gl::PixelSize chosen = settings_.still.size;
    const gl::PixelSize size = chosen.width > 0 ? chosen : window_.framebufferSize();
    if (size.width <= 0 || size.height <= 0) {
        return;
    }
    close();
    options.width = static_cast<std::uint32_t>(size.width);
    options.height = static_cast<std::uint32_t>(size.height);
    const std::uint32_t step = stepFor(options.width, options.height);
    const auto part = [step](std::uint32_t side) { return static_cast<int>((side + step - 1) / step); };
    pass_ = std::make_unique<render::StillPass>(window_.functions(),
                                                gl::PixelSize{part(options.width), part(options.height)});
    job_ = std::make_shared<session::StillJob>(frame.camera, options, step);
    isLarge_ = true;
    frame.session->take(job_);
}

void StillTaker::close() {
    if (job_ != nullptr) {
        job_->cancel();
    }
    job_.reset();
    pass_.reset();
    under_.reset();
    shown_.reset();
    isFinished_ = false;
    ownExposure_.reset();
    if (metering_.valid()) {
        abandoned_.push_back(std::move(metering_));
    }
    info_ = {};
}

void StillTaker::dismiss() {
    if (isFinished_) {
        close();
    } else {
        isLarge_ = false;
    }
}

double StillTaker::exposure() const {
    return settings_.still.hasOwnExposure && ownExposure_ ? *ownExposure_ : settings_.exposure.exposure;
}

bool StillTaker::keep(bool asLight, const Frame& frame) {
    if (!isLarge()) {
        return false;
    }
    if (!isFinished_) {
        tour_.say("The still is not done: it can be kept then, or when it is cancelled.", frame.now);
    } else {
        save(asLight, frame);
    }
    return true;
}

void StillTaker::save(bool asLight, const Frame& frame) {
    if (saver_.isBusy()) {
        tour_.say("Another file is still being written.", frame.now);
        return;
    }
    std::error_code error;
    const std::filesystem::path file =
        freePictureName(std::filesystem::current_path(error), name_, asLight ? ".exr" : ".png");
    saver_.begin(job_->still(), file, exposure(), settings_.draw.curve);
}

void StillTaker::tell(const session::StillStatus& status) {
    using session::StillPhase;
    if (isFinished_ && saver_.isBusy()) {
        info_.told = "being written";
    } else if (status.phase == StillPhase::waiting) {
        info_.told = "waits for the solver; P: at once";
    } else if (status.phase == StillPhase::done) {
        info_.told = "done in " + cli::formatDuration(status.seconds);
    } else if (status.phase == StillPhase::cancelled) {
        const auto still = job_->still();
        info_.told = still ? fmt::format("{} of {} rows done", still->rowsDone, still->height) : "cancelled";
    } else {
        // What is shown is two strips behind what is gathered.
        const double gathered = status.progress + 2.0 * image::kTile / job_->options().height;
        const double left =
            status.progress > 0.0 ? cli::estimateRemaining(std::min(1.0, gathered), status.seconds) : -1.0;
        info_.told = fmt::format("{:.0f} %, {}", 100.0 * status.progress,
                                 left >= 0.0 ? cli::formatDuration(left) + " left"
                                             : cli::formatDuration(status.seconds) + " so far");
    }
}

// Its end is seen once.
void StillTaker::finish(const Frame& frame) {
    const session::StillStatus status = job_->status();
    const auto still = job_->still();
    if (still == nullptr) {
        if (status.phase == session::StillPhase::failed) {
            tour_.complain("The still failed: " + status.failure, frame.now);
        } else {
            tour_.say("The still was cancelled before any of it was done.", frame.now);
        }
        close();
        return;
    }
    isFinished_ = true;
    shown_.reset();
}

// Metering reads every pixel: beside the window, and only where somebody wants it.
void StillTaker::meter() {
    if (metering_.valid()) {
        if (metering_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
            ownExposure_ = metering_.get();
        }
    } else if (isFinished_ && settings_.still.hasOwnExposure && !ownExposure_) {
        metering_ = std::async(std::launch::async, [still = job_->still()] { return meterStill(*still); });
    }
}

void StillTaker::follow(const Frame& frame) {
    if (const auto result = saver_.takeResult()) {
        if (result->error.empty()) {
            tour_.say(result->file.string(), frame.now);
        } else {
            tour_.complain(result->error, frame.now);
        }
    }
    if (job_ == nullptr) {
        return;
    }
    isLarge_ = isLarge_ && !frame.isMoving;
    // Before the parts, so that none comes after the end.
    const session::StillStatus status = job_->status();
    for (const session::StillPart& part : job_->takeParts()) {
        pass_->put({part.place.left, part.place.top, part.place.width, part.place.height}, part.luminance);
        isOld_ = true;
    }
    if (status.isOver() && !isFinished_) {
        finish(frame);
    }
    if (job_ == nullptr) {
        return;
    }
    meter();
    info_.isThere = true;
    info_.isAtWork = status.phase == session::StillPhase::running;
    info_.isOver = isFinished_;
    info_.canBeKept = isFinished_ && !saver_.isBusy();
    info_.isLarge = isLarge_;
    info_.progress = status.progress;
    info_.size = pixelsOf(job_->options());
    tell(status);
}

void StillTaker::paintUnder(const Frame& frame, gl::PixelSize size) {
    under_ = std::make_unique<gl::RenderTarget>(window_.functions(), size, kSamples, gl::PixelFormat::full);
    under_->bind();
    if (isFinished_) {
        // What is not done stays black, as in the file.
        const gl::Functions& gl = window_.functions();
        gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
        gl.Clear(GL_COLOR_BUFFER_BIT);
    } else {
        renderer_.drawLight(job_->camera(), static_cast<double>(info_.size.width) / info_.size.height);
    }
    under_->resolve();
    underSolution_ = frame.solution;
    underTime_ = frame.now;
    isOld_ = true;
}

// The picture of it, as large as it is shown.
void StillTaker::paint(const Frame& frame) {
    const ui::StillPlace place =
        isLarge_ ? ui::placeLarge(info_.size) : ui::placeSmall(info_.size, frame.canvas.scale);
    const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
    const gl::PixelSize size{std::max(1, static_cast<int>(std::lround(place.width * pixels.x))),
                             std::max(1, static_cast<int>(std::lround(place.height * pixels.y)))};
    if (!shown_ || !(shown_->size() == size)) {
        shown_ =
            std::make_unique<gl::RenderTarget>(window_.functions(), size, 1, gl::PixelFormat::byte, false);
        paintUnder(frame, size);
    } else if (!isFinished_ && underSolution_ != frame.solution && frame.now > underTime_ + kUnderTime) {
        paintUnder(frame, size);
    }
    const render::StillPass::Look look{exposure(), settings_.draw.curve};
    if (isOld_ || !(look == look_)) {
        pass_->draw(*shown_, *under_, look);
        look_ = look;
        isOld_ = false;
    }
}

void StillTaker::act(const ui::StillActions& actions, const Frame& frame) {
    if (actions.takes && frame.session != nullptr) {
        take(frame);
    } else if (job_ == nullptr) {
        return;
    } else if (actions.cancels) {
        job_->cancel();
    } else if (actions.resizes) {
        isLarge_ = !isLarge_;
    } else if (actions.closes) {
        close();
    } else if ((actions.keepsPicture || actions.keepsLight) && info_.canBeKept) {
        save(actions.keepsLight, frame);
    }
}

void StillTaker::draw(const Frame& frame, const ui::StillActions& chosen) {
    act(std::exchange(clicked_, {}), frame);
    act(chosen, frame);
    follow(frame);
    if (job_ == nullptr) {
        return;
    }
    paint(frame);
    clicked_ = ui::drawStill(info_, ui::textureId(shown_->texture().id()), frame.canvas);
}

}  // namespace fluxwalk::app
