#pragma once

#include <optional>

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

    /// The same with a and b exchanged.
    PairFactor swapped() const { return {coupling, gradientB, gradientA, spreadB, spreadA, evaluations}; }
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

/// Least cosine at which all points of a curved source must show themselves to a point, so that the source's
/// contour stands for it.
inline constexpr double kLeastFacing = 0.1;

/// How much the views from either end count in a pair's coupling; they sum to 1. Points of the smaller
/// element see the larger one's exact factor vary least, so they weigh more; where only one of two near
/// elements is flat, its exact factor seen from the curved one counts alone.
struct ViewWeights {
    double atA = 0.0;
    double atB = 0.0;
};
ViewWeights weighViews(const ElementPoints& a, const ElementPoints& b, bool isNear);

/// Exact point-to-polygon factors (Lambert's formula) averaged over both elements when near, 2 x 2 Gauss
/// pairs when far; true normals and measure on curved elements, whose contours take the place of polygons
/// where all of them faces the other's points: what a point receives from a surface that it sees from the
/// front alone depends on the contour only. A pure function of the two, symmetric in
/// their roles. (ALGORITHMS 1.7; Cohen and Wallace 1993, chapter 4.)
/// `coupling` takes the place of its own where a better one is known (touching_factor.h).
PairFactor computePairFactor(const ElementPoints& a, const ElementPoints& b,
                             const std::optional<double>& coupling = std::nullopt);

/// Form factor from a point to an element: the irradiance at x per unit of the element's radiosity,
/// unoccluded.
double computePointFactor(const Vec3d& x, const Vec3d& normal, const ElementPoints& source);
/// The same for eight points.
Lanes computePointFactors(const base::Lanes3& x, const base::Lanes3& normal, const ElementPoints& source);

}  // namespace fluxwalk::transport
