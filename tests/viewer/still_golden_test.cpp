#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "core/image/final_gather.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/viewer/golden_picture.h"
#include "viewer/app/still_file.h"

namespace fluxwalk {
namespace {

// As `render` takes them, from a rough solution.
class StillPictures : public ::testing::TestWithParam<const char*> {};

TEST_P(StillPictures, AreAsBefore) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene(GetParam()));
    solve::Options options;
    options.error = 0.1;
    options.errorOf = solve::ErrorOf::gathered;
    solve::Solver solver(scene, options, 0);
    solver.solve({});
    image::StillOptions still;
    still.width = static_cast<std::uint32_t>(testing::kGoldenSize.width);
    still.height = static_cast<std::uint32_t>(testing::kGoldenSize.height);
    const image::Still picture = image::takeStill(solver.problem(), scene->cameras.front(), still);
    testing::expectGolden(app::developStill(picture, app::meterStill(picture), render::ToneCurve::filmic),
                          std::string("still-") + GetParam() + ".png");
}

INSTANTIATE_TEST_SUITE_P(Golden, StillPictures, ::testing::Values("cornell-box", "gallery"),
                         [](const auto& one) {
                             std::string name = one.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace fluxwalk
