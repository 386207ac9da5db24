#include "core/scene/builders.h"

#include <gtest/gtest.h>

#include "core/solve/solver.h"

// Clusters and rays by other means solve to the same light.

namespace fluxwalk {
namespace {

solve::Statistics solveWith(rays::TreeBuilder clusters, rays::RayEngine rays, unsigned threads = 2) {
    solve::Options options;
    // A fixed threshold: the closed loop might go on by another level.
    options.threshold = 0.0005;
    options.clusters = clusters;
    options.rays = rays;
    options.clusterLinks = solve::ClusterLinks::on;
    solve::Solver solver(std::make_shared<const scene::Scene>(scene::buildCornellBox(base::Rgb(100.0f))),
                         options, threads);
    EXPECT_EQ(solver.solve({}), solve::Outcome::reachedError);
    return solver.statistics();
}

TEST(Builders, anyClustersAndRaysSolveToTheSameLight) {
    const solve::Statistics usual = solveWith(rays::TreeBuilder::sah, rays::RayEngine::embree);
    for (const auto clusters :
         {rays::TreeBuilder::sah, rays::TreeBuilder::hybrid, rays::TreeBuilder::embree}) {
        for (const auto engine : {rays::RayEngine::embree, rays::RayEngine::clusters}) {
            const solve::Statistics other = solveWith(clusters, engine);
            EXPECT_NEAR(other.meanIrradiance, usual.meanIrradiance, 0.005 * usual.meanIrradiance);
            EXPECT_NEAR(static_cast<double>(other.counters.links), static_cast<double>(usual.counters.links),
                        0.05 * static_cast<double>(usual.counters.links));
        }
    }
}

TEST(Builders, raysThroughClustersAreTheSameForAnyNumberOfThreads) {
    const auto solve = [](unsigned threads) {
        return solveWith(rays::TreeBuilder::hybrid, rays::RayEngine::clusters, threads);
    };
    const solve::Statistics one = solve(1);
    const solve::Statistics eight = solve(8);
    EXPECT_EQ(one.meanIrradiance, eight.meanIrradiance);
    EXPECT_EQ(one.counters.links, eight.counters.links);
    EXPECT_EQ(one.counters.rays, eight.counters.rays);
}

}  // namespace
}  // namespace fluxwalk
