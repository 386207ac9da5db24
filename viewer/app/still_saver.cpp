#include "viewer/app/still_saver.h"

#include <chrono>
#include <exception>
#include <utility>

#include "core/base/check.h"
#include "core/cli/output.h"
#include "viewer/app/still_file.h"

namespace fluxwalk::app {

void StillSaver::begin(std::shared_ptr<const image::Still> still, std::filesystem::path file, double exposure,
                       render::ToneCurve curve) {
    FLUXWALK_CHECK(!isBusy());
    writing_ =
        std::async(std::launch::async, [still = std::move(still), file = std::move(file), exposure, curve] {
            Result result{file, {}};
            try {
                writeStill(file, *still, exposure, curve, false);
            } catch (const std::exception& error) {
                result.error = error.what();
            }
            return result;
        });
}

std::optional<StillSaver::Result> StillSaver::takeResult() {
    if (!isBusy() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return std::nullopt;
    }
    return writing_.get();
}

std::future<void> StillSaver::release() {
    return std::async(std::launch::async, [writing = std::move(writing_)]() mutable {
        if (writing.valid()) {
            if (const Result result = writing.get(); !result.error.empty()) {
                cli::printWarning(result.error);
            }
        }
    });
}

}  // namespace fluxwalk::app
