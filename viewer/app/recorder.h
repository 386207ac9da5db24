#pragma once

#include <optional>

#include "core/scene/camera_path.h"

namespace fluxwalk::app {

/// Notes key frames of a camera that moves.
class Recorder {
  public:
    /// Seconds between two key frames.
    static constexpr double kInterval = 0.2;

    bool isRecording() const { return start_.has_value(); }
    /// Seconds recorded so far.
    double seconds() const { return path_.empty() ? 0.0 : path_.back().seconds; }
    /// `now` in seconds of any clock.
    void begin(const scene::Camera& camera, double now);
    /// To be called for each frame. While the camera stands still its last key frame is moved, not repeated.
    void follow(const scene::Camera& camera, double now);
    /// With a last key frame at `now`.
    scene::CameraPath end(const scene::Camera& camera, double now);

  private:
    void note(const scene::Camera& camera, double seconds);

    std::optional<double> start_;
    scene::CameraPath path_;
};

/// Leads a camera along a path.
class Playback {
  public:
    bool isPlaying() const { return !path_.empty(); }
    void begin(scene::CameraPath path, double now);
    void stop() { path_.clear(); }
    /// The camera at `now`; at the end of the path, the playback stops.
    scene::Camera follow(double now);

  private:
    scene::CameraPath path_;
    double start_ = 0.0;
};

}  // namespace fluxwalk::app
