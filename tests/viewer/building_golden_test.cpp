#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/viewer/golden_picture.h"
#include "viewer/app/overlays.h"
#include "viewer/app/screenshot.h"

namespace fluxwalk {
namespace {

struct Case {
    const char* name;
    render::DrawSettings look{};
};

Case showing(const char* name, render::Shown shown) {
    Case one{name};
    one.look.shown = shown;
    return one;
}

std::vector<Case> allCases() {
    std::vector<Case> cases{{"picture"},
                            showing("lux", render::Shown::illuminance),
                            showing("luminance", render::Shown::luminance),
                            showing("level", render::Shown::level),
                            showing("objects", render::Shown::objects),
                            showing("errors", render::Shown::linkErrors)};
    Case overlays{"elements-clusters"};
    overlays.look.elementEdges = true;
    overlays.look.clusterBoxes = true;
    overlays.look.clusterDepth = 7;
    cases.push_back(overlays);
    return cases;
}

// Solved once, very roughly: what is tested is how a scene of thousands of surfaces is shown.
TEST(BuildingPictures, LookAsTheyShouldAndTheSameByEgl) {
    solve::Options options;
    options.error = 1.0;
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("building:10000"));
    solve::Solver solver(scene, options, 0);
    solver.solve({});
    ASSERT_FALSE(scene->cameras.empty());
    for (const Case& one : allCases()) {
        SCOPED_TRACE(one.name);
        const auto snapshot = solver.show(app::detailFor(one.look));
        const auto draw = [&](gl::HeadlessKind kind) {
            const auto context = gl::makeHeadlessContext(kind);
            return app::drawPicture(*context, scene, *snapshot, scene->cameras.front(), testing::kGoldenSize,
                                    one.look);
        };
        const std::vector<std::uint8_t> osmesa = draw(gl::HeadlessKind::osmesa);
        testing::expectGolden(osmesa, std::string("building-") + one.name + ".png");
        EXPECT_EQ(draw(gl::HeadlessKind::egl), osmesa);
    }
}

}  // namespace
}  // namespace fluxwalk
