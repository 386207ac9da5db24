#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/photometry.h"
#include "core/solve/refine.h"
#include "core/solve/state.h"
#include "core/solve/sweep.h"

/// The stages of a solve one by one, and what tests read from a solution.
namespace fluxwalk::test {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using solve::Problem;

inline std::unique_ptr<Problem> makeProblem(scene::Scene scene, const solve::Options& options = {},
                                            unsigned threads = 2) {
    return std::make_unique<Problem>(std::make_shared<const scene::Scene>(std::move(scene)), options,
                                     threads);
}

/// Options that let links end at clusters in small scenes too.
inline solve::Options withClusterLinks() {
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::on;
    return options;
}

/// Refines all links to a threshold in lux.
inline bool refine(Problem& problem, double threshold) {
    return solve::refineLinks(problem, threshold, {}, {}).hasChanged;
}

/// Sweeps until a sweep moves less than `residual` of the power; returns their number, `most` if it never
/// does.
inline int converge(Problem& problem, double residual = 1e-7, int most = 1000) {
    solve::Sweeper sweeper(problem);
    // The first sweep may still read radiosities that nothing emits or reflects any more.
    sweeper.sweep();
    for (int i = 2; i <= most; ++i) {
        if (sweeper.sweep() <= residual) {
            return i;
        }
    }
    return most;
}

/// Leaves of the elements that take part, in the order of their ids.
inline std::vector<NodeId> leavesOf(const hierarchy::Hierarchy& h) {
    std::vector<NodeId> leaves;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (h.kind(id) == hierarchy::NodeKind::element && h.isLeaf(id) && h.shape(id).exposed > 0.0f) {
            leaves.push_back(id);
        }
    }
    return leaves;
}

/// Irradiance of a patch's side times its exposed area, in lm.
inline Vec3d arrivingFlux(const Problem& problem, std::uint32_t object, std::uint32_t patch, bool back) {
    const NodeId id = problem.hierarchy.patchNode(object, patch, back);
    if (id == NodeId::none) {
        return Vec3d(0.0);
    }
    return static_cast<double>(problem.hierarchy.shape(id).exposedArea()) *
           Vec3d(problem.hierarchy.light(id).irradiance);
}

/// Mean irradiance of one side of an object in lux, over its whole area.
inline Vec3d meanIrradiance(const Problem& problem, std::uint32_t object, bool back = false) {
    const surface::Surface& surface = *problem.scene->objects[object].surface;
    Vec3d flux(0.0);
    double area = 0.0;
    for (std::uint32_t p = 0; p < surface.patchCount(); ++p) {
        flux += arrivingFlux(problem, object, p, back);
        area += surface.area(p, surface::wholePatch(surface.domain(p)));
    }
    return flux / area;
}

/// Gives all elements one reflectance in every channel.
inline void setReflectance(Problem& problem, float reflectance) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        if (h.kind(NodeId{i}) == hierarchy::NodeKind::element) {
            h.light(NodeId{i}).reflectance = Rgb(reflectance);
        }
    }
}

/// What the leaves get when elements have radiosity `radiosity(leaf)` and light sources are off, at the index
/// of each leaf's node: links, push and pull as the solver does them. The solution that stands is kept.
inline std::vector<double> transport(Problem& problem, const std::function<float(NodeId)>& radiosity) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<hierarchy::Light> kept;
    std::vector<float> sent(h.nodeCount(), 0.0f);
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        kept.push_back(h.light(id));
        if (h.kind(id) == hierarchy::NodeKind::element && h.isLeaf(id)) {
            sent[i] = radiosity(id);
        }
    }
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        h.light(NodeId{i}) = {};
        h.light(NodeId{i}).emission = Rgb(sent[i]);
    }
    solve::Sweeper sweeper(problem);
    // The first sweep pulls the leaves' radiosity up, the second gathers it everywhere.
    sweeper.sweep();
    sweeper.sweep();
    std::vector<double> irradiance(h.nodeCount(), 0.0);
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        irradiance[i] = static_cast<double>(h.light(NodeId{i}).irradiance.g);
        h.light(NodeId{i}) = kept[i];
    }
    return irradiance;
}

/// Sums of the form factors that each leaf gathers, as they are transported: the ends of links are linear, so
/// this is not the sum of the coefficients of the leaf and its ancestors.
inline std::vector<double> transportedRowSums(Problem& problem) {
    return transport(problem, [](NodeId) { return 1.0f; });
}

/// A deviation of the leaves from what it should be, weighed by exposed area.
struct Deviations {
    double mean = 0.0;      ///< signed
    double meanSize = 0.0;  ///< of absolute values, as are the next two
    double percentile99 = 0.0;
    double largest = 0.0;
};

inline Deviations deviations(const Problem& problem, const std::function<double(NodeId)>& deviation) {
    Deviations result;
    std::vector<std::pair<double, double>> sizes;  // with their part of the area
    double area = 0.0;
    for (const NodeId id : leavesOf(problem.hierarchy)) {
        const double part = static_cast<double>(problem.hierarchy.shape(id).exposedArea());
        const double d = deviation(id);
        result.mean += part * d;
        result.meanSize += part * std::abs(d);
        area += part;
        sizes.emplace_back(std::abs(d), part);
    }
    result.mean /= area;
    result.meanSize /= area;
    std::sort(sizes.begin(), sizes.end());
    double passed = 0.0;
    for (const auto& [size, part] : sizes) {
        if (passed < .99 * area) {
            result.percentile99 = size;
        }
        passed += part;
        result.largest = size;
    }
    return result;
}

}  // namespace fluxwalk::test
