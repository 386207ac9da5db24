// Where the limit surface is: against closed values, uniform splines and plain recursive subdivision.
#include <cmath>

#include <gtest/gtest.h>

#include "core/surface/region.h"
#include "core/surface/subdivision_surface.h"
#include "tests/surface/cages.h"
#include "tests/surface/reference_subdivision.h"

namespace fluxwalk {

namespace {

using base::Vec2d;
using base::Vec3d;
using surface::ControlCage;
using surface::SubdivisionSurface;

/// Removes creases that are not infinitely sharp, which the reference does not know.
ControlCage withoutSoftCreases(ControlCage cage) {
    std::erase_if(cage.creases,
                  [](const surface::Crease& c) { return c.sharpness < surface::kInfinitelySharp; });
    return cage;
}

// Largest distance between limit positions of the reference's vertices and the surface at their parameters.
double distanceFromReference(const ControlCage& cage, unsigned levels) {
    test::ReferenceMesh mesh(cage);
    const SubdivisionSurface surface(cage);
    for (unsigned i = 0; i < levels; ++i) {
        mesh.subdivide();
    }
    double worst = 0.0;
    for (const auto& face : mesh.faces()) {
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            if (!mesh.isDart(face.corners[k])) {
                worst = std::max(worst, glm::distance(surface.evaluate(face.patch, face.uv[k]).position,
                                                      mesh.limitOf(face.corners[k])));
            }
        }
    }
    return worst;
}

struct AreaAndVolume {
    double area = 0.0;
    double volume = 0.0;
};

// Of the triangulated reference with its vertices on the limit surface.
AreaAndVolume measure(const test::ReferenceMesh& mesh) {
    AreaAndVolume sum;
    for (const auto& face : mesh.faces()) {
        for (std::size_t k = 2; k < face.corners.size(); ++k) {
            const Vec3d a = mesh.limitOf(face.corners[0]);
            const Vec3d b = mesh.limitOf(face.corners[k - 1]);
            const Vec3d c = mesh.limitOf(face.corners[k]);
            sum.area += .5 * glm::length(glm::cross(b - a, c - a));
            sum.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        }
    }
    return sum;
}

AreaAndVolume measure(const SubdivisionSurface& surface) {
    AreaAndVolume sum;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        const surface::Region whole = surface::wholePatch(surface.domain(patch));
        sum.area += surface.area(patch, whole);
        constexpr int kN = 64;
        for (int i = 0; i < kN; ++i) {
            for (int j = 0; j < kN; ++j) {
                // The map to triangles is smooth in the root of s.
                const double x = (i + .5) / kN;
                const bool isTriangle = whole.cornerCount == 3;
                const surface::RegionPoint at =
                    surface::mapToRegion(whole, {isTriangle ? x * x : x, (j + .5) / kN});
                const surface::SurfacePoint p = surface.evaluate(patch, at.uv);
                sum.volume += (isTriangle ? 2.0 * x : 1.0) * at.jacobian * p.jacobian *
                              glm::dot(p.position, p.normal) / (3.0 * kN * kN);
            }
        }
    }
    return sum;
}

std::array<double, 4> uniformBasis(double t) {
    const double s = 1.0 - t;
    return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

}  // namespace

// By the limit masks of Halstead, Kass and DeRose (1993) after one step.
TEST(SubdivisionLimit, cubeHasItsClosedValues) {
    const SubdivisionSurface cube(test::cubeCage());
    ASSERT_EQ(cube.patchCount(), 6u);
    EXPECT_LT(glm::distance(cube.evaluate(1, {.5, .5}).position, Vec3d(0, 0, 68.0 / 81.0)), 1e-14);
    EXPECT_LT(glm::distance(cube.evaluate(1, {0, 0}).position, Vec3d(-.5, -.5, .5)), 1e-13);
    EXPECT_LT(glm::distance(cube.evaluate(1, {0, 0}).normal, glm::normalize(Vec3d(-1, -1, 1))), 1e-10);
    EXPECT_LT(glm::distance(cube.evaluate(1, {.5, .5}).normal, Vec3d(0, 0, 1)), 1e-14);
}

TEST(SubdivisionLimit, agreesWithRecursiveSubdivision) {
    // Down to level 5 no vertex but the extraordinary ones lies in a cap, and those are exact.
    EXPECT_LT(distanceFromReference(test::cubeCage(), 5), 1e-12);
    EXPECT_LT(distanceFromReference(test::torusCage(5, 4), 4), 1e-12);
    EXPECT_LT(distanceFromReference(test::vaseCage(), 3), 1e-12);
    EXPECT_LT(distanceFromReference(withoutSoftCreases(test::mixedCage()), 5), 1e-12);
    EXPECT_LT(distanceFromReference(test::octahedronCage(), 5), 1e-12);
    EXPECT_LT(distanceFromReference(withoutSoftCreases(test::openLoopCage()), 5), 1e-12);
}

// Caps begin 2^-10 from extraordinary vertices: the next levels have vertices in them.
TEST(SubdivisionLimit, capsAreCloseToTheLimit) {
    for (const bool isLoop : {false, true}) {
        ControlCage cage = isLoop ? test::octahedronCage() : test::cubeCage();
        test::ReferenceMesh mesh(cage);
        const SubdivisionSurface surface(cage);
        for (unsigned level = 0; level < 4; ++level) {
            mesh.subdivide();
        }
        double worst = 0.0;
        for (unsigned level = 4; level < 14; ++level) {
            mesh.keepAroundFirst();
            mesh.subdivide();
            const std::set<std::uint32_t> near = mesh.aroundOf(0);
            for (const auto& face : mesh.faces()) {
                for (std::size_t k = 0; k < face.corners.size(); ++k) {
                    if (near.count(face.corners[k]) != 0) {
                        worst =
                            std::max(worst, glm::distance(surface.evaluate(face.patch, face.uv[k]).position,
                                                          mesh.limitOf(face.corners[k])));
                    }
                }
            }
        }
        EXPECT_GT(worst, 1e-12);
        EXPECT_LT(worst, 1e-5);
    }
}

TEST(SubdivisionLimit, regularCagesAreUniformSplines) {
    constexpr std::uint32_t kSides = 7;
    constexpr std::uint32_t kRings = 5;
    const ControlCage cage = test::torusCage(kSides, kRings);
    const SubdivisionSurface torus(cage);
    base::RandomStream random(1);
    for (int n = 0; n < 500; ++n) {
        const auto patch = static_cast<std::uint32_t>(n % 35);
        const Vec2d uv = random.next2();
        const auto bu = uniformBasis(uv.x);
        const auto bv = uniformBasis(uv.y);
        Vec3d expected(0.0);
        for (std::uint32_t i = 0; i < 4; ++i) {
            for (std::uint32_t j = 0; j < 4; ++j) {
                const std::uint32_t column = (patch / kRings + kSides + i - 1) % kSides;
                const std::uint32_t row = (patch % kRings + kRings + j - 1) % kRings;
                expected += bu[i] * bv[j] * cage.positions[column * kRings + row];
            }
        }
        EXPECT_LT(glm::distance(torus.evaluate(patch, uv).position, expected), 1e-14);
    }
}

TEST(SubdivisionLimit, areaAndVolumeAgreeWithFineMeshes) {
    for (const ControlCage& cage :
         {test::cubeCage(), test::octahedronCage(), withoutSoftCreases(test::mixedCage())}) {
        test::ReferenceMesh mesh(cage);
        for (int i = 0; i < 5; ++i) {
            mesh.subdivide();
        }
        const AreaAndVolume coarse = measure(mesh);
        mesh.subdivide();
        const AreaAndVolume fine = measure(mesh);
        const AreaAndVolume exact = measure(SubdivisionSurface(cage));
        // Meshes with vertices on the surface err by the square of their spacing.
        EXPECT_NEAR(fine.area + (fine.area - coarse.area) / 3.0, exact.area, 2e-5 * exact.area);
        EXPECT_NEAR(fine.volume + (fine.volume - coarse.volume) / 3.0, exact.volume, 2e-4 * exact.volume);
    }
}

// An edge sharp for s levels lies between the smooth one and the sharp one.
TEST(SubdivisionLimit, sharpnessGrades) {
    double last = -1.0;
    for (const float sharpness : {0.0f, 1.0f, 2.5f, 4.0f, surface::kInfinitelySharp}) {
        ControlCage cage = test::cubeCage();
        for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 7u}, {7u, 6u}, {6u, 4u}}) {
            cage.creases.push_back({a, b, sharpness});
        }
        const SubdivisionSurface surface(cage);
        const double height = surface.evaluate(1, {.5, 0}).position.z;
        EXPECT_GT(height, last + 1e-4) << sharpness;
        last = height;
    }
    // The closed crease is a curve of its own plane.
    EXPECT_NEAR(last, 1.0, 1e-14);
}

}  // namespace fluxwalk
