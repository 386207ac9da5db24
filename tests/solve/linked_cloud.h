#pragma once

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/hard_scenes.h"
#include "tests/support/solving.h"

namespace fluxwalk::test {

/// A cloud of 200 triangles, refined until clusters are linked at several levels.
inline std::unique_ptr<Problem> makeLinkedCloud(const solve::Options& options, unsigned threads = 2) {
    auto problem = makeProblem(buildCloud(200, 4), options, threads);
    for (const double threshold : {1e-2, 1e-3, 2e-4}) {
        refine(*problem, threshold);
        converge(*problem, 1e-3);
    }
    EXPECT_GT(problem->links.clusterLinks, 500u);
    return problem;
}

/// <u, T v> / <v, T u> by area for random radiosities u and v of the leaves: 1 where all that is transported
/// is reciprocal, links of elements, clusters and their slopes together.
inline double adjointRatio(Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const auto valueOf = [](NodeId id, std::uint64_t key) {
        return static_cast<float>(base::toUnit(base::mix(base::combine(key, base::index(id)))));
    };
    const auto u = [&](NodeId id) { return valueOf(id, 1); };
    const auto v = [&](NodeId id) { return valueOf(id, 2); };
    const std::vector<double> tu = transport(problem, u);
    const std::vector<double> tv = transport(problem, v);
    double utv = 0.0;
    double vtu = 0.0;
    for (const NodeId id : leavesOf(h)) {
        const auto area = static_cast<double>(h.shape(id).exposedArea());
        utv += area * static_cast<double>(u(id)) * tv[base::index(id)];
        vtu += area * static_cast<double>(v(id)) * tu[base::index(id)];
    }
    return utv / vtu;
}

}  // namespace fluxwalk::test
