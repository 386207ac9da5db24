#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "tests/image/measuring.h"

namespace fluxwalk {

// Check 19, ALGORITHMS 3.6: the centre of a face of CIE 171's cube, where no cavity formula holds.
TEST(CieCube, centreOfAFace) {
    for (const auto& [rho, total] :
         {std::pair{0.0f, 198.94}, std::pair{.5f, 310.98}, std::pair{.8f, 629.92}, std::pair{.95f, 2196.5}}) {
        const auto solver = test::solveScene(scene::buildCie58(rho), .05);
        const std::vector<scene::Sensor> sensors{
            {{2, 0, 2}, {0, 1, 0}}, {{2, 4, 2}, {0, -1, 0}}, {{0, 2, 2}, {1, 0, 0}}, {{2, 2, 4}, {0, 0, -1}}};
        for (const base::Rgb& e : image::measure(*solver, sensors)) {
            EXPECT_NEAR(static_cast<double>(e.g) / total, 1.0, .01) << rho;
        }
    }
}

}  // namespace fluxwalk
