#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "tests/support/solving.h"

namespace fluxwalk {

// Check 18, ALGORITHMS 3.6: CIE 171 test 5.8. Means are exact for every mesh whose rows sum to one.
TEST(CieCube, meanIrradiance) {
    constexpr float kRefinedFor = .8f;
    const auto problem = test::makeProblem(scene::buildCie58(kRefinedFor));
    for (double threshold = 8.0; threshold > 1e-3; threshold /= 4.0) {
        test::refine(*problem, threshold);
        test::converge(*problem, 1e-4);
    }
    for (const auto& [rho, total] :
         {std::pair{0.0f, 104.1667}, std::pair{.05f, 109.6491}, std::pair{.1f, 115.7407},
          std::pair{.2f, 130.2083}, std::pair{.3f, 148.8095}, std::pair{.5f, 208.3333},
          std::pair{.7f, 347.2222}, std::pair{.8f, 520.8333}, std::pair{.9f, 1041.6667},
          std::pair{.95f, 2083.3333}}) {
        test::setReflectance(*problem, rho);
        test::converge(*problem);
        EXPECT_NEAR(test::meanIrradiance(*problem, 0).y / total, 1.0, rho <= .8f ? .005 : .01) << rho;
    }
}

}  // namespace fluxwalk
