#include <memory>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/image/display_gather.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/viewer/golden_picture.h"
#include "viewer/app/screenshot.h"

namespace fluxwalk {
namespace {

// As `view --display gather --screenshot` draws it, from a rough solution.
TEST(GatheredPicture, IsAsBefore) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    solve::Options options;
    options.error = 0.1;
    solve::Solver solver(scene, options, 0);
    solver.solve({});
    image::DisplayGather gather(solver.problem());
    const image::Look look{scene->cameras.front(), 16.0 / 9.0, 240};
    do {
        gather.workOnSeen(look, image::DisplayGather::Clock::now() + std::chrono::milliseconds(100));
    } while (gather.seenPending() > 0);
    solve::Snapshot snapshot = *solver.show({});
    snapshot.meshes = gather.meshes(options.displayAngle * base::kPi / 180.0);
    const auto context = gl::makeHeadlessContext(gl::HeadlessKind::automatic);
    testing::expectGolden(app::drawPicture(*context, scene, snapshot, scene->cameras.front(),
                                           testing::kGoldenSize, render::DrawSettings{}),
                          "gathered-cornell-box.png");
}

}  // namespace
}  // namespace fluxwalk
