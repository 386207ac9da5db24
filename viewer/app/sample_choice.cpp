#include "viewer/app/sample_choice.h"

namespace fluxwalk::app {
namespace {

/// Seconds: slower pictures stutter.
constexpr double kSlow = 1.0 / 30.0;
/// Twice the samples take at most twice the time: below this they will not be slow.
constexpr double kFast = 1.0 / 75.0;
/// Pictures in a row before one believes it; longer upwards, so that it does not swing.
constexpr int kSlowInARow = 3;
constexpr int kFastInARow = 60;

}  // namespace

void SampleChoice::report(int samples, double seconds) {
    if (samples != whileMoving_) {
        return;
    }
    slow_ = seconds > kSlow ? slow_ + 1 : 0;
    fast_ = seconds < kFast ? fast_ + 1 : 0;
    if (slow_ >= kSlowInARow && whileMoving_ > 1) {
        whileMoving_ /= 2;
        slow_ = fast_ = 0;
    } else if (fast_ >= kFastInARow && whileMoving_ < most_) {
        whileMoving_ *= 2;
        slow_ = fast_ = 0;
    }
}

}  // namespace fluxwalk::app
