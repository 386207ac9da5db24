#include "core/solve/turn.h"

#include <algorithm>

namespace fluxwalk::solve {

namespace {

/// Errors are estimates: what comes so near to the target would be refined again.
constexpr double kSureOf = 0.9;

// The largest threshold that met the target when it was tried last, 0 for none.
double thresholdFor(double error, const std::vector<HistoryEntry>& history) {
    double largest = 0.0;
    double least = history.empty() ? 0.0 : history.back().threshold;
    // From the newest back: only levels that were tightened from one to the next are of the present light.
    for (auto entry = history.rbegin(); entry != history.rend() && entry->threshold >= least; ++entry) {
        least = entry->threshold;
        if (entry->error >= 0.0 && entry->error <= kSureOf * error) {
            largest = std::max(largest, entry->threshold);
        }
    }
    return largest;
}

}  // namespace

Asked compareOptions(const Options& before, const Options& after, const std::vector<HistoryEntry>& history) {
    const bool linksMore = before.clusterLinks != after.clusterLinks;
    if (before.oracle != after.oracle || linksMore) {
        return {Turn::anew};
    }
    if (after.curvatureWeight < before.curvatureWeight || after.minArea > before.minArea) {
        return {Turn::coarser};
    }
    if (after.threshold <= 0.0 && before.threshold <= 0.0 && after.error > before.error) {
        const double threshold = thresholdFor(after.error, history);
        return threshold > 0.0 ? Asked{Turn::coarser, threshold} : Asked{};
    }
    if (after.curvatureWeight > before.curvatureWeight || after.minArea < before.minArea) {
        return {Turn::finer};
    }
    return {};
}

Asked mergeAsked(const Asked& earlier, const Asked& later) {
    if (later.turn == Turn::none || earlier.turn > later.turn) {
        return earlier;
    }
    return later;
}

bool needsNewSolver(const Options& before, const Options& after) {
    return before.seed != after.seed || before.clusters != after.clusters ||
           before.clusterModel != after.clusterModel || before.rays != after.rays ||
           before.visibilityRays != after.visibilityRays;
}

}  // namespace fluxwalk::solve
