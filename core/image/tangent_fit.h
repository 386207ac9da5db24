#pragma once

#include <array>

#include "core/transport/element_points.h"

namespace fluxwalk::image {

using base::Vec3d;

/// Terms of a quadratic function of two coordinates: 1, a, b, a a, a b, b b.
inline constexpr std::size_t kTerms = 6;
using Terms = std::array<float, kTerms>;

/// Coordinates in an element's tangent plane, 0 in its middle, about 1 at its ends, and the quadratic
/// functions of them that fit values at the element's eight points best.
class TangentFit {
  public:
    TangentFit() = default;
    explicit TangentFit(const transport::ElementPoints& element);

    Terms termsAt(const Vec3d& position) const;
    /// Coefficients for values at the eight points.
    Terms fit(const base::Lanes& values) const;

  private:
    Vec3d middle_{};
    Vec3d along_{};   ///< unit tangent over the element's half length that way
    Vec3d across_{};  ///< likewise
    std::array<std::array<double, base::kLanes>, kTerms> solution_{};
};

/// Value of a fitted function.
inline float evaluate(const Terms& coefficients, const Terms& at) {
    float sum = 0.0f;
    for (std::size_t k = 0; k < kTerms; ++k) {
        sum += coefficients[k] * at[k];
    }
    return sum;
}

}  // namespace fluxwalk::image
