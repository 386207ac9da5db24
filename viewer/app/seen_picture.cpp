#include "viewer/app/seen_picture.h"

#include <algorithm>

namespace fluxwalk::app {

namespace {

constexpr int kSamples = 4;
/// Seconds between readings of the light meter.
constexpr double kMeteringTime = 0.2;

}  // namespace

SeenPicture::SeenPicture(gl::WindowContext& window, std::shared_ptr<const scene::Scene> scene)
    : window_(window),
      renderer_(window.functions(), std::move(scene)),
      samples_(kSamples, window.isSoftware()) {}

bool SeenPicture::adapt(const scene::Camera& camera, ui::ExposureControl& exposure, double now,
                        double seconds) {
    isMeteringOld_ |= isOld_;
    const gl::PixelSize size = window_.framebufferSize();
    const bool isLocked = !exposure.isAutomatic && exposure.exposure > 0.0;
    const bool isDue = isMeteringOld_ && now - lastMetering_ >= kMeteringTime;
    if (isDue && !isLocked && size.height > 0 && renderer_.triangleCount() > 0) {
        automaticExposure_ = renderer_.meterExposure(camera, static_cast<double>(size.width) / size.height);
        isMeteringOld_ = false;
        lastMetering_ = now;
    }
    return automaticExposure_ > 0.0 && exposure.follow(automaticExposure_, seconds);
}

void SeenPicture::draw(const Wanted& wanted, double now) {
    const gl::PixelSize size = window_.framebufferSize();
    if (size.width <= 0 || size.height <= 0) {
        return;
    }
    const int samples = wanted.hasSmoothEdges ? samples_.choose(wanted.isMoving) : 1;
    const bool fits = target_ && target_->size() == size && target_->samples() == samples;
    const bool isSharp = !(wanted.isMoving && window_.isSoftware());
    if (fits && isSharp == isSharp_ && drawn_ == wanted.look && !isOld_) {
        framesPerSecond_ = 0.0;
        return;
    }
    if (!fits) {
        target_.reset();
        target_ = std::make_unique<gl::RenderTarget>(window_.functions(), size, samples);
    }
    target_->bind();
    renderer_.setSharpTextures(isSharp);
    isSharp_ = isSharp;
    renderer_.draw(wanted.camera, static_cast<double>(size.width) / size.height, wanted.look);
    target_->resolve();
    drawn_ = wanted.look;
    isOld_ = false;
    framesPerSecond_ = lastDraw_ > 0.0 ? 1.0 / std::max(now - lastDraw_, 1e-3) : 0.0;
    lastDraw_ = now;
}

bool SeenPicture::copyToWindow() const {
    if (!target_) {
        return false;
    }
    target_->copyToWindow();
    return true;
}

void SeenPicture::report(double seconds, double now) {
    if (lastDraw_ == now && target_) {
        drawSeconds_ = seconds;
        samples_.report(target_->samples(), seconds);
    }
}

}  // namespace fluxwalk::app
