#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "core/image/still.h"
#include "viewer/render/tone.h"

namespace fluxwalk::app {

/// Writes stills beside the running window, one at a time.
class StillSaver {
  public:
    /// What came of it.
    struct Result {
        std::filesystem::path file;
        /// What was wrong; empty where it is written.
        std::string error;
    };

    bool isBusy() const { return writing_.valid(); }
    /// Begins to write *.exr or *.png, as writeStill() does; only while it is not busy.
    void begin(std::shared_ptr<const image::Still> still, std::filesystem::path file, double exposure,
               render::ToneCurve curve);
    /// To be called for each frame: what came of the last one, once.
    std::optional<Result> takeResult();
    /// Hands what is still being written to whoever waits for it; failures then go to standard error.
    std::future<void> release();

  private:
    std::future<Result> writing_;
};

}  // namespace fluxwalk::app
