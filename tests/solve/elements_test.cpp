#include "core/solve/elements.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// What a snapshot tells of the elements that its meshes show, and of the clusters above them.

namespace fluxwalk {
namespace {

using base::Vec3d;

std::unique_ptr<solve::Solver> solveCornell(double error) {
    solve::Options options;
    options.error = error;
    auto solver = std::make_unique<solve::Solver>(
        std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box")), options, 2);
    solver->solve({});
    return solver;
}

double triangleArea(const scene::LitMesh& mesh, std::size_t triangle) {
    const std::uint32_t* i = &mesh.triangles[3 * triangle];
    const Vec3d a(mesh.positions[i[0]]);
    return 0.5 * glm::length(glm::cross(Vec3d(mesh.positions[i[1]]) - a, Vec3d(mesh.positions[i[2]]) - a));
}

TEST(Elements, tileTheirMeshes) {
    const auto solver = solveCornell(0.05);
    const auto snapshot = solver->show({.elements = true});
    ASSERT_EQ(snapshot->elements.size(), snapshot->meshes.size());
    std::size_t leaves = 0;
    for (std::size_t m = 0; m < snapshot->meshes.size(); ++m) {
        const scene::LitMesh& mesh = *snapshot->meshes[m];
        const solve::MeshElements& elements = *snapshot->elements[m];
        ASSERT_EQ(elements.elementOf.size(), mesh.triangles.size() / 3);
        EXPECT_TRUE(elements.residual.empty());
        leaves += elements.level.size();
        std::vector<double> areas(elements.level.size(), 0.0);
        for (std::size_t t = 0; t < elements.elementOf.size(); ++t) {
            areas.at(elements.elementOf[t]) += triangleArea(mesh, t);
        }
        for (const double area : areas) {
            EXPECT_GT(area, 0.0);
        }
    }
    EXPECT_EQ(leaves, solver->problem().hierarchy.leafCount());
    EXPECT_TRUE(solver->show({})->elements.empty());
}

TEST(Elements, haveTheAreasOfTheirLevels) {
    const auto solver = solveCornell(0.05);
    const auto snapshot = solver->show({.elements = true});
    std::size_t compared = 0;
    for (std::size_t m = 0; m < snapshot->meshes.size(); ++m) {
        const scene::LitMesh& mesh = *snapshot->meshes[m];
        if (solver->problem().scene->objects[mesh.object].surface->patchCount() != 1) {
            continue;
        }
        const double whole = solver->problem().scene->objects[mesh.object].surface->area(
            0, surface::wholePatch(solver->problem().scene->objects[mesh.object].surface->domain(0)));
        const solve::MeshElements& elements = *snapshot->elements[m];
        std::vector<double> areas(elements.level.size(), 0.0);
        double sum = 0.0;
        for (std::size_t t = 0; t < elements.elementOf.size(); ++t) {
            areas[elements.elementOf[t]] += triangleArea(mesh, t);
        }
        for (std::size_t e = 0; e < areas.size(); ++e) {
            // The box's walls are no exact rectangles: their quarters are not quite equal.
            EXPECT_NEAR(areas[e] * std::pow(4.0, elements.level[e]), whole, 0.05 * whole);
            sum += areas[e];
            ++compared;
        }
        EXPECT_NEAR(sum, whole, 1e-5 * whole);
    }
    EXPECT_GT(compared, 100u);
}

TEST(Elements, edgesAreTheirBorders) {
    const auto solver = solveCornell(0.1);
    const auto snapshot = solver->show({.elements = true});
    for (std::size_t m = 0; m < snapshot->meshes.size(); ++m) {
        const scene::LitMesh& mesh = *snapshot->meshes[m];
        const solve::MeshElements& elements = *snapshot->elements[m];
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> sides;
        for (std::size_t t = 0; t < elements.elementOf.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [a, b] =
                    std::minmax(mesh.triangles[3 * t + k], mesh.triangles[3 * t + (k + 1) % 3]);
                sides[{a, b}].push_back(elements.elementOf[t]);
            }
        }
        std::size_t borders = 0;
        for (const auto& [ends, of] : sides) {
            borders += of.size() == 1 || of.front() != of.back() ? 1u : 0u;
        }
        ASSERT_EQ(elements.edges.size(), 2 * borders);
        for (std::size_t e = 0; e < elements.edges.size(); e += 2) {
            const auto& of = sides.at({elements.edges[e], elements.edges[e + 1]});
            EXPECT_TRUE(of.size() == 1 || of.front() != of.back());
        }
    }
}

TEST(Elements, residualsLeaveTheProblemAsItWas) {
    auto problem = test::makeProblem(*scene::buildScene("cornell-box"));
    problem->statistics.meanIrradiance = 100.0;
    test::refine(*problem, 5.0);
    solve::Sweeper(*problem).sweep();
    std::vector<hierarchy::Light> before;
    for (std::uint32_t i = 0; i < problem->hierarchy.nodeCount(); ++i) {
        before.push_back(problem->hierarchy.light(base::NodeId{i}));
    }
    const std::uint64_t sweeps = problem->statistics.counters.sweeps;
    const std::vector<float> residuals = solve::computeResiduals(*problem);
    EXPECT_EQ(problem->statistics.counters.sweeps, sweeps);
    for (std::uint32_t i = 0; i < problem->hierarchy.nodeCount(); ++i) {
        const hierarchy::Light& light = problem->hierarchy.light(base::NodeId{i});
        ASSERT_EQ(light.radiosity, before[i].radiosity);
        ASSERT_EQ(light.irradiance, before[i].irradiance);
        ASSERT_EQ(light.slopeS, before[i].slopeS);
        ASSERT_EQ(light.slopeT, before[i].slopeT);
        ASSERT_EQ(light.residual, before[i].residual);
    }
    // They are what the next sweep then does change.
    solve::Sweeper(*problem).sweep();
    double largest = 0.0;
    for (std::uint32_t i = 0; i < problem->hierarchy.nodeCount(); ++i) {
        const base::NodeId id{i};
        if (problem->hierarchy.kind(id) != hierarchy::NodeKind::element || !problem->hierarchy.isLeaf(id)) {
            continue;
        }
        const float changed =
            base::channelMean(glm::abs(problem->hierarchy.light(id).radiosity - before[i].radiosity));
        EXPECT_EQ(residuals[i], changed);
        largest = std::max(largest, static_cast<double>(changed));
    }
    EXPECT_GT(largest, 1.0);
}

TEST(Elements, residualsOfASolutionAreSmall) {
    const auto solver = solveCornell(0.1);
    const auto snapshot = solver->show({.residuals = true});
    for (const auto& elements : snapshot->elements) {
        ASSERT_EQ(elements->residual.size(), elements->level.size());
        for (const float residual : elements->residual) {
            EXPECT_LT(static_cast<double>(residual), 1e-2 * solver->statistics().meanIrradiance);
        }
    }
}

TEST(Clusters, holdEachOther) {
    const auto solver = solveCornell(0.1);
    const auto snapshot = solver->show({.clusters = true});
    ASSERT_TRUE(snapshot->clusters);
    ASSERT_FALSE(snapshot->clusters->empty());
    EXPECT_TRUE(snapshot->elements.empty());
    const solve::ClusterBox& root = snapshot->clusters->front();
    EXPECT_EQ(root.depth, 0u);
    std::vector<solve::ClusterBox> above;
    for (const solve::ClusterBox& box : *snapshot->clusters) {
        above.resize(box.depth);
        if (!above.empty()) {
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.lower, above.back().lower)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(box.upper, above.back().upper)));
        }
        above.push_back(box);
    }
    // Shared by later snapshots, as they never change.
    EXPECT_EQ(solver->show({.clusters = true})->clusters, snapshot->clusters);
}

}  // namespace
}  // namespace fluxwalk
