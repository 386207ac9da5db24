#include "viewer/ui/exposure_control.h"

#include <cmath>

namespace fluxwalk::ui {
namespace {

/// Seconds in which the automatic exposure settles.
constexpr double kSettlingTime = 0.25;
/// Stops that nobody sees.
constexpr double kUnseen = 0.005;

}  // namespace

bool ExposureControl::follow(double automatic, double seconds) {
    if (!isAutomatic && exposure > 0.0) {
        return false;
    }
    const double wanted = automatic * std::exp2(compensation);
    if (exposure == wanted) {
        return false;
    }
    const double stops = exposure > 0.0 ? std::log2(wanted / exposure) : 0.0;
    if (exposure <= 0.0 || std::abs(stops) < kUnseen) {
        exposure = wanted;
    } else {
        exposure *= std::exp2(stops * (1.0 - std::exp(-seconds / kSettlingTime)));
    }
    return true;
}

}  // namespace fluxwalk::ui
