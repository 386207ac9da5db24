#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "core/io/image_write.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "viewer/app/overlays.h"
#include "viewer/app/screenshot.h"
#include "viewer/app/sight.h"
#include "viewer/render/camera.h"

namespace fluxwalk {
namespace {

constexpr gl::PixelSize kSize{480, 270};
/// Other rasterisers round edges and colours differently: levels of 255, mean over the picture and over any
/// block of 10 x 10 pixels. What a shadow, a seam or a lamp changes is more.
constexpr double kMeanTolerance = 1.0;
constexpr double kBlockTolerance = 8.0;
constexpr int kBlock = 10;

struct Difference {
    double mean = 0.0;
    double worstBlock = 0.0;
};

Difference compare(const std::vector<std::uint8_t>& a, const std::uint8_t* b) {
    Difference result;
    const int columns = kSize.width / kBlock;
    const int rows = kSize.height / kBlock;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            double sum = 0.0;
            for (int y = row * kBlock; y < (row + 1) * kBlock; ++y) {
                for (int x = 3 * column * kBlock; x < 3 * (column + 1) * kBlock; ++x) {
                    const auto i = static_cast<std::size_t>(3 * y * kSize.width + x);
                    sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
                }
            }
            const double mean = sum / (3 * kBlock * kBlock);
            result.mean += mean / (columns * rows);
            result.worstBlock = std::max(result.worstBlock, mean);
        }
    }
    return result;
}

/// One picture: a camera of the gallery, or one of its own, and what is shown.
struct Case {
    std::string name;
    std::variant<std::string, scene::Camera> camera;
    render::DrawSettings look{};
    std::optional<base::Vec2d> pick{};
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

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

const std::vector<Case>& allCases() {
    static const std::vector<Case> cases{
        {"entrance", "entrance"},
        {"torus", "torus"},
        {"vases", "vases"},
        showing("lux", render::Shown::illuminance),
        showing("luminance", render::Shown::luminance, render::ValueScale::linear),
        showing("level", render::Shown::level),
        showing("objects", render::Shown::objects),
        overlaying("elements", true, false),
        overlaying("clusters", false, true),
        {"vases-pick", "vases", {}, base::Vec2d(300.0, 125.0)},
        // From near, outlines show chords if there are any.
        {"near-torus", render::lookAt({9.9, 1.4, 5.4}, {11.2, 1.4, 4.5}, 55.0)},
        {"near-bowl", render::lookAt({6.1, 1.55, 5.2}, {6.2, 1.3, 5.95}, 45.0)},
    };
    return cases;
}

/// The demo, solved roughly, once for all pictures.
class GalleryPictures : public ::testing::TestWithParam<Case> {
  protected:
    static void SetUpTestSuite() {
        solve::Options options;
        options.error = 0.3;
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
                                one.look, {inspection ? &*inspection : nullptr, {true, true}});
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

// To take a new picture for the right one: look at what the failing test wrote, and copy it to tests/golden.
TEST_P(GalleryPictures, LookAsTheyShould) {
    const auto drawn = draw(gl::HeadlessKind::osmesa, GetParam());
    const std::string name = "gallery-" + GetParam().name + ".png";
    const std::filesystem::path wanted = std::filesystem::path(FLUXWALK_SOURCE_DIR) / "tests/golden" / name;
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> golden(
        stbi_load(wanted.c_str(), &width, &height, &channels, 3), stbi_image_free);
    Difference difference{256.0, 256.0};
    if (golden && width == kSize.width && height == kSize.height) {
        difference = compare(drawn, golden.get());
    }
    EXPECT_LT(difference.mean, kMeanTolerance);
    EXPECT_LT(difference.worstBlock, kBlockTolerance);
    if (HasFailure()) {
        const std::filesystem::path here = std::filesystem::current_path() / name;
        io::writePng(here, kSize.width, kSize.height, drawn);
        ADD_FAILURE() << "compare " << here << " with " << wanted;
    }
}

TEST_P(GalleryPictures, AreTheSameByEgl) {
    EXPECT_EQ(draw(gl::HeadlessKind::egl, GetParam()), draw(gl::HeadlessKind::osmesa, GetParam()));
}

std::string nameOf(const ::testing::TestParamInfo<Case>& one) {
    std::string name = one.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(All, GalleryPictures, ::testing::ValuesIn(allCases()), nameOf);

/// Residuals of a solution are rounding noise in places: only their drawing is compared.
using GalleryResiduals = GalleryPictures;
TEST_P(GalleryResiduals, AreTheSameByEgl) {
    const auto egl = draw(gl::HeadlessKind::egl, GetParam());
    EXPECT_EQ(egl, draw(gl::HeadlessKind::osmesa, GetParam()));
    EXPECT_NE(egl, draw(gl::HeadlessKind::egl, Case{"vases", "vases"}));
}
INSTANTIATE_TEST_SUITE_P(All, GalleryResiduals,
                         ::testing::Values(showing("residual", render::Shown::residual)), nameOf);

}  // namespace
}  // namespace fluxwalk
