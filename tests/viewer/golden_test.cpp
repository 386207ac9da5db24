#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/viewer/golden_picture.h"
#include "viewer/app/overlays.h"
#include "viewer/app/screenshot.h"
#include "viewer/app/sight.h"
#include "viewer/render/camera.h"

namespace fluxwalk {
namespace {

constexpr gl::PixelSize kSize = testing::kGoldenSize;
/// One picture: a camera of the gallery, or one of its own, and what is shown.
struct Case {
    std::string name;
    std::variant<std::string, scene::Camera> camera;
    render::DrawSettings look{};
    std::optional<base::Vec2d> pick{};
    ui::InspectionView inspection{true, true};
};

Case showing(const std::string& name, render::Shown shown, render::ValueScale scale = {}) {
    Case one{"vases-" + name, "vases"};
    one.look.shown = shown;
    one.look.scale = scale;
    return one;
}

Case overlaying(const std::string& name, bool elements, bool clusters) {
    Case one{"vases-" + name, "vases"};
    one.look.elementEdges = elements;
    one.look.clusterBoxes = clusters;
    one.look.clusterDepth = 7;
    return one;
}

Case glowing() {
    Case one{"entrance-glow-hue", "entrance"};
    one.look.glow = true;
    one.look.curve = render::ToneCurve::hue;
    return one;
}

/// Pictures that are compared in one test, since solving takes longer than drawing.
struct Album {
    std::string name;
    std::vector<Case> cases;
};

void PrintTo(const Album& album, std::ostream* out) {
    *out << album.name;
}

std::vector<Album> allAlbums() {
    return {{"Pictures",
             {{"entrance", "entrance"},
              {"torus", "torus"},
              {"vases", "vases"},
              glowing(),
              // From near, outlines show chords if there are any.
              {"near-torus", render::lookAt({9.9, 1.4, 5.4}, {11.2, 1.4, 4.5}, 55.0)},
              {"near-bowl", render::lookAt({6.1, 1.55, 5.2}, {6.2, 1.3, 5.95}, 45.0)}}},
            {"Values",
             {showing("lux", render::Shown::illuminance),
              showing("luminance", render::Shown::luminance, render::ValueScale::linear),
              showing("level", render::Shown::level), showing("objects", render::Shown::objects),
              showing("errors", render::Shown::linkErrors)}},
            {"Overlays",
             {overlaying("elements", true, false),
              overlaying("clusters", false, true),
              {"vases-pick", "vases", {}, base::Vec2d(300.0, 125.0)},
              {"vases-visibility", "vases", {}, base::Vec2d(300.0, 125.0), {false, false, true}}}}};
}

/// The demo, solved once for all pictures of a test: as roughly as no blotches are seen.
class GalleryPictures : public ::testing::TestWithParam<Album> {
  protected:
    static void SetUpTestSuite() {
        solve::Options options;
        options.error = 0.1;
        scene_ = std::make_shared<const scene::Scene>(scene::buildGallery());
        solver_ = std::make_unique<solve::Solver>(scene_, options, 0);
        solver_->solve({});
    }
    static void TearDownTestSuite() {
        solver_.reset();
        scene_.reset();
    }

    static std::vector<std::uint8_t> draw(gl::HeadlessKind kind, const Case& one) {
        const scene::Camera camera = cameraOf(one);
        std::optional<image::Inspection> inspection;
        if (one.pick) {
            inspection = image::inspectAlong(solver_->problem(), app::rayThrough(camera, kSize, *one.pick));
            EXPECT_TRUE(inspection);
        }
        const auto context = gl::makeHeadlessContext(kind);
        return app::drawPicture(*context, scene_, *solver_->show(app::detailFor(one.look)), camera, kSize,
                                one.look, {inspection ? &*inspection : nullptr, one.inspection});
    }

    static scene::Camera cameraOf(const Case& one) {
        if (const auto* own = std::get_if<scene::Camera>(&one.camera)) {
            return *own;
        }
        const std::string& name = std::get<std::string>(one.camera);
        const auto found =
            std::find_if(scene_->cameras.begin(), scene_->cameras.end(),
                         [&name](const scene::Camera& candidate) { return candidate.name == name; });
        EXPECT_NE(found, scene_->cameras.end()) << name;
        return found != scene_->cameras.end() ? *found : scene::Camera{};
    }

    static inline std::shared_ptr<const scene::Scene> scene_;
    static inline std::unique_ptr<solve::Solver> solver_;
};

TEST_P(GalleryPictures, LookAsTheyShouldAndTheSameByEgl) {
    for (const Case& one : GetParam().cases) {
        SCOPED_TRACE(one.name);
        const std::vector<std::uint8_t> osmesa = draw(gl::HeadlessKind::osmesa, one);
        testing::expectGolden(osmesa, "gallery-" + one.name + ".png");
        EXPECT_EQ(draw(gl::HeadlessKind::egl, one), osmesa);
    }
}
INSTANTIATE_TEST_SUITE_P(All, GalleryPictures, ::testing::ValuesIn(allAlbums()),
                         [](const auto& album) { return album.param.name; });

/// Residuals of a solution are rounding noise in places: only their drawing is compared.
using GalleryResiduals = GalleryPictures;
TEST_P(GalleryResiduals, AreTheSameByEgl) {
    const Case& residual = GetParam().cases.front();
    const auto egl = draw(gl::HeadlessKind::egl, residual);
    EXPECT_EQ(egl, draw(gl::HeadlessKind::osmesa, residual));
    EXPECT_NE(egl, draw(gl::HeadlessKind::egl, Case{"vases", "vases"}));
}
INSTANTIATE_TEST_SUITE_P(All, GalleryResiduals,
                         ::testing::Values(Album{"Residual", {showing("residual", render::Shown::residual)}}),
                         [](const auto& album) { return album.param.name; });

}  // namespace
}  // namespace fluxwalk
