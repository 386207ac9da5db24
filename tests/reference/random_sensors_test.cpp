#include "core/reference/random_sensors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/surface/region.h"

namespace fluxwalk {

using base::Vec3d;

TEST(RandomSensors, areDrawnByArea) {
    const scene::Scene furnace = scene::buildFurnace(.5f, true);
    std::vector<reference::ObjectSide> sides;
    for (std::uint32_t i = 0; i < furnace.objects.size(); ++i) {
        sides.push_back({i, false});
    }
    constexpr std::size_t kCount = 20000;
    const auto sensors = reference::randomSensors(furnace, sides, kCount, reference::kBenchmarkSeed);
    ASSERT_EQ(sensors.size(), kCount);
    // The sphere of radius .1 about (.15, .12, .44) is the last object.
    const Vec3d center(.15, .12, .44);
    std::size_t onSphere = 0;
    std::size_t onFloor = 0;
    Vec3d mean(0.0);
    for (const scene::Sensor& sensor : sensors) {
        EXPECT_NEAR(glm::length(sensor.normal), 1.0, 1e-12);
        if (std::abs(glm::distance(sensor.position, center) - .1) < 1e-9) {
            ++onSphere;
            mean += sensor.normal;
            EXPECT_LT(glm::distance(center + .1 * sensor.normal, sensor.position), 1e-9);
        }
        onFloor += sensor.position.y == 0.0 && sensor.normal.y > .5 ? 1 : 0;
    }
    double area = 0.0;
    for (const scene::Object& object : furnace.objects) {
        for (std::uint32_t p = 0; p < object.surface->patchCount(); ++p) {
            area += object.surface->area(p, surface::wholePatch(object.surface->domain(p)));
        }
    }
    const auto expectShare = [&](std::size_t count, double part) {
        const double share = part / area;
        const double deviation = std::sqrt(share * (1.0 - share) / kCount);
        EXPECT_NEAR(static_cast<double>(count) / kCount, share, 4.5 * deviation);
    };
    expectShare(onSphere, 4.0 * 3.14159265358979 * .01);
    expectShare(onFloor, .308231);
    mean /= static_cast<double>(onSphere);
    const double spread = 4.5 * std::sqrt(1.0 / 3.0 / static_cast<double>(onSphere));
    EXPECT_NEAR(mean.x, 0.0, spread);
    EXPECT_NEAR(mean.y, 0.0, spread);
    EXPECT_NEAR(mean.z, 0.0, spread);
}

TEST(RandomSensors, backSidesLookTheOtherWayAndSeedsMatter) {
    const scene::Scene box = scene::buildLampBox();
    const std::vector<reference::ObjectSide> back{{1, true}};
    const auto sensors = reference::randomSensors(box, back, 50, 1);
    for (const scene::Sensor& sensor : sensors) {
        EXPECT_GT(glm::dot(sensor.normal, Vec3d(2, 1.5, 2) - sensor.position), 0.0);
    }
    const auto again = reference::randomSensors(box, back, 50, 1);
    const auto other = reference::randomSensors(box, back, 50, 2);
    EXPECT_EQ(again[7].position, sensors[7].position);
    EXPECT_NE(other[7].position, sensors[7].position);
}

}  // namespace fluxwalk
