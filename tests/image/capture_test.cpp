#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "tests/image/measuring.h"

namespace fluxwalk {

// Sensors beside, above and below their surface by less than a thousandth of the scene sit on it.
TEST(Sensors, nearSurfacesAreCaptured) {
    const auto solver = test::solveScene(*scene::buildScene("cornell-box"), .1);
    std::vector<scene::Sensor> sensors;
    for (const double height : {-4e-4, 0.0, 4e-4}) {
        sensors.push_back({{.45, height, .1}, {0, 1, 0}});
    }
    const std::vector<base::Rgb> values = image::measure(*solver, sensors);
    EXPECT_GT(values[1].g, 0.0f);
    EXPECT_NEAR(values[0].g / values[1].g, 1.0f, 1e-3f);
    EXPECT_NEAR(values[2].g / values[1].g, 1.0f, 1e-3f);
}

// On top of the short block, under it, and nowhere near anything.
TEST(Sensors, readTheSideTheyFace) {
    const auto solver = test::solveScene(*scene::buildScene("cornell-box"), .1);
    const std::vector<scene::Sensor> sensors{
        {{.185, .165, .17}, {0, 1, 0}}, {{.185, 0, .17}, {0, 1, 0}}, {{.3, .3, -5.0}, {0, 0, -1}}};
    const std::vector<base::Rgb> values = image::measure(*solver, sensors);
    EXPECT_GT(values[0].g, 0.0f);
    EXPECT_EQ(values[1], base::Rgb(0.0f));
    EXPECT_EQ(values[2], base::Rgb(0.0f));
    EXPECT_TRUE(image::measure(*solver, {}).empty());
}

}  // namespace fluxwalk
