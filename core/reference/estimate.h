#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/vec.h"

namespace fluxwalk::reference {

/// Mean of independent samples with its standard error, per channel.
struct Estimate {
    base::Vec3d mean{0.0};
    base::Vec3d standardError{0.0};
};

/// Running sums of samples; sums are added in a fixed order, so that results do not depend on threads.
struct SampleSums {
    std::uint64_t count = 0;
    base::Vec3d sum{0.0};
    base::Vec3d squares{0.0};

    void add(const base::Vec3d& sample) {
        ++count;
        sum += sample;
        squares += sample * sample;
    }
    void add(const SampleSums& other) {
        count += other.count;
        sum += other.sum;
        squares += other.squares;
    }
    /// Needs two samples for an error; with one it is infinite.
    Estimate estimate() const {
        const auto n = static_cast<double>(count);
        Estimate result;
        result.mean = sum / n;
        for (int c = 0; c < 3; ++c) {
            const double spread = std::max(0.0, squares[c] / n - result.mean[c] * result.mean[c]);
            result.standardError[c] = std::sqrt(spread / (n - 1.0));
        }
        return result;
    }
};

}  // namespace fluxwalk::reference
