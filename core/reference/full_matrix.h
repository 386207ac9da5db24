#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/rays/ray_scene.h"
#include "core/reference/random_sensors.h"
#include "core/scene/scene.h"
#include "core/surface/region.h"

/// Classical radiosity by brute force: every pair of equally subdivided elements, a dense matrix. An oracle
/// for tiny scenes of planar, untextured patches.
namespace fluxwalk::reference {

using base::Vec3d;

/// Coupling A_a F(a<-b) in m2 of two unoccluded polygons, corners counter-clockwise seen from the side that
/// radiates.
using PolygonCoupling = std::function<double(std::span<const Vec3d>, std::span<const Vec3d>)>;

struct FullMatrixOptions {
    /// Quarterings of every patch: 4^level elements.
    unsigned level = 0;
    /// Rays for each pair of elements, a square number; 0 where nothing can stand between (convex scenes).
    unsigned visibilityRays = 16;
    std::uint64_t seed = 1;
};

/// One element seen from one side.
struct MatrixElement {
    std::uint32_t object = 0;
    std::uint32_t patch = 0;
    surface::Path path = surface::kRootPath;
    bool back = false;
    surface::Region region;
    std::vector<Vec3d> corners;  ///< counter-clockwise seen from this side
    Vec3d normal{};
    double area = 0.0;
    Vec3d reflectance{};
    Vec3d emission{};         ///< lm/m2
    Vec3d lightIrradiance{};  ///< mean from lights without area, lux
};

/// Which values a sweep reads: those of the sweep before, or the newest.
enum class SweepKind : std::uint8_t { jacobi, gaussSeidel };

struct MatrixSolution {
    std::vector<Vec3d> radiosity;   ///< lm/m2, by element
    std::vector<Vec3d> irradiance;  ///< lux, by element
    unsigned sweeps = 0;
};

class FullMatrix {
  public:
    /// Elements of the given sides of all patches. Lights without area are integrated with shadow rays at 16
    /// points an element; the sky is not.
    FullMatrix(const scene::Scene& scene, const rays::RayScene& rays, const base::Executor& executor,
               std::span<const ObjectSide> sides, const PolygonCoupling& coupling,
               const FullMatrixOptions& options);

    std::span<const MatrixElement> elements() const { return elements_; }
    /// A_i F(i<-j) V in m2; symmetric.
    double coupling(std::size_t i, std::size_t j) const { return couplings_[i * elements_.size() + j]; }

    /// Sweeps from B = 0 until a sweep moves less power than `tolerance` times what the lights emit, or
    /// `maxSweeps` (at least 1) are done.
    MatrixSolution solve(SweepKind kind, double tolerance, unsigned maxSweeps = 100'000) const;

  private:
    std::vector<MatrixElement> elements_;
    std::vector<double> couplings_;
};

}  // namespace fluxwalk::reference
