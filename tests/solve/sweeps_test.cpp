#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "tests/solve/plain_sweeps.h"
#include "tests/support/solving.h"

// Check 25: how many sweeps it takes.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using test::Problem;

// Ends of links become constants, as in the plain sweeps that the solver is compared to.
void flattenLinks(Problem& problem) {
    for (hierarchy::Link& link : problem.links.links) {
        link.gradientA = link.gradientB = {};
    }
}

void startFromEmission(Problem& problem) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        hierarchy::Light& light = h.light(NodeId{i});
        if (h.kind(NodeId{i}) == hierarchy::NodeKind::element) {
            light.irradiance = light.slopeS = light.slopeT = Rgb(0.0f);
            light.radiosity = light.emission;
        }
    }
}

// Unit cube, one element a face, floor emits 1.
std::unique_ptr<Problem> makeCube(float rho) {
    scene::Scene scene;
    const std::uint32_t bright = scene::addMaterial(scene, "bright", Rgb(rho), Rgb(1.0f));
    const std::uint32_t dark = scene::addMaterial(scene, "dark", Rgb(rho));
    const auto faces = [](unsigned which) { return scene::boxFaces(Vec3d(0.0), Vec3d(1.0), which, true); };
    scene::addPolygons(scene, "floor", bright, faces(scene::kBottom));
    scene::addPolygons(scene, "others", dark, faces(scene::kTop | scene::kAround));
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::off;
    options.minArea = 2.0;
    auto problem = test::makeProblem(std::move(scene), options);
    test::refine(*problem, 1e9);
    // The exact factors of the cube, .2 for its 15 pairs: the counts are those of the published matrix.
    for (hierarchy::Link& link : problem->links.links) {
        const bool isOpposite =
            glm::dot(problem->hierarchy.shape(link.a).axis, problem->hierarchy.shape(link.b).axis) < -.5f;
        link.coupling = isOpposite ? .199824896f : .200043776f;
    }
    flattenLinks(*problem);
    startFromEmission(*problem);
    return problem;
}

}  // namespace

TEST(Sweeps, cubeOfSixZones) {
    struct Row {
        float rho;
        int sweeps;
        double emitting, opposite, side;
    };
    // Radiosities of ALGORITHMS 3.4.
    for (const Row& row :
         {Row{.5f, 12, 1.09090910, .18174583, .18183627}, Row{.8f, 33, 1.55172415, .68955107, .68968119},
          Row{.9f, 67, 2.37288137, 1.52531055, 1.52545202}}) {
        const auto problem = makeCube(row.rho);
        hierarchy::Hierarchy& h = problem->hierarchy;
        solve::Sweeper sweeper(*problem);
        EXPECT_EQ(sweeper.blockCount(), 6u);
        int needed = 0;
        for (double error = 1.0; error >= 1e-6 && needed < 1000; ++needed) {
            sweeper.sweep();
            error = 0.0;
            for (const NodeId id : h.patches()) {
                const bool isOpposite = h.name(id).object == 1 && h.shape(id).axis.y < -.5f;
                const double exact = h.name(id).object == 0 ? row.emitting
                                     : isOpposite           ? row.opposite
                                                            : row.side;
                error = std::max(error, std::abs(static_cast<double>(h.light(id).radiosity.g) / exact - 1.0));
            }
        }
        EXPECT_NEAR(needed, row.sweeps, 1) << row.rho;
    }
}

// In a real scene: blocks are small enough for the speed of Gauss-Seidel, for any number of threads.
TEST(Sweeps, blockedGaussSeidelInTheCornellBox) {
    constexpr double kAccuracy = 1e-6;
    std::array<int, 2> blocked{};
    for (const unsigned threads : {1u, 2u}) {
        solve::Options options;
        options.clusterLinks = solve::ClusterLinks::off;  // the plain sweeps know elements only
        const auto problem = test::makeProblem(*scene::buildScene("cornell-box-unit"), options, threads);
        for (double threshold = 1e-4; threshold > 3e-6; threshold /= 4.0) {
            test::refine(*problem, threshold);
            test::converge(*problem, 1e-3);
        }
        test::refine(*problem, 4e-7);
        flattenLinks(*problem);
        const test::PlainSweeps plain(*problem);
        const std::vector<double> exact = plain.solve();
        EXPECT_GT(exact.size(), 500u);

        startFromEmission(*problem);
        solve::Sweeper sweeper(*problem);
        EXPECT_GE(sweeper.blockCount(), 8u);
        int& needed = blocked[threads - 1];
        do {
            sweeper.sweep();
            ++needed;
        } while (plain.errorOf(plain.radiosities(), exact) > kAccuracy && needed < 1000);
        if (threads == 1) {
            const int jacobi = plain.sweepsNeeded(test::PlainSweeps::Order::jacobi, exact, kAccuracy);
            const int sequential =
                plain.sweepsNeeded(test::PlainSweeps::Order::gaussSeidel, exact, kAccuracy);
            EXPECT_LE(needed, .65 * jacobi) << jacobi;
            EXPECT_LE(needed, 1.2 * sequential) << sequential;
        }
    }
    EXPECT_EQ(blocked[0], blocked[1]);
}

}  // namespace fluxwalk
