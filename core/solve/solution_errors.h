#pragma once

#include <vector>

#include "core/solve/point_gather.h"

namespace fluxwalk::solve {

/// How wrong a solution's own light probably is: what sources hand on to a point that gathers from them. All
/// of luminance, in lux or relative. Found from the solution alone: probes gather anew what leaves were
/// given, and the differences say how large the links' estimates (link_errors.h) really are, and whether all
/// reflected light is too much or too little.
struct SolutionErrors {
    /// By node: standard deviation of the irradiance that the node's radiosity was made from, lux; of inner
    /// nodes the area mean of their leaves' (neighbours err together).
    std::vector<float> ofNode;
    /// Standard deviation of one factor on all reflected light: the relative defect that the probes found and
    /// its own standard error together, after all further reflections.
    double common = 0.0;
};

/// The part of a source's radiosity that it reflects, lm/m2; nothing for lights and the sky.
Rgb reflectedBy(const Problem& problem, NodeId source);

/// Gathers at `probes` points drawn by area.
SolutionErrors estimateSolutionErrors(const Problem& problem, std::size_t probes = 512);

}  // namespace fluxwalk::solve
