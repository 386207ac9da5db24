#pragma once

#include <cstddef>

#include "core/solve/state.h"

namespace fluxwalk::bench {

/// What transport costs on this machine, measured again over links of a solution, on all threads. In
/// nanoseconds of CPU time, which hardly depends on other work. Bare rays are rays::RayScene's, whose guard
/// takes 5 % of a bundle's time in Embree, and a fifth of a single ray's.
struct TransportCosts {
    std::size_t links = 0;        ///< in the sample
    std::size_t testedLinks = 0;  ///< in a sample of those that are not certainly open: others need no rays
    double perFactor = 0.0;       ///< form factor of a pair
    double perEvaluation = 0.0;   ///< the same by kernel evaluation
    double perCertificate = 0.0;  ///< look into the shaft of a pair
    double perRay = 0.0;          ///< visibility of a pair by ray: generation, bundle, weights
    double perBundledRay = 0.0;   ///< segments made beforehand, in bundles of 16
    double perSingleRay = 0.0;    ///< and one by one
};
TransportCosts measureTransportCosts(const solve::Problem& problem);

/// Parts of refinement by stage, from those costs and the solve's own counters; of the whole solve's CPU
/// time.
struct RefineShares {
    double formFactors = 0.0;
    double rays = 0.0;     ///< their generation included
    double tracing = 0.0;  ///< of `rays`, what the ray library takes
};
RefineShares estimateShares(const TransportCosts& costs, const solve::Counters& counters, double cpuSeconds);

}  // namespace fluxwalk::bench
