#include "viewer/session/still_job.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/base/check.h"

namespace fluxwalk::session {
namespace {

/// The means of a tile's squares of step x step pixels; those at the picture's edges may have fewer.
StillPart reduce(const image::Still& still, const image::StillTile& tile, std::uint32_t step) {
    StillPart part;
    part.place = {tile.left / step, tile.top / step, (tile.width + step - 1) / step,
                  (tile.height + step - 1) / step};
    part.luminance.reserve(std::size_t{3} * part.place.width * part.place.height);
    const std::uint32_t right = tile.left + tile.width;
    const std::uint32_t bottom = tile.top + tile.height;
    for (std::uint32_t top = tile.top; top < bottom; top += step) {
        for (std::uint32_t left = tile.left; left < right; left += step) {
            const std::uint32_t endX = std::min(left + step, right);
            const std::uint32_t endY = std::min(top + step, bottom);
            base::Rgb sum(0.0f);
            for (std::uint32_t y = top; y < endY; ++y) {
                for (std::uint32_t x = left; x < endX; ++x) {
                    const float* pixel = &still.luminance[3 * (std::size_t{y} * still.width + x)];
                    sum += base::Rgb(pixel[0], pixel[1], pixel[2]);
                }
            }
            sum /= static_cast<float>((endX - left) * (endY - top));
            part.luminance.insert(part.luminance.end(), {sum.r, sum.g, sum.b});
        }
    }
    return part;
}

}  // namespace

StillJob::StillJob(scene::Camera camera, const image::StillOptions& options, std::uint32_t step)
    : camera_(std::move(camera)), options_(options), step_(step) {
    FLUXWALK_CHECK(step > 0 && image::kTile % step == 0);
}

StillStatus StillJob::status() const {
    const std::lock_guard lock(mutex_);
    StillStatus status = status_;
    if (status.phase == StillPhase::running) {
        status.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    }
    return status;
}

void StillJob::cancel() {
    const std::lock_guard lock(mutex_);
    isCancelled_ = true;
    if (status_.phase == StillPhase::waiting) {
        status_.phase = StillPhase::cancelled;
    }
}

std::vector<StillPart> StillJob::takeParts() {
    const std::lock_guard lock(mutex_);
    return std::exchange(parts_, {});
}

std::shared_ptr<const image::Still> StillJob::still() const {
    const std::lock_guard lock(mutex_);
    return still_;
}

bool StillJob::begin() {
    const std::lock_guard lock(mutex_);
    if (status_.phase != StillPhase::waiting) {
        return false;
    }
    status_.phase = StillPhase::running;
    start_ = Clock::now();
    return true;
}

void StillJob::keep(const image::Still& still, const image::StillTile& tile) {
    StillPart part = reduce(still, tile, step_);
    const std::lock_guard lock(mutex_);
    parts_.push_back(std::move(part));
    hasParts_ = true;
}

void StillJob::end(StillPhase phase) {
    status_.phase = phase;
    status_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
}

void StillJob::run(const TakeStill& take, const std::function<void()>& between) {
    if (!begin()) {
        return;
    }
    image::StillCallbacks callbacks;
    callbacks.shouldStop = [this] { return isCancelled_.load(); };
    callbacks.tileDone = [this](const image::Still& still, const image::StillTile& tile) {
        keep(still, tile);
    };
    callbacks.progress = [this, &between](double progress) {
        {
            const std::lock_guard lock(mutex_);
            status_.progress = progress;
        }
        if (between) {
            between();
        }
    };
    try {
        auto still = std::make_shared<const image::Still>(take(camera_, options_, callbacks));
        const std::lock_guard lock(mutex_);
        const bool isWhole = still->rowsDone == still->height;
        if (hasParts_) {
            still_ = std::move(still);
        }
        end(isWhole ? StillPhase::done : StillPhase::cancelled);
    } catch (const std::exception& error) {
        // Most likely the memory of a large one; the solution stands.
        const std::lock_guard lock(mutex_);
        status_.failure = error.what();
        end(StillPhase::failed);
    }
}

}  // namespace fluxwalk::session
