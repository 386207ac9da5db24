#include "core/transport/touching_factor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/photometry.h"
#include "core/transport/exact_form_factor.h"
#include "core/transport/gauss_points.h"

namespace fluxwalk::transport {

namespace {

using base::kPi;

// cos cos r2, without the parts of either that face away.
template <class Point>
double facing(const Point& a, const Point& b, const Vec3d& to) {
    return std::max(0.0, glm::dot(a.normal, to)) * std::max(0.0, -glm::dot(b.normal, to));
}

/// Parts of an element are cut further where a point is nearer to them than the root of this times their
/// area.
constexpr double kCutWithin = 2.0;

/// From this ratio of its sides on, the points of an element stand too far apart for sums over them.
constexpr double kElongated = 6.0;

// Least cosine at which the points of a source must show themselves, so that its contour stands for it. On
// long hollow ones (the inside of a cord) that is far better than a sum over points even where they are seen
// along the surface.
double leastFacingOf(const ElementGrid& grid) {
    const auto between = [&grid](std::size_t i, std::size_t j) {
        return glm::distance(grid.points[i].position, grid.points[j].position);
    };
    // A triangle's points crowd at one corner.
    const double along = std::max(between(0, 3), between(12, 15));
    const double across = std::max(between(0, 12), between(3, 15));
    return std::max(along, across) > kElongated * std::min(along, across) ? 0.0 : kLeastFacing;
}

bool facesAll(const Vec3d& x, const ElementGrid& source, double leastFacing) {
    return std::all_of(source.points.begin(), source.points.end(), [&](const ElementGrid::Point& p) {
        const Vec3d to = x - p.position;
        const double there = glm::dot(p.normal, to);
        return there > 0.0 && there * there > leastFacing * leastFacing * glm::dot(to, to);
    });
}

/// A part of an element as its grid's coordinates have it, for points near which the grid is too coarse.
struct GridCell {
    base::Vec2d lower{0.0};
    base::Vec2d upper{1.0};
};

/// An element with its grid, and how to find more of its points.
struct Source {
    const ElementPoints& points;
    const ElementGrid& grid;
    const ElementSampler& sampler;
    double leastFacing = kLeastFacing;
};

// Kernel of a part of `area` m2 about y seen from x, as a disc there would have it: K / (area K + 1) is exact
// on the disc's axis and leaves the kernel alone where it is finite by itself.
double discKernel(const ElementGrid::Point& x, const ElementGrid::Point& y, double area) {
    const Vec3d to = y.position - x.position;
    const double r2 = glm::dot(to, to);
    const double c = facing(x, y, to);
    return c > 0.0 ? c / (kPi * r2 * r2 + area * c) : 0.0;
}

ElementGrid::Point pointAt(const ElementSampler& sampler, bool isTriangle, const base::Vec2d& at) {
    // The square root in a triangle's map is undone, so that the integrand stays smooth.
    const SurfaceSample p = sampler.at({isTriangle ? at.x * at.x : at.x, at.y});
    return {p.position, p.normal, p.measure * (isTriangle ? at.x : 1.0)};
}

// Factor of a cell that x is near to: quartered until its parts are farther away than they are wide. What is
// left within 2^-kMostCuts of the cell lies so near that it fills a part of the view which the disc knows.
double cutCell(const ElementGrid::Point& x, const Source& source, const GridCell& cell, unsigned cuts) {
    constexpr unsigned kMostCuts = 5;
    const base::Vec2d half = 0.5 * (cell.upper - cell.lower);
    double sum = 0.0;
    for (unsigned i = 0; i < 4; ++i) {
        const base::Vec2d lower = cell.lower + base::Vec2d(i & 1u, i >> 1) * half;
        ElementGrid::Point y = pointAt(source.sampler, source.points.cornerCount == 3, lower + 0.5 * half);
        const double area = source.points.area * source.grid.scale * y.weight * half.x * half.y;
        const Vec3d to = y.position - x.position;
        if (cuts < kMostCuts && glm::dot(to, to) < kCutWithin * area) {
            sum += cutCell(x, source, {lower, lower + half}, cuts + 1);
        } else {
            sum += area * discKernel(x, y, area);
        }
    }
    return sum;
}

double pointFactor(const ElementGrid::Point& x, const Source& source) {
    const ElementPoints& points = source.points;
    const bool isFlatInFront = points.isFlat && glm::dot(points.axis, x.position - points.center) > 0.0;
    if (isFlatInFront || (!points.isFlat && facesAll(x.position, source.grid, source.leastFacing))) {
        return pointToPolygon(x.position, x.normal, std::span(points.contour.data(), points.contourCount));
    }
    if (points.isFlat) {
        return 0.0;
    }
    // Each Gauss point stands for as much of an interval as it weighs.
    constexpr std::array<double, 5> kEnds{0.0, kGauss4Weight[0], 0.5, 1.0 - kGauss4Weight[3], 1.0};
    double sum = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
            const ElementGrid::Point& y = source.grid.points[4 * j + i];
            const double area = points.area * y.weight;
            const Vec3d to = y.position - x.position;
            if (glm::dot(to, to) < kCutWithin * area) {
                sum += cutCell(x, source, {{kEnds[i], kEnds[j]}, {kEnds[i + 1], kEnds[j + 1]}}, 1);
            } else {
                sum += area * discKernel(x, y, area);
            }
        }
    }
    return std::min(1.0, sum);
}

double meanFactor(const ElementGrid& receiver, const Source& source) {
    double mean = 0.0;
    for (const ElementGrid::Point& x : receiver.points) {
        mean += x.weight * pointFactor(x, source);
    }
    return mean;
}

// The 4-point rule in each of side / 4 parts of the interval.
template <std::size_t side>
double nodeAt(std::size_t i) {
    const std::size_t part = i / 4;
    return (static_cast<double>(part) + kGauss4[i % 4]) * (4.0 / static_cast<double>(side));
}

template <std::size_t side>
GaussGrid<side> makeGrid(const hierarchy::Hierarchy& hierarchy, NodeId id) {
    const ElementSampler sampler(hierarchy, id);
    const bool isTriangle = hierarchy.shape(id).cornerCount == 3;
    GaussGrid<side> grid;
    double sum = 0.0;
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            auto p = pointAt(sampler, isTriangle, {nodeAt<side>(i), nodeAt<side>(j)});
            const double weight = kGauss4Weight[i % 4] * kGauss4Weight[j % 4] * p.weight;
            grid.points[side * j + i] = {p.position, p.normal, weight};
            sum += weight;
        }
    }
    for (auto& p : grid.points) {
        p.weight /= sum;
    }
    // The rule's own weights sum to (side / 4)^2.
    grid.scale = static_cast<double>(side * side) / (16.0 * sum);
    return grid;
}

}  // namespace

ElementGrid makeElementGrid(const hierarchy::Hierarchy& hierarchy, NodeId id) {
    return makeGrid<4>(hierarchy, id);
}

SelfGrid makeSelfGrid(const hierarchy::Hierarchy& hierarchy, NodeId id) {
    return makeGrid<8>(hierarchy, id);
}

bool isCurvedContact(const ElementPoints& a, const ElementPoints& b) {
    return !(a.isPlanar && b.isPlanar) && glm::distance(a.center, b.center) < a.radius + b.radius;
}

double computeTouchingCoupling(const hierarchy::Hierarchy& hierarchy, NodeId idA, const ElementPoints& a,
                               NodeId idB, const ElementPoints& b) {
    const ElementGrid gridA = makeElementGrid(hierarchy, idA);
    const ElementGrid gridB = makeElementGrid(hierarchy, idB);
    const ElementSampler onA(hierarchy, idA);
    const ElementSampler onB(hierarchy, idB);
    const double fromA = a.area * meanFactor(gridA, {b, gridB, onB, leastFacingOf(gridB)});
    const double fromB = b.area * meanFactor(gridB, {a, gridA, onA, leastFacingOf(gridA)});
    // Where surfaces lie upon each other the points of one stand over this or that element of the other: only
    // the view from its own points adds up to no more than 1 for an element.
    constexpr double kCloseShare = 0.6;
    if (std::max(fromA, fromB) > kCloseShare * std::min(a.area, b.area)) {
        return std::min(fromA, fromB);
    }
    const ViewWeights weights = weighViews(a, b, true);
    return weights.atA * fromA + weights.atB * fromB;
}

PairFactor computeSelfFactor(const ElementPoints& element, const SelfGrid& grid) {
    PairFactor result;
    double weights = 0.0;
    double sum = 0.0;
    double least = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (std::size_t i = 0; i < grid.points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const SelfGrid::Point& x = grid.points[i];
            const SelfGrid::Point& y = grid.points[j];
            const Vec3d to = y.position - x.position;
            const double r2 = glm::dot(to, to);
            const double kernel = r2 > 0.0 ? facing(x, y, to) / (kPi * r2 * r2) : 0.0;
            least = std::min(least, kernel);
            largest = std::max(largest, kernel);
            sum += x.weight * y.weight * kernel;
            weights += x.weight * y.weight;
            ++result.evaluations;
        }
    }
    if (sum <= 0.0) {
        return result;
    }
    const double mean = sum / weights;
    // Of what an element sends in one direction it meets at most what faces against that direction, so the
    // length of its mean normal is the least part that leaves it. On long ones that is nearly what leaves,
    // where the points stand too far apart for their sum.
    Vec3d normal(0.0);
    for (const SelfGrid::Point& p : grid.points) {
        normal += p.weight * p.normal;
    }
    const double most = std::max(0.0, 1.0 - glm::length(normal));
    result.coupling = element.area * std::min(most, element.area * mean);
    result.spreadA = result.spreadB = std::max(largest - mean, mean - least) / mean;
    return result;
}

}  // namespace fluxwalk::transport
