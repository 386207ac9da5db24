#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/image/final_gather.h"

namespace fluxwalk::session {

enum class StillPhase : std::uint8_t {
    waiting,  ///< for a solution that can be gathered from
    running,
    done,
    cancelled,  ///< with what was done by then
    failed      ///< see StillStatus::failure
};

struct StillStatus {
    StillPhase phase = StillPhase::waiting;
    double progress = 0.0;  ///< in [0, 1]
    double seconds = 0.0;   ///< since the gathering began, or that it took
    std::string failure;

    bool isOver() const { return phase >= StillPhase::done; }
};

/// Part of a still that is final, one pixel for each square of so many as the job was made for.
struct StillPart {
    image::StillTile place;        ///< in pixels of the smaller picture
    std::vector<float> luminance;  ///< cd/m2, three a pixel, rows from the top
};

/// Takes a still of whatever solution it belongs to.
using TakeStill = std::function<image::Still(const scene::Camera&, const image::StillOptions&,
                                             const image::StillCallbacks&)>;

/// A still that is made on one thread (run) while others look at it; all but run() may be called from any.
class StillJob {
  public:
    /// `step`: the side of the squares of pixels that parts have the mean of; a power of two, 32 at most.
    StillJob(scene::Camera camera, const image::StillOptions& options, std::uint32_t step = 1);

    const scene::Camera& camera() const { return camera_; }
    const image::StillOptions& options() const { return options_; }

    StillStatus status() const;
    /// Ends it after the tiles at hand; at once where it waits.
    void cancel();
    /// The parts that became final since the last call.
    std::vector<StillPart> takeParts();
    /// The whole of it, black where it was not done; null until it is over, and where nothing was done.
    std::shared_ptr<const image::Still> still() const;

    /// Makes it with all of `take`'s threads, unless it is over. `between` (may be empty) is called on this
    /// thread, with nothing at work, after every strip.
    void run(const TakeStill& take, const std::function<void()>& between);

  private:
    using Clock = std::chrono::steady_clock;

    bool begin();
    void keep(const image::Still& still, const image::StillTile& tile);
    void end(StillPhase phase);

    const scene::Camera camera_;
    const image::StillOptions options_;
    const std::uint32_t step_;
    std::atomic<bool> isCancelled_{false};
    mutable std::mutex mutex_;
    // All below are guarded by mutex_.
    StillStatus status_;
    Clock::time_point start_;
    std::vector<StillPart> parts_;
    bool hasParts_ = false;
    std::shared_ptr<const image::Still> still_;
};

}  // namespace fluxwalk::session
