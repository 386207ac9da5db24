#pragma once

#include <span>

#include "tests/bench/convergence.h"

/// What a solve costs where its error passes a target.
namespace fluxwalk::bench {

struct ErrorTarget {
    solve::ErrorOf what{};
    double error = 0.0;
};

struct Cost {
    bool isReached = false;
    double leaves = 0.0;
    double links = 0.0;
    double rays = 0.0;
    double seconds = 0.0;
    double cpuSeconds = 0.0;
    double bytes = 0.0;  ///< of nodes and links
};

/// Between two levels on a straight line in logarithms, as levels are a factor of four apart. Not reached
/// where no level is below the target.
Cost costAt(std::span<const Level> levels, const ErrorTarget& target);

}  // namespace fluxwalk::bench
