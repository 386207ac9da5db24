#pragma once

#include <vector>

#include "core/solve/point_gather.h"

namespace fluxwalk::solve {

/// How wrong a solution's own light probably is: what sources hand on to a point that gathers from them. Of
/// luminance, in lux or relative. Found from the solution alone, by points that gather anew what the leaves
/// around them were given.
struct SolutionErrors {
    /// By node: standard deviation of the irradiance that its radiosity was made from, lux: of leaves a
    /// pattern whose size is that of the products of what two points of one leaf find (which is free of their
    /// own noise and of how the light varies over the leaf), of nodes above them the area mean (neighbours
    /// err together).
    std::vector<float> ofNode;
    /// What is missing of all reflected light, relative (negative: there is too much), after all further
    /// reflections; and the standard error of that.
    double defect = 0.0;
    double defectError = 0.0;
};

/// The part of a source's radiosity that it reflects, lm/m2; nothing for lights and the sky.
Rgb reflectedBy(const Problem& problem, NodeId source);

/// Gathers at two points of each of `leaves` leaves, drawn by area.
SolutionErrors estimateSolutionErrors(const Problem& problem, std::size_t leaves = 384);

}  // namespace fluxwalk::solve
