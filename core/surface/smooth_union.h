#pragma once

#include <vector>

#include "core/surface/projectable.h"

namespace fluxwalk::surface {

struct Ball {
    Vec3d center{};
    double radius = 0.0;  ///< metres, of the sphere that it is when alone
};

/// Spheres that melt into each other where they come close: the surface f = 0 of
///   f(x) = T - sum (1 - |x - c|^2 / S^2)^3   over the balls whose reach S = 1.55 radius holds x.
/// f is twice continuously differentiable; along a ray it is a chain of polynomials of degree 6. The surface
/// has no parameterisation.
class SmoothUnion final : public Projectable {
  public:
    static constexpr std::size_t kMaxBalls = 32;

    /// One to kMaxBalls balls, radii above 0.
    explicit SmoothUnion(const std::vector<Ball>& balls);

    /// f: negative inside.
    double value(const Vec3d& x) const;
    Vec3d gradient(const Vec3d& x) const;

    std::optional<ProjectedPoint> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                            double tFar) const override;
    std::optional<ProjectedPoint> closestPoint(const Vec3d& position) const override;
    double normalVariation(const Vec3d& point, double radius) const override;
    bool isConvex() const override { return balls_.size() == 1; }
    Box bounds() const override { return box_; }

  private:
    struct Part {
        Vec3d center{};
        double radius = 0.0;
        double reachSquared = 0.0;  ///< S^2
    };
    std::vector<Part> balls_;
    Box box_;
};

}  // namespace fluxwalk::surface
