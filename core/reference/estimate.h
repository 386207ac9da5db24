#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/photometry.h"
#include "core/base/vec.h"

namespace fluxwalk::reference {

/// Mean of independent samples with its standard error, per channel and of the luminance-weighted sum (whose
/// error does not follow from the channels', as they vary together).
struct Estimate {
    base::Vec3d mean{0.0};
    base::Vec3d standardError{0.0};
    double luminance = 0.0;
    double luminanceError = 0.0;
};

/// Running sums of samples; sums are added in a fixed order, so that results do not depend on threads.
struct SampleSums {
    std::uint64_t count = 0;
    base::Vec3d sum{0.0};
    base::Vec3d squares{0.0};
    double luminanceSquares = 0.0;

    void add(const base::Vec3d& sample) {
        ++count;
        sum += sample;
        squares += sample * sample;
        const double y = base::luminance(sample);
        luminanceSquares += y * y;
    }
    void add(const SampleSums& other) {
        count += other.count;
        sum += other.sum;
        squares += other.squares;
        luminanceSquares += other.luminanceSquares;
    }
    /// Needs two samples for an error; with fewer it is infinite (and the mean of none is 0).
    Estimate estimate() const {
        const auto n = static_cast<double>(count);
        Estimate result;
        if (count > 0) {
            result.mean = sum / n;
        }
        result.luminance = base::luminance(result.mean);
        for (int c = 0; c < 3; ++c) {
            result.standardError[c] = errorOf(squares[c], result.mean[c]);
        }
        result.luminanceError = errorOf(luminanceSquares, result.luminance);
        return result;
    }

  private:
    double errorOf(double sumOfSquares, double mean) const {
        if (count < 2) {
            return std::numeric_limits<double>::infinity();
        }
        const auto n = static_cast<double>(count);
        return std::sqrt(std::max(0.0, sumOfSquares / n - mean * mean) / (n - 1.0));
    }
};

}  // namespace fluxwalk::reference
