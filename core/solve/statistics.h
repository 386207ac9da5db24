#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace fluxwalk::solve {

/// Energy balance of the present solution, in lm per channel. emitted = absorbed + escaped + defect.
struct Audit {
    base::Vec3d emitted{0.0};
    base::Vec3d absorbed{0.0};
    /// Light that leaves the scene, counted by the solver's own rays.
    base::Vec3d escaped{0.0};
    /// Row sums of closed scenes without any scaling: area mean of |sum - 1| and its 99th percentile.
    double rowDefectMean = 0.0;
    double rowDefectP99 = 0.0;
    bool isClosed = false;
    /// What pull makes of the leaves' power on the way to their patches, relative to it: 0 but for rounding
    /// unless PullRule::projected is chosen.
    double pullDefect = 0.0;

    /// |emitted - absorbed - escaped| / emitted, over all channels.
    double relativeDefect() const;
};

/// Seconds spent in each stage.
struct StageTimes {
    double build = 0.0;
    double refine = 0.0;
    double sweep = 0.0;
    double audit = 0.0;
    double display = 0.0;
    double total = 0.0;
};

struct Counters {
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
    std::uint64_t links = 0;  ///< unordered pairs
    std::uint64_t waves = 0;
    std::uint64_t sweeps = 0;
    std::uint64_t rays = 0;
    std::uint64_t kernelEvaluations = 0;
    std::uint64_t certificates = 0;  ///< links whose visibility needed no ray
    std::uint64_t bytesNodes = 0;
    std::uint64_t bytesLinks = 0;
    std::uint64_t bytesCounted = 0;  ///< all that the solve takes, as budgets count it
};

/// One entry of the convergence history.
struct HistoryEntry {
    double seconds = 0.0;
    double threshold = 0.0;  ///< lux
    double residual = 0.0;   ///< relative change of power in the last sweep
    double error = 0.0;      ///< estimated p; negative while unknown
    std::uint64_t links = 0;
};

struct Statistics {
    Counters counters;
    StageTimes times;
    Audit audit;
    double threshold = 0.0;     ///< lux, of the present level
    double largestError = 0.0;  ///< lux, of a link as it stands: the threshold, or more where a limit left it
    double residual = 0.0;      ///< relative
    double estimatedError = -1.0;  ///< p, negative while unknown
    double meanIrradiance = 0.0;   ///< lux, mean of the channels over all reached sides
    std::vector<HistoryEntry> history;
};

}  // namespace fluxwalk::solve
