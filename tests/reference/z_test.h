#pragma once

#include <gtest/gtest.h>

#include "core/reference/estimate.h"

namespace fluxwalk::test {

/// Expects that an estimate agrees with `expected` within 4.5 standard errors (plus `rounding`), and that the
/// error is at most `resolution`, so that a wrong value could be told.
inline void expectEstimate(const reference::Estimate& estimate, const base::Vec3d& expected,
                           double resolution, double rounding = 1e-6) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_LE(estimate.standardError[c], resolution) << "channel " << c;
        EXPECT_NEAR(estimate.mean[c], expected[c], 4.5 * estimate.standardError[c] + rounding)
            << "channel " << c;
    }
}

inline void expectEstimate(const reference::Estimate& estimate, double expected, double resolution,
                           double rounding = 1e-6) {
    expectEstimate(estimate, base::Vec3d(expected), resolution, rounding);
}

}  // namespace fluxwalk::test
