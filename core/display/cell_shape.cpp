#include "core/display/cell_shape.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::display {

namespace {

/// Edges shorter than this part of those across are points.
constexpr double kPoint = 1e-9;

Axis otherThan(Axis axis) {
    return axis == Axis::x ? Axis::y : Axis::x;
}

// Whether one of a triangle's angles has a larger cosine. Without area it has.
bool isSharp(const Vec3d& a, const Vec3d& b, const Vec3d& c, double cosine) {
    const Vec3d ab = b - a;
    const Vec3d bc = c - b;
    const Vec3d ca = a - c;
    const double lab = glm::length(ab);
    const double lbc = glm::length(bc);
    const double lca = glm::length(ca);
    return -glm::dot(ab, ca) >= cosine * lab * lca || -glm::dot(ab, bc) >= cosine * lab * lbc ||
           -glm::dot(bc, ca) >= cosine * lbc * lca;
}

}  // namespace

SurfaceSample sampleAt(const surface::Surface& surface, std::uint32_t patch, const Vec2d& uv) {
    const surface::SurfacePoint at = surface.evaluate(patch, uv);
    return {uv, at.position, at.normal, patch};
}

QuadSamples::QuadSamples(const surface::Surface& surface, std::uint32_t patch,
                         const surface::Region& region) {
    std::array<Vec2d, 9> uv;
    const auto& c = region.corners;
    for (unsigned k = 0; k < 4; ++k) {
        uv[2 * k] = c[k];
        uv[2 * k + 1] = surface.splitPoint(patch, c[k], c[(k + 1) % 4]);
    }
    uv[8] = surface.splitPoint(patch, uv[7], uv[3]);
    for (unsigned i = 0; i < 9; ++i) {
        samples[i] = sampleAt(surface, patch, uv[i]);
    }
}

CellShape::Samples QuadSamples::pointers() const {
    CellShape::Samples all{};
    for (unsigned i = 0; i < 9; ++i) {
        all[i] = &samples[i];
    }
    return all;
}

CellShape::CellShape(const Samples& samples) : samples_(samples) {
    for (unsigned side = 0; side < 4; ++side) {
        lengths_[side] =
            glm::distance(corner(side), middle(side)) + glm::distance(middle(side), corner(side + 1));
    }
}

double CellShape::longestAlong(Axis axis) const {
    const unsigned side = axis == Axis::x ? 0 : 1;
    return std::max(lengthOf(side), lengthOf(side + 2));
}

double CellShape::meanAlong(Axis axis) const {
    const unsigned side = axis == Axis::x ? 0 : 1;
    return 0.5 * (lengthOf(side) + lengthOf(side + 2));
}

double CellShape::turnAlong(Axis axis) const {
    // Rows of three, of indices of samples.
    constexpr std::array<std::array<std::array<unsigned, 3>, 3>, 2> kRows{
        {{{{0, 1, 2}, {7, 8, 3}, {6, 5, 4}}}, {{{0, 7, 6}, {1, 8, 5}, {2, 3, 4}}}}};
    double most = 0.0;
    for (const auto& row : kRows[static_cast<unsigned>(axis)]) {
        most = std::max(most, glm::distance(normal(row[0]), normal(row[1])) +
                                  glm::distance(normal(row[1]), normal(row[2])));
    }
    return most;
}

bool CellShape::turnsBeyond(double angle) const {
    constexpr double kRounding = 1.0 + 1e-9;
    const double chord = 2.0 * std::sin(0.5 * angle) * kRounding;
    for (unsigned k = 0; k < 4; ++k) {
        const Vec3d between = normal(k) - normal(k + 4);
        if (glm::dot(between, between) > chord * chord) {
            return true;
        }
    }
    return false;
}

double CellShape::riseOf(unsigned side) const {
    return glm::distance(middle(side), 0.5 * (corner(side) + corner(side + 1)));
}

double CellShape::bendOf(unsigned side) const {
    const double rise = riseOf(side);
    return rise > 0.0 ? 2.0 * rise / glm::distance(corner(side), corner(side + 1)) : 0.0;
}

double CellShape::riseOverWidth(unsigned side) const {
    const double rise = riseOf(side);
    return rise > 0.0 ? rise / std::min(lengthOf(side + 1), lengthOf(side + 3)) : 0.0;
}

bool CellShape::endsInPoint(Axis axis) const {
    const Axis across = otherThan(axis);
    const unsigned side = across == Axis::x ? 0 : 1;
    return std::min(lengthOf(side), lengthOf(side + 2)) <= kPoint * longestAlong(axis);
}

bool CellShape::isLonger(Axis axis, double ratio) const {
    return meanAlong(axis) > ratio * meanAlong(otherThan(axis));
}

bool CellShape::hasAngleBelow(double cosine) const {
    const Vec3d& center = samples_[8]->position;
    for (unsigned k = 0; k < 4; ++k) {
        if (isSharp(center, corner(k), corner(k + 1), cosine) ||
            isSharp(center, corner(k), middle(k), cosine) ||
            isSharp(center, middle(k), corner(k + 1), cosine)) {
            return true;
        }
    }
    return false;
}

}  // namespace fluxwalk::display
