#include <gtest/gtest.h>

#include "core/solve/audit.h"
#include "core/surface/region.h"
#include "core/surface/sphere.h"
#include "tests/support/curved_scenes.h"
#include "tests/support/solving.h"

// Check 10, negative test n2 and the paper's projected areas: what subdivision does to areas, and pull to
// power (ALGORITHMS 1.5).

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using surface::Region;
using test::Problem;

// Twice the vector area of the triangle of a region's corners.
Vec3d crossOf(const surface::Surface& sphere, std::uint32_t patch, const Region& region) {
    std::array<Vec3d, 3> c{};
    for (std::size_t i = 0; i < 3; ++i) {
        c[i] = sphere.evaluate(patch, region.corners[i]).position;
    }
    return glm::cross(c[1] - c[0], c[2] - c[0]);
}

/// Areas of a patch's elements at one level.
struct Areas {
    double polygons = 0.0;
    double surface = 0.0;
};

Areas areasAt(const surface::Surface& sphere, std::uint32_t patch, const Region& region, unsigned level) {
    if (level == 0) {
        return {.5 * glm::length(crossOf(sphere, patch, region)), sphere.area(patch, region)};
    }
    Areas sum;
    for (const Region& part : surface::childRegions(sphere, patch, region, surface::Split::quarters)) {
        const Areas areas = areasAt(sphere, patch, part, level - 1);
        sum.polygons += areas.polygons;
        sum.surface += areas.surface;
    }
    return sum;
}

// A sphere seen from outside in eight patches of four leaves each, of which only the middle ones shine.
std::unique_ptr<Problem> makeShining(solve::PullRule rule) {
    scene::Scene scene = test::glowingScene("sphere");
    test::addCurved(scene, "sphere", std::make_shared<surface::Sphere>(Vec3d(1, 2, 3), 1.5));
    solve::Options options;
    options.pullRule = rule;
    auto problem = test::makeProblem(std::move(scene), options);
    hierarchy::Hierarchy& h = problem->hierarchy;
    h.split(test::leavesOf(h), problem->executor);
    problem->links.index(h.nodeCount());
    for (const NodeId patch : h.patches()) {
        for (unsigned c = 0; c < 4; ++c) {
            h.light(h.child(patch, c)).emission = Rgb(c == 3 ? 1.0f : 0.0f);
        }
    }
    solve::Sweeper(*problem).sweep();
    return problem;
}

}  // namespace

TEST(CurvedAreas, leavesOfTheOctahedron) {
    const surface::Sphere sphere(Vec3d(1, 2, 3), 1.5);
    const double whole = 4.0 * base::kPi * 1.5 * 1.5;
    constexpr std::array<double, 6> kPolygons{.5513, .8290, .9513, .9874, .9968, .9992};
    for (unsigned level = 0; level < kPolygons.size(); ++level) {
        Areas sum;
        for (std::uint32_t patch = 0; patch < sphere.patchCount(); ++patch) {
            const Areas areas =
                areasAt(sphere, patch, surface::wholePatch(surface::PatchDomain::triangle), level);
            sum.polygons += areas.polygons;
            sum.surface += areas.surface;
        }
        EXPECT_NEAR(sum.polygons / whole, kPolygons[level], 1e-4) << level;
        EXPECT_NEAR(sum.surface / whole, 1.0, 1e-12) << level;
    }
}

// Negative test n2: children's power over their parent's planar area would grow at every pull, projected or
// not; true areas give 1.
TEST(CurvedAreas, planarParentsWouldCreatePower) {
    const surface::Sphere sphere(Vec3d(0.0), 1.0);
    const Region whole = surface::wholePatch(surface::PatchDomain::triangle);
    const Vec3d parent = crossOf(sphere, 0, whole);
    double plain = 0.0;
    double projected = 0.0;
    double surface = 0.0;
    for (const Region& part : surface::childRegions(sphere, 0, whole, surface::Split::quarters)) {
        const Vec3d child = crossOf(sphere, 0, part);
        plain += glm::length(child) / glm::length(parent);
        projected += glm::dot(child, parent) / glm::dot(parent, parent);
        surface += sphere.area(0, part) / sphere.area(0, whole);
    }
    EXPECT_NEAR(plain, 1.504, 1e-3);
    EXPECT_NEAR(projected, 1.4142, 1e-4);
    EXPECT_NEAR(surface, 1.0, 1e-12);
    // A face of the icosahedron, whose corners enclose 63.43 degrees: +22 % and +18 %.
    const double t = .5 * (1.0 + std::sqrt(5.0));
    const std::array<Vec3d, 3> c{glm::normalize(Vec3d(-1, t, 0)), glm::normalize(Vec3d(1, t, 0)),
                                 glm::normalize(Vec3d(0, 1, t))};
    std::array<Vec3d, 3> m{};
    for (std::size_t i = 0; i < 3; ++i) {
        m[i] = glm::normalize(c[i] + c[(i + 1) % 3]);
    }
    const Vec3d face = glm::cross(c[1] - c[0], c[2] - c[0]);
    const auto add = [&](const Vec3d& child, double& plainSum, double& projectedSum) {
        plainSum += glm::length(child) / glm::length(face);
        projectedSum += glm::dot(child, face) / glm::dot(face, face);
    };
    plain = projected = 0.0;
    add(glm::cross(m[1] - m[0], m[2] - m[0]), plain, projected);
    for (std::size_t i = 0; i < 3; ++i) {
        add(glm::cross(m[i] - c[i], m[(i + 2) % 3] - c[i]), plain, projected);
    }
    EXPECT_NEAR(plain, 1.218, 1e-3);
    EXPECT_NEAR(projected, 1.1756, 1e-4);
}

namespace {

// Area of the polygon of an element's corners.
double polygonArea(const hierarchy::Shape& shape) {
    const std::array<Vec3d, 3> c{Vec3d(shape.corners[0]), Vec3d(shape.corners[1]), Vec3d(shape.corners[2])};
    return .5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
}

/// How children's radiosities become their parent's.
enum class Pull { trueArea, plainArea };

// Solves the furnace inside a sphere, one level deep, over the hierarchy's nodes and links: gather, push and
// pull as sweeps do them, with constants. `gain` gets what one pull makes of constant light.
double solveFurnace(const Problem& problem, float rho, Pull rule, double& gain) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<double> radiosity(h.nodeCount(), 1.0);
    const auto pull = [&] {
        for (const NodeId patch : h.patches()) {
            double sum = 0.0;
            double area = 0.0;
            for (unsigned c = 0; c < 4; ++c) {
                const NodeId child = h.child(patch, c);
                const double part = rule == Pull::trueArea ? static_cast<double>(h.shape(child).area)
                                                           : polygonArea(h.shape(child));
                sum += part * radiosity[base::index(child)];
                area += static_cast<double>(h.shape(child).area);
            }
            radiosity[base::index(patch)] =
                sum / (rule == Pull::trueArea ? area : polygonArea(h.shape(patch)));
        }
    };
    pull();
    gain = radiosity[base::index(h.patches()[0])];
    for (int sweep = 0; sweep < 200; ++sweep) {
        std::vector<double> irradiance(h.nodeCount(), 0.0);
        for (const NodeId patch : h.patches()) {
            for (const std::uint32_t l : problem.links.endingAt(patch)) {
                const hierarchy::Link& link = problem.links.links[l];
                const NodeId source = link.a == patch ? link.b : link.a;
                irradiance[base::index(patch)] += static_cast<double>(link.transfer() / h.shape(patch).area) *
                                                  radiosity[base::index(source)];
            }
            for (unsigned c = 0; c < 4; ++c) {
                radiosity[base::index(h.child(patch, c))] =
                    1.0 + static_cast<double>(rho) * irradiance[base::index(patch)];
            }
        }
        pull();
    }
    return radiosity[base::index(h.child(h.patches()[0], 0))];
}

}  // namespace

// Negative test n2 in a solve: inside a glowing sphere, links between octants and light on their quarters. B
// = 1 / (1 - rho), or 1 / (1 - gain rho) with the gain of one pull where plain areas are divided by the
// parent's polygon: +50 % on the octahedron, so that rho = .7 has no solution.
TEST(PlainPull, furnaceGainsWhatItsPolygonsSay) {
    scene::Scene scene = test::glowingScene("sphere");
    test::addCurved(scene, "sphere", std::make_shared<surface::Sphere>(Vec3d(1, 2, 3), 1.5, true));
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::off;
    const auto problem = test::makeProblem(std::move(scene), options);
    test::refine(*problem, 1e9);
    hierarchy::Hierarchy& h = problem->hierarchy;
    ASSERT_EQ(h.patches().size(), 8u);
    h.split(test::leavesOf(h), problem->executor);
    problem->links.index(h.nodeCount());
    double gain = 0.0;
    EXPECT_NEAR(solveFurnace(*problem, .5f, Pull::trueArea, gain), 2.0, 1e-4);
    EXPECT_NEAR(gain, 1.0, 1e-6);
    EXPECT_NEAR(solveFurnace(*problem, .5f, Pull::plainArea, gain), 1.0 / (1.0 - .5 * 1.504), .01);
    EXPECT_NEAR(gain, 1.504, 1e-3);
    EXPECT_GT(solveFurnace(*problem, .7f, Pull::plainArea, gain), 1e4);
}

// An octant's middle quarter has the solid angle W = 2 atan(sqrt(2) / 5), the others (pi/2 - W) / 3 each,
// whose normals lean from the octant's by the angle of cosine (1 + 2 sqrt 2) / sqrt(3 ((1 + sqrt 2)^2 + 1)).
TEST(ProjectedPull, makesThePredictedPower) {
    const double middle = 2.0 * std::atan(std::sqrt(2.0) / 5.0);
    const double corner = (.5 * base::kPi - middle) / 3.0;
    const double root = 1.0 + std::sqrt(2.0);
    const double cosine = (1.0 + 2.0 * std::sqrt(2.0)) / std::sqrt(3.0 * (root * root + 1.0));
    const double trueShare = middle / (middle + 3.0 * corner);
    const double projectedShare = middle / (middle + 3.0 * corner * cosine);
    for (const bool isProjected : {false, true}) {
        const auto problem =
            makeShining(isProjected ? solve::PullRule::projected : solve::PullRule::trueArea);
        const double share = isProjected ? projectedShare : trueShare;
        for (const NodeId patch : problem->hierarchy.patches()) {
            EXPECT_NEAR(static_cast<double>(problem->hierarchy.light(patch).radiosity.g), share, 1e-5);
        }
        // 11.1 % of the power from nothing.
        EXPECT_NEAR(solve::auditEnergy(*problem, 1).pullDefect, share / trueShare - 1.0, 1e-5);
    }
}

TEST(ProjectedPull, keepsConstants) {
    const auto problem = makeShining(solve::PullRule::projected);
    hierarchy::Hierarchy& h = problem->hierarchy;
    for (const NodeId id : test::leavesOf(h)) {
        h.light(id).emission = Rgb(.7f);
    }
    solve::Sweeper(*problem).sweep();
    for (const NodeId patch : h.patches()) {
        EXPECT_FLOAT_EQ(h.light(patch).radiosity.g, .7f);
    }
    EXPECT_NEAR(solve::auditEnergy(*problem, 1).pullDefect, 0.0, 1e-6);
}

}  // namespace fluxwalk
