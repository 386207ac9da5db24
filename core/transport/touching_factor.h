#pragma once

#include "core/transport/element_sampler.h"
#include "core/transport/form_factor.h"

/// Form factors of curved elements that touch each other, and of hollow ones with themselves, where the
/// kernel varies too much for the few points of ElementPoints.
namespace fluxwalk::transport {

/// Gauss points of an element's true surface with their normals; weights sum to 1.
template <std::size_t side>
struct GaussGrid {
    struct Point {
        Vec3d position{};
        Vec3d normal{};
        double weight = 0.0;
    };
    std::array<Point, side * side> points;
    double scale = 1.0;  ///< of measures that sum to 1 over the unit square
};
using ElementGrid = GaussGrid<4>;
/// Twice as many, as the pairs that fall together are left out.
using SelfGrid = GaussGrid<8>;
ElementGrid makeElementGrid(const hierarchy::Hierarchy& hierarchy, NodeId id);
SelfGrid makeSelfGrid(const hierarchy::Hierarchy& hierarchy, NodeId id);

/// Whether the bounding spheres of two elements meet and one of them is curved.
bool isCurvedContact(const ElementPoints& a, const ElementPoints& b);

/// Coupling g = A_a F(a<-b) in m2 without occlusion: points of the one look at the contour of the other where
/// all of it faces them, else at its points, more of them where it is near. Symmetric in the two.
double computeTouchingCoupling(const hierarchy::Hierarchy& hierarchy, NodeId idA, const ElementPoints& a,
                               NodeId idB, const ElementPoints& b);

/// Exchange of an element with itself, from all pairs of its points: on a smooth hollow surface the kernel
/// stays finite where they meet. No more than can stay on it by its normals. Gradients are 0, the spreads are
/// the largest deviation of the kernel.
PairFactor computeSelfFactor(const ElementPoints& element, const SelfGrid& grid);

}  // namespace fluxwalk::transport
