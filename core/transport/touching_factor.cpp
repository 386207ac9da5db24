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

/// From this ratio of areas on, a touching pair's exchange is seen from the smaller element alone.
constexpr double kMuchLarger = 2.0;

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

// How many of a cell's middle and corners x and they face each other; the corners run counter-clockwise seen
// from the front.
unsigned countFacing(const ElementGrid::Point& x, const Source& source, const GridCell& cell,
                     const ElementGrid::Point& middle, std::array<Vec3d, 4>& corners) {
    const bool isTriangle = source.points.cornerCount == 3;
    const std::array<base::Vec2d, 4> at{cell.lower, base::Vec2d(cell.upper.x, cell.lower.y), cell.upper,
                                        base::Vec2d(cell.lower.x, cell.upper.y)};
    const auto isFacing = [&x](const ElementGrid::Point& p) {
        const Vec3d to = x.position - p.position;
        return glm::dot(p.normal, to) > 0.0 && glm::dot(x.normal, to) < 0.0;
    };
    unsigned count = isFacing(middle) ? 1u : 0u;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const ElementGrid::Point corner = pointAt(source.sampler, isTriangle, at[i]);
        corners[i] = corner.position;
        count += isFacing(corner) ? 1u : 0u;
    }
    if (glm::dot(glm::cross(corners[2] - corners[0], corners[3] - corners[1]), middle.normal) < 0.0) {
        std::swap(corners[1], corners[3]);
    }
    return count;
}

// Factor of a cell that x is near to. Where all of it faces x its contour says it, however near x is;
// neighbours share their edges, whose curving then cancels. Else it is quartered, until its parts are farther
// away than they are wide; what is left within 2^-kMostCuts of the cell counts as a disc.
double nearCellFactor(const ElementGrid::Point& x, const Source& source, const GridCell& cell,
                      const ElementGrid::Point& middle, unsigned cuts) {
    constexpr unsigned kMostCuts = 5;
    constexpr unsigned kAll = 5;
    if (cuts > 0) {
        std::array<Vec3d, 4> corners;
        const unsigned count = countFacing(x, source, cell, middle, corners);
        if (count == kAll || cuts == kMostCuts) {
            return pointToPolygon(x.position, x.normal, corners);
        }
        if (count == 0 && cuts > 2) {
            return 0.0;
        }
    }
    const base::Vec2d half = 0.5 * (cell.upper - cell.lower);
    double sum = 0.0;
    for (unsigned i = 0; i < 4; ++i) {
        const base::Vec2d lower = cell.lower + base::Vec2d(i & 1u, i >> 1) * half;
        const ElementGrid::Point y =
            pointAt(source.sampler, source.points.cornerCount == 3, lower + 0.5 * half);
        const double part = source.points.area * source.grid.scale * y.weight * half.x * half.y;
        const Vec3d to = y.position - x.position;
        sum += glm::dot(to, to) < kCutWithin * part
                   ? nearCellFactor(x, source, {lower, lower + half}, y, cuts + 1)
                   : part * discKernel(x, y, part);
    }
    return sum;
}

// Whether x is near to a part of the source that is below its horizon or about to be: of the contour there,
// which follows the edges roughly, too much would be cut off.
bool hoversBelowHorizon(const ElementGrid::Point& x, const Source& source) {
    return source.leastFacing > 0.0 &&
           std::any_of(source.grid.points.begin(), source.grid.points.end(),
                       [&](const ElementGrid::Point& p) {
                           const Vec3d to = p.position - x.position;
                           return glm::dot(x.normal, to) <= 0.0 &&
                                  glm::dot(to, to) < kCutWithin * source.points.area * p.weight;
                       });
}

double pointFactor(const ElementGrid::Point& x, const Source& source) {
    const ElementPoints& points = source.points;
    const bool isFlatInFront = points.isFlat && glm::dot(points.axis, x.position - points.center) > 0.0;
    if (isFlatInFront || (!points.isFlat && facesAll(x.position, source.grid, source.leastFacing) &&
                          !hoversBelowHorizon(x, source))) {
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
                sum += nearCellFactor(x, source, {{kEnds[i], kEnds[j]}, {kEnds[i + 1], kEnds[j + 1]}}, y, 0);
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
    const auto viewFromA = [&] { return a.area * meanFactor(gridA, {b, gridB, onB, leastFacingOf(gridB)}); };
    const auto viewFromB = [&] { return b.area * meanFactor(gridB, {a, gridA, onA, leastFacingOf(gridA)}); };
    // Few points of a large element, or none, lie before a small one that touches it. (Foot of a column on
    // its torus: the factors of like elements of the shaft vary by 1 % instead of 20 to 30 %.)
    if (a.isFlat == b.isFlat && b.area > kMuchLarger * a.area) {
        return viewFromA();
    }
    if (a.isFlat == b.isFlat && a.area > kMuchLarger * b.area) {
        return viewFromB();
    }
    const double fromA = viewFromA();
    const double fromB = viewFromB();
    // Where surfaces lie upon each other the points of one stand over this or that element of the other: only
    // the view from its own points adds up to no more than 1 for an element.
    constexpr double kCloseShare = 0.6;
    if (std::max(fromA, fromB) > kCloseShare * std::min(a.area, b.area)) {
        return std::min(fromA, fromB);
    }
    const ViewWeights weights = weighViews(a, b, true);
    const double coupling = weights.atA * fromA + weights.atB * fromB;
    return coupling;
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
