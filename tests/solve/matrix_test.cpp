#include <gtest/gtest.h>

#include "core/reference/full_matrix.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/transport/exact_form_factor.h"
#include "tests/support/solving.h"

// Hierarchical and full-matrix solutions of tiny scenes. The matrix has exact form factors and its own rays.

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;
using scene::Scene;
using test::Problem;

std::vector<Vec3d> matrixMeans(const Scene& scene, unsigned level, unsigned visibilityRays) {
    const base::Executor executor(2);
    const rays::RayScene rays(scene, executor);
    std::vector<reference::ObjectSide> fronts;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        fronts.push_back({i, false});
    }
    const reference::FullMatrix matrix(scene, rays, executor, fronts, transport::polygonCoupling,
                                       {level, visibilityRays, 1});
    const reference::MatrixSolution solution = matrix.solve(reference::SweepKind::gaussSeidel, 1e-9);
    std::vector<Vec3d> flux(scene.objects.size(), Vec3d(0.0));
    std::vector<double> area(scene.objects.size(), 0.0);
    for (std::size_t i = 0; i < matrix.elements().size(); ++i) {
        const reference::MatrixElement& element = matrix.elements()[i];
        flux[element.object] += element.area * solution.irradiance[i];
        area[element.object] += element.area;
    }
    for (std::size_t i = 0; i < flux.size(); ++i) {
        flux[i] /= area[i];
    }
    return flux;
}

// The matrix's own error, that of its constant elements, is at most what its last quartering changed.
void expectAgreement(const Scene& scene, unsigned level, unsigned visibilityRays, double relative) {
    const std::vector<Vec3d> coarse = matrixMeans(scene, level - 1, visibilityRays);
    const std::vector<Vec3d> expected = matrixMeans(scene, level, visibilityRays);
    const auto problem = test::makeProblem(scene);
    for (double threshold = 1e-3; threshold > 5e-7; threshold /= 4.0) {
        test::refine(*problem, threshold);
        test::converge(*problem, 1e-6);
    }
    test::converge(*problem, 1e-9);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Vec3d mean = test::meanIrradiance(*problem, i);
        for (int c = 0; c < 3; ++c) {
            const double ownError = std::abs(expected[i][c] - coarse[i][c]);
            EXPECT_LE(ownError, .03 * expected[i][c]);
            EXPECT_NEAR(mean[c], expected[i][c], relative * expected[i][c] + ownError)
                << scene.objects[i].name << ", channel " << c;
        }
    }
}

}  // namespace

TEST(AgainstFullMatrix, wedge) {
    expectAgreement(scene::buildWedge(60.0, .7f), 4, 0, .001);
}

TEST(AgainstFullMatrix, parallelSquares) {
    expectAgreement(scene::buildParallelSquares(.5, .9f), 4, 0, .001);
}

TEST(AgainstFullMatrix, cubeWithOneEmittingFace) {
    Scene scene;
    const std::uint32_t bright = scene::addMaterial(scene, "bright", Rgb(.2f, .5f, .8f), Rgb(1.0f));
    const std::uint32_t dark = scene::addMaterial(scene, "dark", Rgb(.8f, .5f, .2f));
    const auto faces = [](unsigned which) { return scene::boxFaces(Vec3d(0.0), Vec3d(1.0), which, true); };
    scene::addPolygons(scene, "floor", bright, faces(scene::kBottom));
    scene::addPolygons(scene, "ceiling", dark, faces(scene::kTop));
    scene::addPolygons(scene, "sides", dark, faces(scene::kAround));
    expectAgreement(scene, 3, 0, .002);
}

// A screen in the way; its light is lost.
TEST(AgainstFullMatrix, squaresWithAScreenBetween) {
    Scene scene = scene::buildParallelSquares(1.0, .5f);
    const std::uint32_t black = scene::addMaterial(scene, "black", Rgb(0.0f));
    scene::addPolygons(scene, "screen", black,
                       {{Vec3d(.2, .5, .3), {.2, .5, .8}, {.7, .5, .8}, {.7, .5, .3}}});
    expectAgreement(scene, 4, 16, .005);
}

}  // namespace fluxwalk
