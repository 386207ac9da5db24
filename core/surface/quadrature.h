#pragma once

#include <array>

#include "core/surface/region.h"

namespace fluxwalk::surface {

/// Integral over a region of `measure`, a function of (u,v), by 5 x 5 Gauss-Legendre points on the unit
/// square that maps to it.
template <typename Measure>
double integrateOver(const Region& region, const Measure& measure) {
    // The map to triangles has a root in s: s = x^2 makes it smooth.
    const bool isTriangle = region.cornerCount == 3;
    constexpr std::array<double, 5> kNodes{0.046910077030668004, 0.23076534494715845, 0.5,
                                           0.76923465505284155, 0.95308992296933200};
    constexpr std::array<double, 5> kWeights{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                             0.23931433524968324, 0.11846344252809454};
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        for (std::size_t j = 0; j < kNodes.size(); ++j) {
            const double s = isTriangle ? kNodes[i] * kNodes[i] : kNodes[i];
            const double slope = isTriangle ? 2.0 * kNodes[i] : 1.0;
            const RegionPoint at = mapToRegion(region, {s, kNodes[j]});
            sum += kWeights[i] * kWeights[j] * slope * at.jacobian * measure(at.uv);
        }
    }
    return sum;
}

}  // namespace fluxwalk::surface
