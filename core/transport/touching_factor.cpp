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

double pointFactor(const ElementGrid::Point& x, const ElementPoints& source, const ElementGrid& grid,
                   double leastFacing) {
    const bool isFlatInFront = source.isFlat && glm::dot(source.axis, x.position - source.center) > 0.0;
    if (isFlatInFront || (!source.isFlat && facesAll(x.position, grid, leastFacing))) {
        return pointToPolygon(x.position, x.normal, std::span(source.contour.data(), source.contourCount));
    }
    if (source.isFlat) {
        return 0.0;
    }
    const double part = source.area / static_cast<double>(grid.points.size());
    double sum = 0.0;
    for (const ElementGrid::Point& y : grid.points) {
        const Vec3d to = y.position - x.position;
        const double r2 = glm::dot(to, to);
        const double c = facing(x, y, to);
        sum += c > 0.0 ? y.weight * c / (kPi * r2 * r2 + part * c) : 0.0;
    }
    return std::min(1.0, source.area * sum);
}

double meanFactor(const ElementGrid& receiver, const ElementPoints& source, const ElementGrid& grid) {
    const double leastFacing = leastFacingOf(grid);
    double mean = 0.0;
    for (const ElementGrid::Point& x : receiver.points) {
        mean += x.weight * pointFactor(x, source, grid, leastFacing);
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
            // The square root in a triangle's map is undone, so that the integrand stays smooth.
            const double s = nodeAt<side>(i);
            const SurfaceSample p = sampler.at({isTriangle ? s * s : s, nodeAt<side>(j)});
            const double weight =
                kGauss4Weight[i % 4] * kGauss4Weight[j % 4] * p.measure * (isTriangle ? s : 1.0);
            grid.points[side * j + i] = {p.position, p.normal, weight};
            sum += weight;
        }
    }
    for (auto& p : grid.points) {
        p.weight /= sum;
    }
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

double computeTouchingCoupling(const ElementPoints& a, const ElementGrid& gridA, const ElementPoints& b,
                               const ElementGrid& gridB) {
    const double fromA = a.area * meanFactor(gridA, b, gridB);
    const double fromB = b.area * meanFactor(gridB, a, gridA);
    // Where surfaces lie upon each other the points of one stand over this or that element of the other: only
    // the view from its own points adds up to no more than 1 for an element.
    constexpr double kCloseShare = 0.3;
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
