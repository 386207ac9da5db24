#include "core/reference/full_matrix.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/reference/photon_tracer.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/transport/exact_form_factor.h"
#include "tests/analytic/closed_forms.h"

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;
using reference::FullMatrix;
using reference::MatrixElement;
using reference::MatrixSolution;
using reference::ObjectSide;
using reference::SweepKind;
using scene::Scene;

FullMatrix makeMatrix(const Scene& scene, unsigned level, unsigned visibilityRays) {
    const base::Executor executor(2);
    const rays::RayScene rays(scene, executor);
    std::vector<ObjectSide> fronts;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        fronts.push_back({i, false});
    }
    return FullMatrix(scene, rays, executor, fronts, transport::polygonCoupling, {level, visibilityRays, 1});
}

// Unit cube whose floor (object 0) emits 1; its ceiling is object 1, the sides object 2.
Scene emittingCube(float rho) {
    Scene scene;
    const std::uint32_t bright = scene::addMaterial(scene, "bright", Rgb(rho), Rgb(1.0f));
    const std::uint32_t dark = scene::addMaterial(scene, "dark", Rgb(rho));
    const auto faces = [](unsigned which) { return scene::boxFaces(Vec3d(0.0), Vec3d(1.0), which, true); };
    scene::addPolygons(scene, "floor", bright, faces(scene::kBottom));
    scene::addPolygons(scene, "ceiling", dark, faces(scene::kTop));
    scene::addPolygons(scene, "sides", dark, faces(scene::kAround));
    return scene;
}

// Sweeps until every radiosity is within 1e-6 of the fixed point.
unsigned sweepsNeeded(const FullMatrix& matrix, SweepKind kind) {
    const MatrixSolution exact = matrix.solve(SweepKind::gaussSeidel, 1e-15);
    for (unsigned sweeps = 1; sweeps < 1000; ++sweeps) {
        const MatrixSolution solution = matrix.solve(kind, 0.0, sweeps);
        double error = 0.0;
        for (std::size_t i = 0; i < exact.radiosity.size(); ++i) {
            error = std::max(error, std::abs(solution.radiosity[i].x / exact.radiosity[i].x - 1.0));
        }
        if (error < 1e-6) {
            return sweeps;
        }
    }
    return 1000;
}

double meanIrradiance(const FullMatrix& matrix, const MatrixSolution& solution, std::uint32_t object,
                      int channel) {
    double power = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < matrix.elements().size(); ++i) {
        const MatrixElement& element = matrix.elements()[i];
        if (element.object == object) {
            power += element.area * solution.irradiance[i][channel];
            area += element.area;
        }
    }
    return power / area;
}

}  // namespace

// ALGORITHMS 3.4: one constant per face.
TEST(FullMatrix, cubeWithOneEmittingFace) {
    struct Row {
        float rho;
        double emitting, opposite, sides;
    };
    for (const Row& row :
         {Row{.5f, 1.09090910, .18174583, .18183627}, Row{.8f, 1.55172415, .68955107, .68968119},
          Row{.9f, 2.37288137, 1.52531055, 1.52545202}}) {
        const FullMatrix matrix = makeMatrix(emittingCube(row.rho), 0, 0);
        ASSERT_EQ(matrix.elements().size(), 6u);
        const MatrixSolution solution = matrix.solve(SweepKind::gaussSeidel, 1e-13);
        // The material's reflectance is a float: .8f and .9f differ from .8 and .9 in the eighth digit.
        EXPECT_NEAR(solution.radiosity[0].x, row.emitting, 1e-6);
        EXPECT_NEAR(solution.radiosity[1].x, row.opposite, 1e-6);
        for (std::size_t side = 2; side < 6; ++side) {
            EXPECT_NEAR(solution.radiosity[side].x, row.sides, 1e-6);
        }
    }
}

// Check 25: sweeps to 1e-6, and one fixed point for both kinds.
TEST(FullMatrix, sweepCountsOfTheCube) {
    struct Row {
        float rho;
        int jacobi, gaussSeidel;
    };
    for (const Row& row : {Row{.5f, 21, 12}, Row{.8f, 63, 33}, Row{.9f, 132, 67}}) {
        const FullMatrix matrix = makeMatrix(emittingCube(row.rho), 0, 0);
        EXPECT_NEAR(sweepsNeeded(matrix, SweepKind::jacobi), row.jacobi, 1);
        EXPECT_NEAR(sweepsNeeded(matrix, SweepKind::gaussSeidel), row.gaussSeidel, 1);
        const MatrixSolution jacobi = matrix.solve(SweepKind::jacobi, 1e-12);
        const MatrixSolution gaussSeidel = matrix.solve(SweepKind::gaussSeidel, 1e-12);
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_NEAR(jacobi.radiosity[i].x, gaussSeidel.radiosity[i].x, 1e-9);
        }
    }
}

// Check 18, table 3.6: exact as area means for every mesh whose rows sum to one.
TEST(FullMatrix, cieCubeMeans) {
    for (const float rho : {0.0f, .05f, .1f, .2f, .3f, .5f, .7f, .8f, .9f, .95f}) {
        const FullMatrix matrix = makeMatrix(scene::buildCie58(rho), 2, 0);
        const MatrixSolution solution = matrix.solve(SweepKind::gaussSeidel, 1e-12);
        const double expected = 10000.0 / (96.0 * (1.0 - static_cast<double>(rho)));
        EXPECT_NEAR(meanIrradiance(matrix, solution, 0, 0), expected, 1e-5 * expected) << rho;
    }
}

// Two plates of width and distance 1, each in 16 columns of 16 long elements.
Scene stripsInColumns(double length) {
    Scene scene;
    const std::uint32_t glowing = scene::addMaterial(scene, "glowing", Rgb(.8f), Rgb(1.0f));
    for (const auto& plate : scene::boxFaces({0, 0, 0}, {1, 1, length}, scene::kTop | scene::kBottom, true)) {
        scene::addPolygons(scene, "plate", glowing, scene::gridOf(plate, 16, 16));
    }
    return scene;
}

// Check 16, ALGORITHMS 3.8. The edge and the centre are gathered at points.
TEST(FullMatrix, strips) {
    const Scene scene = stripsInColumns(200.0);
    const FullMatrix matrix = makeMatrix(scene, 0, 0);
    const MatrixSolution solution = matrix.solve(SweepKind::gaussSeidel, 1e-10);
    const auto radiosityAt = [&](double x) {
        double irradiance = 0.0;
        for (std::size_t i = 0; i < matrix.elements().size(); ++i) {
            irradiance += transport::pointToPolygon({x, 0, 100}, {0, 1, 0}, matrix.elements()[i].corners) *
                          solution.radiosity[i].x;
        }
        return 1.0 + .8 * irradiance;
    };
    double power = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < matrix.elements().size(); ++i) {
        const MatrixElement& element = matrix.elements()[i];
        const double z = .5 * (element.corners[0].z + element.corners[2].z);
        if (element.object == 0 && std::abs(z - 100.0) < 30.0) {
            power += element.area * solution.radiosity[i].x;
            area += element.area;
        }
    }
    EXPECT_NEAR(radiosityAt(0.0), 1.4234929569, 5e-4);
    EXPECT_NEAR(radiosityAt(.5), 1.5367128314, 5e-4);
    EXPECT_NEAR(power / area, 1.4967718996, 1e-4);
}

// Elements that straddle a block's foot lose light twice, in their mean and in their visibility: the loss
// shrinks with the elements.
TEST(FullMatrix, furnaceWithOccludersConverges) {
    std::array<double, 3> worst{};
    for (unsigned level = 1; level <= worst.size(); ++level) {
        const FullMatrix matrix = makeMatrix(scene::buildFurnace(.5f, false), level, 16);
        const MatrixSolution solution = matrix.solve(SweepKind::gaussSeidel, 1e-7);
        for (const std::uint32_t object : {1u, 2u, 3u, 4u, 5u}) {
            worst[level - 1] =
                std::max(worst[level - 1], std::abs(meanIrradiance(matrix, solution, object, 0) - 2.0));
        }
    }
    EXPECT_LT(worst[1], .7 * worst[0]);
    EXPECT_LT(worst[2], .7 * worst[1]);
    EXPECT_LT(worst[2], .02);
}

// Two routes without common code: particles and the dense matrix. Elements are coarse, so 4 %.
TEST(FullMatrix, cornellBoxAgreesWithParticles) {
    const Scene scene = *scene::buildScene("cornell-box-unit");
    const FullMatrix matrix = makeMatrix(scene, 2, 16);
    const MatrixSolution solution = matrix.solve(SweepKind::gaussSeidel, 1e-9);
    const base::Executor executor(2);
    const rays::RayScene rays(scene, executor);
    const auto photons = reference::tracePhotons(scene, rays, executor, {5, 300'000});
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
        for (int c = 0; c < 3; ++c) {
            const reference::Estimate& e = photons.objectIrradiance[object][0];
            EXPECT_NEAR(meanIrradiance(matrix, solution, object, c), e.mean[c],
                        4.0 * e.standardError[c] + .04 * e.mean[c])
                << scene.objects[object].name;
        }
    }
}

TEST(FullMatrix, couplingsAreSymmetricAndDoNotDependOnThreads) {
    const Scene scene = *scene::buildScene("cornell-box-unit");
    const std::vector<ObjectSide> sides{{0, false}, {3, false}, {5, false}, {5, true}};
    const base::Executor one(1);
    const base::Executor three(3);
    const rays::RayScene rays(scene, one);
    const FullMatrix a(scene, rays, one, sides, transport::polygonCoupling, {1, 16, 2});
    const FullMatrix b(scene, rays, three, sides, transport::polygonCoupling, {1, 16, 2});
    for (std::size_t i = 0; i < a.elements().size(); ++i) {
        for (std::size_t j = 0; j < a.elements().size(); ++j) {
            EXPECT_EQ(a.coupling(i, j), b.coupling(i, j));
            EXPECT_EQ(a.coupling(i, j), a.coupling(j, i));
        }
    }
}

}  // namespace fluxwalk
