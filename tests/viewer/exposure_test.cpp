#include "viewer/render/exposure.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "tests/viewer/test_room.h"
#include "viewer/ui/exposure_control.h"

namespace fluxwalk::render {
namespace {

TEST(LuminanceHistogram, PercentilesByArea) {
    LuminanceHistogram histogram;
    EXPECT_TRUE(histogram.isEmpty());
    EXPECT_EQ(histogram.percentile(0.5), 0.0);
    histogram.add(1.0, 9.0);
    histogram.add(100.0, 1.0);
    histogram.add(0.0, 50.0);  // unlit: left out
    // Steps of 1/8 stop: within 9 %.
    EXPECT_NEAR(histogram.percentile(0.5), 1.0, 0.09);
    EXPECT_NEAR(histogram.percentile(0.95), 100.0, 9.0);
    LuminanceHistogram other;
    other.add(100.0, 80.0);
    histogram.add(other);
    EXPECT_NEAR(histogram.percentile(0.5), 100.0, 9.0);
    EXPECT_NEAR(histogram.percentile(0.05), 1.0, 0.09);
}

scene::LitMesh makeLit(float lux) {
    scene::LitMesh mesh = testing::makeQuad({0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, 4);
    mesh.irradiance.assign(mesh.positions.size(), base::Rgb(lux));
    return mesh;
}

TEST(AutomaticExposure, BrightSurfacesComeJustBelowWhite) {
    // A fifth is bright, the middle is dark.
    LuminanceHistogram room;
    room.add(10.0, 4.0);
    room.add(40.0, 1.0);
    EXPECT_NEAR(automaticExposure(room, {}) * 40.0, 0.85, 0.08);
    // Hardly darker than what is bright: the middle counts.
    LuminanceHistogram wall;
    wall.add(30.0, 4.0);
    wall.add(40.0, 1.0);
    EXPECT_NEAR(automaticExposure(wall, {}) * 30.0, 0.5, 0.05);
}

TEST(AutomaticExposure, EvenlyLitWallsAreHalfWhite) {
    scene::Material material;
    material.reflectance = base::Rgb(0.5f);
    const MeshLuminance luminance = luminanceOf(makeLit(200.0f), material, base::Rgb(1.0f), base::Rgb(1.0f));
    EXPECT_TRUE(luminance.emitting.isEmpty());
    const double exposure = automaticExposure(luminance.reflecting, luminance.emitting);
    EXPECT_NEAR(exposure * 0.5 * 200.0 / base::kPi, 0.5, 0.05);
    // A texture counts with its mean.
    const MeshLuminance dark = luminanceOf(makeLit(200.0f), material, base::Rgb(0.25f), base::Rgb(1.0f));
    EXPECT_NEAR(automaticExposure(dark.reflecting, dark.emitting) / exposure, 4.0, 0.4);
}

TEST(AutomaticExposure, LampsDoNotCountUnlessNothingElseIsLit) {
    scene::Material lamp;
    lamp.emission = base::Rgb(1e5f);
    const MeshLuminance front = luminanceOf(makeLit(100.0f), lamp, base::Rgb(1.0f), base::Rgb(1.0f));
    EXPECT_TRUE(front.reflecting.isEmpty());
    EXPECT_NEAR(automaticExposure(front.reflecting, front.emitting) * 1e5 / base::kPi, 0.85, 0.08);
    LuminanceHistogram lit;
    lit.add(10.0, 1.0);
    EXPECT_NEAR(automaticExposure(lit, front.emitting) * 10.0, 0.5, 0.05);
    EXPECT_EQ(automaticExposure({}, {}), 1.0);
}

TEST(EmissionOfSide, FrontOnlyUnlessDoubleSided) {
    scene::Material lamp;
    lamp.emission = base::Rgb(7.0f);
    scene::LitMesh mesh = makeLit(1.0f);
    EXPECT_EQ(emissionOfSide(mesh, lamp), base::Rgb(7.0f));
    mesh.back = true;
    EXPECT_EQ(emissionOfSide(mesh, lamp), base::Rgb(0.0f));
    lamp.doubleSided = true;
    EXPECT_EQ(emissionOfSide(mesh, lamp), base::Rgb(7.0f));
}

TEST(ExposureValue, WhiteAtSaturation) {
    // EV 0 at ISO 100 saturates at 1.2 cd/m2, each step doubles it.
    EXPECT_NEAR(exposureFromValue(0.0), 1.0 / 1.2, 1e-12);
    EXPECT_NEAR(exposureFromValue(10.0) * 1.2 * 1024.0, 1.0, 1e-12);
    EXPECT_NEAR(exposureValue(exposureFromValue(7.25)), 7.25, 1e-12);
}

TEST(ExposureControl, FollowsAndHolds) {
    ui::ExposureControl control;
    EXPECT_TRUE(control.follow(0.01, 0.016));
    EXPECT_EQ(control.exposure, 0.01);  // at once the first time
    EXPECT_FALSE(control.follow(0.01, 0.016));
    EXPECT_TRUE(control.follow(0.04, 0.016));
    EXPECT_GT(control.exposure, 0.01);
    EXPECT_LT(control.exposure, 0.02);
    int frames = 0;
    while (control.follow(0.04, 0.016)) {
        ASSERT_LT(++frames, 400);
    }
    EXPECT_EQ(control.exposure, 0.04);
    control.isAutomatic = false;
    EXPECT_FALSE(control.follow(1.0, 1.0));
    EXPECT_EQ(control.exposure, 0.04);
    control.isAutomatic = true;
    control.compensation = 1.0;
    while (control.follow(0.04, 0.1)) {
    }
    EXPECT_NEAR(control.exposure, 0.08, 1e-12);
}

}  // namespace
}  // namespace fluxwalk::render
