#include <gtest/gtest.h>

#include "core/image/sensors.h"
#include "core/scene/builders.h"

namespace fluxwalk {

// A lamp 2 m above the middle of each face of a cube with a range of 2.5 m lights a disc in each: caps of its
// sphere that hold (1 - 2 / 2.5) / 2 of its light each, and no patch's corner or cubature point at first.
TEST(LightRange, endsTheLight) {
    const auto scene = std::make_shared<scene::Scene>(scene::buildCie58(0.0f));
    ASSERT_EQ(scene->lights.size(), 1u);
    scene->lights[0].range = 2.5;
    solve::Solver solver(scene, {}, 2);
    solver.solve({});
    EXPECT_NEAR(solver.statistics().audit.absorbed.y, 6000.0, 30.0);
    const base::Box box = scene->bounds();
    const base::Vec3d middle = box.center();
    const scene::Sensor sensors[] = {{{middle.x, box.lower.y, middle.z}, {0, 1, 0}},
                                     {{box.lower.x + 0.1, box.lower.y, box.lower.z + 0.1}, {0, 1, 0}}};
    const std::vector<base::Rgb> values = image::measure(solver, sensors);
    EXPECT_NEAR(values[0].g, 198.9437f, 0.01f);
    EXPECT_EQ(values[1], base::Rgb(0.0f));
}

}  // namespace fluxwalk
