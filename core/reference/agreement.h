#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/reference/estimate.h"

namespace fluxwalk::reference {

/// Interval that a value claims for the truth; low == high for none.
struct Claim {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// How values agree with a reference of known standard errors. Relative to the reference's mean.
struct Agreement {
    std::size_t count = 0;
    double mean = 0.0;       ///< of the reference
    double rms = 0.0;        ///< without the reference's noise, whose square is taken off
    double noise = 0.0;      ///< RMS of its standard errors
    double bias = 0.0;       ///< mean of value - reference
    double biasError = 0.0;  ///< standard error of that by the reference's noise
    /// Intervals that the reference lies in, or outside by no more than 99 % of its own error.
    std::size_t held = 0;
    double medianWidth = 0.0;  ///< of the intervals, relative to their values
    /// Indices by how far values are off in units of the reference's error and the interval's half width
    /// together, worst first.
    std::vector<std::size_t> worst;
};

/// `claims` and `truth` are parallel; what has no finite error is left out.
Agreement compare(std::span<const Claim> claims, std::span<const Estimate> truth, std::size_t worstCount = 5);

}  // namespace fluxwalk::reference
