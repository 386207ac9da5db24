#include "viewer/app/recorder.h"

#include <utility>

namespace fluxwalk::app {
namespace {

bool isSame(const scene::Camera& a, const scene::Camera& b) {
    return a.position == b.position && a.forward == b.forward && a.up == b.up &&
           a.verticalFov == b.verticalFov;
}

}  // namespace

void Recorder::note(const scene::Camera& camera, double seconds) {
    const std::size_t n = path_.size();
    if (n >= 2 && isSame(path_[n - 1].camera, camera) && isSame(path_[n - 2].camera, camera)) {
        path_.back().seconds = seconds;
    } else {
        path_.push_back({seconds, camera});
    }
}

void Recorder::begin(const scene::Camera& camera, double now) {
    path_.clear();
    start_ = now;
    note(camera, 0.0);
}

void Recorder::follow(const scene::Camera& camera, double now) {
    if (start_ && now - *start_ >= path_.back().seconds + kInterval) {
        note(camera, now - *start_);
    }
}

scene::CameraPath Recorder::end(const scene::Camera& camera, double now) {
    if (start_ && now - *start_ > path_.back().seconds) {
        note(camera, now - *start_);
    }
    start_.reset();
    return std::exchange(path_, {});
}

void Playback::begin(scene::CameraPath path, double now) {
    path_ = std::move(path);
    start_ = now;
}

scene::Camera Playback::follow(double now) {
    const scene::Camera camera = scene::cameraAt(path_, now - start_);
    if (now - start_ >= scene::durationOf(path_)) {
        stop();
    }
    return camera;
}

}  // namespace fluxwalk::app
