#pragma once

#include "core/transport/element_points.h"

/// Form factors between elements, without occlusion, in SIMD batches of eight points.
namespace fluxwalk::transport {

/// Unoccluded exchange of a pair of elements a, b.
struct PairFactor {
    double coupling = 0.0;  ///< g = A_a F(a<-b) = A_b F(b<-a), m2
    /// F(x<-other) over the element, relative to its mean: 1 + gradient . local(x), see
    /// localPointCoordinates().
    base::Vec2d gradientA{};
    base::Vec2d gradientB{};
    /// Largest deviation from that linear function over the element's points, relative to the mean.
    double spreadA = 0.0;
    double spreadB = 0.0;
    std::uint32_t evaluations = 0;  ///< kernel evaluations, points times edges or points
};

/// Linear fit of values at the eight points of an element.
struct LinearFit {
    double mean = 0.0;
    /// Relative to the mean. The function may be negative in places: only sums over all links are not.
    base::Vec2d gradient{};
    double deviation = 0.0;  ///< largest, absolute
    double largest = 0.0;    ///< value
};
LinearFit fitLinear(const ElementPoints& element, const std::array<double, base::kLanes>& values,
                    double mean);

/// Exact point-to-polygon factors (Lambert's formula) averaged over both elements when near, 2 x 2 Gauss
/// pairs when far; true normals and measure on curved elements, whose contours take the place of polygons
/// where all of them faces the other's points: what a point receives from a surface that it sees from the
/// front alone depends on the contour only. A pure function of the two, symmetric in
/// their roles. (ALGORITHMS 1.7; Cohen and Wallace 1993, chapter 4.)
PairFactor computePairFactor(const ElementPoints& a, const ElementPoints& b);

/// The same of an element with itself, from all pairs of its points: on a smooth hollow surface the kernel
/// stays finite where they meet. Gradients are 0, the spread is the largest deviation of the kernel.
PairFactor computeSelfFactor(const ElementPoints& element);

/// Form factor from a point to an element: the irradiance at x per unit of the element's radiosity,
/// unoccluded.
double computePointFactor(const Vec3d& x, const Vec3d& normal, const ElementPoints& source);

}  // namespace fluxwalk::transport
