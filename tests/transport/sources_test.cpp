
#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/transport/coefficients.h"
#include "core/transport/exact_form_factor.h"
#include "core/transport/visibility.h"
#include "tests/support/statistics.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3d;
using test::Built;
using transport::Coefficient;
using transport::CoefficientService;
using transport::Query;

// A plate of `size` in z = 0 about the origin, normal +y; y is up.
test::Polygon plate(double size) {
    const double h = 0.5 * size;
    return {{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}};
}

Coefficient compute(const Built& built, NodeId element) {
    const Query query{element, built.tree.sources()[0], false};
    Coefficient out;
    CoefficientService(built.tree, built.rays).compute(std::span(&query, 1), std::span(&out, 1));
    return out;
}

// Mean irradiance per unit of the source.
double meanOf(const Built& built, NodeId element, const Coefficient& c) {
    return static_cast<double>(c.coupling) * static_cast<double>(c.visibility) /
           static_cast<double>(built.tree.shape(element).area);
}

scene::Scene lit(const scene::Light& light, const test::Polygon& polygon) {
    scene::Scene scene = test::sceneOf({polygon});
    scene.lights.push_back(light);
    return scene;
}

TEST(Sources, aPointLightGivesTheMeanOfCosineOverSquare) {
    scene::Light light;
    light.position = {0.3, 2.0, -0.4};
    const Built built(lit(light, plate(1.0)));
    const NodeId element = built.tree.patchNode(0, 0, false);
    const Coefficient c = compute(built, element);
    double sum = 0.0;
    constexpr int kCount = 200;
    for (int i = 0; i < kCount * kCount; ++i) {
        const Vec3d x((i % kCount + 0.5) / kCount - 0.5, 0.0,
                      (static_cast<double>(i / kCount) + 0.5) / kCount - 0.5);
        const Vec3d d = light.position - x;
        sum += d.y / std::pow(glm::length(d), 3.0);
    }
    EXPECT_NEAR(meanOf(built, element, c), sum / (kCount * kCount), 2e-4);
    EXPECT_EQ(c.visibility, 1.0f);
    EXPECT_LT(c.spreadA, 0.2f);
}

TEST(Sources, aSpotLightKeepsToItsCone) {
    scene::Light light;
    light.kind = scene::LightKind::spot;
    light.intensity = base::Rgb(3.0f, 6.0f, 1.0f);
    light.position = {0.0, 2.0, 0.0};
    light.innerConeAngle = 0.5;
    light.outerConeAngle = 0.8;
    // A small plate straight below, one on the slope of the cone, one outside.
    for (const double x : {0.0, 1.4, 3.0}) {
        test::Polygon small = plate(0.02);
        for (Vec3d& p : small) {
            p.x += x;
        }
        const Built built(lit(light, small));
        const NodeId element = built.tree.patchNode(0, 0, false);
        const Vec3d d = Vec3d(x, 0, 0) - light.position;
        const base::Rgb there = scene::intensityToward(light, glm::normalize(d));
        const double expected = static_cast<double>(there.g) / 6.0 * 2.0 / std::pow(glm::length(d), 3.0);
        EXPECT_NEAR(meanOf(built, element, compute(built, element)), expected, 2e-3 * expected) << x;
    }
}

TEST(Sources, aDirectionalLightGivesTheCosine) {
    scene::Light light;
    light.kind = scene::LightKind::directional;
    light.direction = glm::normalize(Vec3d(0.5, -1.0, 0.3));
    const Built built(lit(light, plate(1.0)));
    const NodeId element = built.tree.patchNode(0, 0, false);
    const Coefficient c = compute(built, element);
    EXPECT_NEAR(meanOf(built, element, c), -light.direction.y, 1e-6);
    EXPECT_LT(c.spreadA, 1e-6f);
    EXPECT_EQ(compute(built, built.tree.patchNode(0, 0, true)).coupling, 0.0f) << "the back";
}

TEST(Sources, theSkyOverATiltedPlate) {
    for (const double degrees : {0.0, 30.0, 60.0, 90.0, 150.0}) {
        const double angle = degrees * base::kPi / 180.0;
        const Vec3d normal(std::sin(angle), std::cos(angle), 0.0);
        scene::Scene scene = test::sceneOf(
            {test::place({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, normal, 0.5, {0, 0, 0})});
        scene.sky = base::Rgb(1.0f);
        const Built built(std::move(scene));
        const NodeId element = built.tree.patchNode(0, 0, false);
        const Coefficient c = compute(built, element);
        EXPECT_NEAR(meanOf(built, element, c), 0.5 * (1.0 + std::cos(angle)), 1e-6) << degrees;
        EXPECT_EQ(c.visibility, 1.0f);
    }
}

// The shadow of half a plane: visibility of each kind of source over many keys.
double meanVisibility(const scene::Scene& scene, std::uint64_t seeds, test::Sample& sample) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const Built built(scene, 500 + seed);
        const NodeId element = built.tree.patchNode(0, 0, false);
        sample.add(static_cast<double>(
            transport::sampleSourceVisibility(built.tree, built.rays, element, built.tree.sources()[0])
                .mean));
    }
    return sample.mean();
}

TEST(Sources, shadowsOfAPointAndOfTheSun) {
    // A sheet at half the light's height hides what is beyond x = 0.1 (point) or x = 0.2 (sun).
    for (const bool sun : {false, true}) {
        scene::Light light;
        light.kind = sun ? scene::LightKind::directional : scene::LightKind::point;
        light.position = {0.0, 200.0, 0.0};
        scene::Scene scene =
            test::sceneOf({plate(1.0), {{0.1, 100, -60}, {0.1, 100, 60}, {60, 100, 60}, {60, 100, -60}}});
        scene.lights.push_back(light);
        test::Sample sample;
        // Seen: the part of the plate with x below the shadow's edge.
        const double expected = 0.5 + (sun ? 0.1 : 0.2);
        meanVisibility(scene, 100, sample);
        EXPECT_NEAR(sample.mean(), expected, 4.5 * sample.standardError() + 1e-3);
        EXPECT_LT(sample.deviation(), 0.03) << "64 strata";
    }
}

TEST(Sources, theSkyBesideAWallOverManyKeys) {
    // Visible: 1 less the wall's form factor, averaged over the plate.
    const test::Polygon wall{{0.6, 0, -2}, {0.6, 0, 2}, {0.6, 1.5, 2}, {0.6, 1.5, -2}};
    scene::Scene scene = test::sceneOf({plate(1.0), wall});
    scene.sky = base::Rgb(1.0f);
    test::Polygon facing = wall;
    if (glm::cross(wall[1] - wall[0], wall[2] - wall[0]).x > 0.0) {
        std::reverse(facing.begin(), facing.end());
    }
    double covered = 0.0;
    constexpr int kCount = 60;
    for (int i = 0; i < kCount * kCount; ++i) {
        const Vec3d x((i % kCount + 0.5) / kCount - 0.5, 0.0,
                      (static_cast<double>(i / kCount) + 0.5) / kCount - 0.5);
        covered += transport::pointToPolygon(x, {0, 1, 0}, facing) / (kCount * kCount);
    }
    test::Sample sample;
    meanVisibility(scene, 200, sample);
    EXPECT_GT(covered, 0.1);
    EXPECT_NEAR(sample.mean(), 1.0 - covered, 4.5 * sample.standardError() + 2e-3);
}

TEST(Sources, hiddenSourcesAreHidden) {
    for (const scene::LightKind kind :
         {scene::LightKind::point, scene::LightKind::spot, scene::LightKind::directional}) {
        scene::Light light;
        light.kind = kind;
        light.position = {0.0, 3.0, 0.0};
        scene::Scene scene = lit(light, plate(1.0));
        scene::addPolygons(scene, "roof", 0, scene::boxFaces({-5, 2, -5}, {5, 2, 5}, scene::kBottom));
        const Built built(std::move(scene));
        const Coefficient c = compute(built, built.tree.patchNode(0, 0, false));
        EXPECT_GT(c.coupling, 0.0f);
        EXPECT_EQ(c.visibility, 0.0f);
        EXPECT_EQ(c.rays, 64);
        EXPECT_FALSE(c.isBlocked) << "rays alone are no certificate";
    }
}

}  // namespace
}  // namespace fluxwalk
