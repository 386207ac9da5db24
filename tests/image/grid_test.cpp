#include "core/image/grid.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/hierarchy/reach.h"
#include "core/image/sensors.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"

namespace fluxwalk {
namespace {

using image::Grid;

class Grids : public testing::Test {
  protected:
    std::uint32_t objectNamed(const std::string& name) const {
        for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
            if (scene_.objects[i].name == name) {
                return i;
            }
        }
        ADD_FAILURE() << name;
        return 0;
    }
    bool isInSolid(const base::Vec3d& position, const base::Vec3d& normal = {0, 1, 0}) const {
        return image::isInSolid(rays_, reached_, {position, normal});
    }

    scene::Scene scene_ = *scene::buildScene("cornell-box");
    base::Executor executor_{2};
    rays::RayScene rays_{scene_, executor_};
    hierarchy::ReachedSides reached_ = hierarchy::findReachedSides(scene_, rays_, executor_, 1);
};

}  // namespace

TEST_F(Grids, planeCoversTheSceneInSquareCells) {
    const base::Box box = scene_.bounds();
    const Grid grid = image::makePlaneGrid(scene_, 0.3, 0.1);
    ASSERT_EQ(grid.sensors.size(), std::size_t{grid.columns} * grid.rows);
    EXPECT_EQ(grid.columns, static_cast<std::uint32_t>((box.upper.x - box.lower.x) / 0.1));
    for (const scene::Sensor& s : grid.sensors) {
        EXPECT_EQ(s.position.y, 0.3);
        EXPECT_EQ(s.normal, base::Vec3d(0, 1, 0));
        EXPECT_GT(s.position.x, box.lower.x);
        EXPECT_LT(s.position.x, box.upper.x);
    }
    EXPECT_NEAR(grid.sensors[1].position.x - grid.sensors[0].position.x, 0.1, 1e-12);
    EXPECT_NEAR(grid.sensors[grid.columns].position.z - grid.sensors[0].position.z, 0.1, 1e-12);
    EXPECT_NEAR(grid.sensors.front().position.x - box.lower.x, box.upper.x - grid.sensors.back().position.x,
                1e-9);
}

TEST_F(Grids, objectGetsOneSensorForEachCell) {
    const std::uint32_t floor = objectNamed("floor");
    const Grid grid = image::makeObjectGrid(scene_, reached_, floor, 0.05);
    double area = 0.0;
    const surface::Surface& surface = *scene_.objects[floor].surface;
    for (std::uint32_t p = 0; p < surface.patchCount(); ++p) {
        area += surface.area(p, surface::wholePatch(surface.domain(p)));
    }
    EXPECT_NEAR(static_cast<double>(grid.sensors.size()), area / (0.05 * 0.05), 0.1 * area / (0.05 * 0.05));
    for (const scene::Sensor& s : grid.sensors) {
        EXPECT_NEAR(s.position.y, 0.0, 1e-6);
        EXPECT_NEAR(s.normal.y, 1.0, 1e-6);
    }
    // Faces hold few.
    const Grid coarse = image::makeObjectGrid(scene_, reached_, objectNamed("tall block"), 0.12);
    EXPECT_GE(coarse.sensors.size(), 12u) << "0.24 m2, in whole rows on each face";
    EXPECT_LE(coarse.sensors.size(), 20u);
}

TEST_F(Grids, refusesWhatIsAbsurd) {
    EXPECT_THROW(image::makePlaneGrid(scene_, 0.3, 1e-4), base::UsageError);
    EXPECT_THROW(image::makePlaneGrid(scene_, 3.0, 0.1), base::UsageError);
    EXPECT_THROW(image::makeObjectGrid(scene_, reached_, 0, 1e-4), base::UsageError);
}

TEST_F(Grids, solidsAreToldFromRooms) {
    // The tall block stands about x .37, z .35; its height is .33.
    EXPECT_TRUE(isInSolid({0.37, 0.2, 0.35}));
    EXPECT_TRUE(isInSolid({0.37, 0.01, 0.35}));
    EXPECT_FALSE(isInSolid({0.1, 0.2, 0.1}));
    EXPECT_FALSE(isInSolid({0.1, 0.0, 0.1})) << "on the floor";
    EXPECT_FALSE(isInSolid({0.0, 0.3, 0.3}, {1, 0, 0})) << "on a wall";
    EXPECT_FALSE(isInSolid({0.28, 0.3, 5.0})) << "in front of the open box";
}

TEST(GridStatistics, leaveSolidsOut) {
    std::vector<image::Measurement> measured(4);
    measured[0].illuminance = 100.0;
    measured[1].illuminance = 300.0;
    measured[2].illuminance = 0.0;
    measured[2].place = image::SensorPlace::solid;
    measured[3].illuminance = 200.0;
    const image::IlluminanceStatistics s = image::summarize(measured);
    EXPECT_EQ(s.count, 3u);
    EXPECT_EQ(s.inSolids, 1u);
    EXPECT_EQ(s.mean, 200.0);
    EXPECT_EQ(s.minimum, 100.0);
    EXPECT_EQ(s.maximum, 300.0);
    EXPECT_EQ(s.uniformity, 0.5);
    EXPECT_EQ(image::summarize({}).count, 0u);
}

}  // namespace fluxwalk
