#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "core/scene/polygons.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"
#include "tests/support/curved_scenes.h"
#include "tests/support/solving.h"

// Checks 12 to 14 and n4: a ball in a shell of radius 1. A part q^2 of all lines between points of the shell
// is blocked, and spherical harmonics are the eigenfunctions of what is left (ALGORITHMS 3.7).

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using test::Problem;

constexpr std::uint32_t kShell = 0;
constexpr std::uint32_t kBall = 1;

scene::Scene shellAndBall(const test::SurfacePtr& ball, float ballRho, float shellRho) {
    scene::Scene scene;
    const std::uint32_t shell = scene::addMaterial(scene, "shell", Rgb(shellRho), Rgb(1.0f));
    const std::uint32_t dark = scene::addMaterial(scene, "ball", Rgb(ballRho));
    scene.objects.push_back(
        {"shell", std::make_shared<const surface::Sphere>(Vec3d(1, 2, 3), 1.0, true), shell});
    scene.objects.push_back({"ball", ball, dark});
    return scene;
}

test::SurfacePtr makeBall(double q) {
    return std::make_shared<const surface::Sphere>(Vec3d(1, 2, 3), q);
}

// All leaves are linked to each other directly.
std::unique_ptr<Problem> linkLeaves(scene::Scene scene, double leafArea) {
    solve::Options options;
    options.minArea = leafArea;
    auto problem = test::makeProblem(std::move(scene), options);
    test::refine(*problem, 1e-9);
    return problem;
}

// Mean over a leaf of the cosine of the angle to the pole, from the centre.
double meanCosine(const Problem& problem, NodeId id) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    constexpr unsigned kSide = 16;
    double sum = 0.0;
    double measure = 0.0;
    for (unsigned i = 0; i < kSide * kSide; ++i) {
        const surface::RegionPoint at =
            surface::mapToRegion(h.region(id), {(i % kSide + .5) / kSide, (i / kSide + .5) / kSide});
        const surface::SurfacePoint p = h.surfaceOf(id).evaluate(h.name(id).patch, at.uv);
        const double weight = p.jacobian * at.jacobian;
        sum += weight * glm::normalize(p.position - Vec3d(1, 2, 3)).y;
        measure += weight;
    }
    return sum / measure;
}

/// A function on a sphere as c0 + c1 cos.
struct Legendre {
    double zeroth = 0.0;
    double first = 0.0;
};

template <class Value>
Legendre expand(const Problem& problem, std::uint32_t object, const Value& value) {
    Legendre result;
    double area = 0.0;
    double squares = 0.0;
    for (const NodeId id : test::leavesOf(problem.hierarchy)) {
        if (problem.hierarchy.name(id).object == object) {
            const auto a = static_cast<double>(problem.hierarchy.shape(id).area);
            const double c = meanCosine(problem, id);
            result.zeroth += a * value(id);
            result.first += a * c * value(id);
            squares += a * c * c;
            area += a;
        }
    }
    return {result.zeroth / area, result.first / squares};
}

// The shell emits 1 + cos: a constant on each leaf, scaled so that the whole has the first harmonic of that.
void lightByCosine(Problem& problem) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    double squares = 0.0;
    double area = 0.0;
    for (const NodeId id : test::leavesOf(h)) {
        if (h.name(id).object == kShell) {
            const auto a = static_cast<double>(h.shape(id).area);
            squares += a * meanCosine(problem, id) * meanCosine(problem, id);
            area += a;
        }
    }
    const double scale = area / (3.0 * squares);
    for (const NodeId id : test::leavesOf(h)) {
        if (h.name(id).object == kShell) {
            h.light(id).emission = Rgb(static_cast<float>(1.0 + scale * meanCosine(problem, id)));
        }
    }
    test::converge(problem, 1e-8);
}

Legendre irradiance(const Problem& problem, std::uint32_t object) {
    return expand(problem, object,
                  [&](NodeId id) { return static_cast<double>(problem.hierarchy.light(id).irradiance.g); });
}

// Of the shell, which emits 1 + cos itself.
Legendre shellRadiosity(const Problem& problem, double reflectance) {
    const Legendre arriving = irradiance(problem, kShell);
    return {1.0 + reflectance * arriving.zeroth, 1.0 + reflectance * arriving.first};
}

double shellToItself(Problem& problem) {
    const std::vector<double> sums = test::transport(
        problem, [&](NodeId id) { return problem.hierarchy.name(id).object == kShell ? 1.0f : 0.0f; });
    return expand(problem, kShell, [&](NodeId id) { return sums[base::index(id)]; }).zeroth;
}

void expectNear(const Legendre& value, const Legendre& expected, double relative) {
    EXPECT_NEAR(value.zeroth / expected.zeroth, 1.0, relative);
    EXPECT_NEAR(value.first / expected.first, 1.0, relative);
}

class ConcentricSpheres : public testing::Test {
  protected:
    static void SetUpTestSuite() { problem_ = linkLeaves(shellAndBall(makeBall(.5), 0.0f, .5f), .05); }
    static void TearDownTestSuite() { problem_.reset(); }

    static void setReflectances(float ball, float shell) {
        hierarchy::Hierarchy& h = problem_->hierarchy;
        for (const NodeId id : test::leavesOf(h)) {
            h.light(id).reflectance = Rgb(h.name(id).object == kBall ? ball : shell);
        }
    }

    static std::unique_ptr<Problem> problem_;
};

std::unique_ptr<Problem> ConcentricSpheres::problem_;

/// The icosahedron whose corners lie on a ball.
test::SurfacePtr makeIcosahedron(double radius) {
    const double t = .5 * (1.0 + std::sqrt(5.0));
    const std::array<Vec3d, 12> corners{Vec3d{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                        {0, -1, t},      {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                        {t, 0, -1},      {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
    constexpr std::array<std::array<std::uint32_t, 3>, 20> kFaces{
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    surface::TriangleSoup data;
    for (const Vec3d& c : corners) {
        data.positions.emplace_back(Vec3d(1, 2, 3) + radius * glm::normalize(c));
    }
    data.triangles.assign(kFaces.begin(), kFaces.end());
    return std::make_shared<const surface::PolygonMesh>(std::move(data));
}

}  // namespace

TEST_F(ConcentricSpheres, blackBall) {
    setReflectances(0.0f, .5f);
    lightByCosine(*problem_);
    expectNear(shellRadiosity(*problem_, .5), {1.6, 1.103448}, .005);
    expectNear(irradiance(*problem_, kBall), {1.6, .973275}, .005);
}

TEST_F(ConcentricSpheres, reflectingBall) {
    setReflectances(.6f, .8f);
    lightByCosine(*problem_);
    expectNear(shellRadiosity(*problem_, .8), {3.571429, 1.321627}, .01);
    expectNear(irradiance(*problem_, kBall), {2.142857 / .6, .699429 / .6}, .01);
}

TEST_F(ConcentricSpheres, ballBlocksItsPart) {
    EXPECT_NEAR(shellToItself(*problem_) / .75, 1.0, .005);
    for (const double q : {.25, .8}) {
        const auto other = linkLeaves(shellAndBall(makeBall(q), 0.0f, .5f), .4);
        EXPECT_NEAR(shellToItself(*other) / (1.0 - q * q), 1.0, .005) << q;
    }
}

// Negative test n4: an inscribed icosahedron in the ball's place lets a part of what the ball blocks pass.
TEST(ConcentricSpheresNegative, polyhedronInTheBallsPlaceIsTold) {
    const auto problem = linkLeaves(shellAndBall(makeIcosahedron(.5), 0.0f, .5f), .2);
    EXPECT_NEAR(shellToItself(*problem), .8095, .005 * .8095);
    lightByCosine(*problem);
    EXPECT_NEAR(shellRadiosity(*problem, .5).zeroth, 1.680, .005 * 1.68);
}

}  // namespace fluxwalk
