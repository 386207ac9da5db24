#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "core/io/image_write.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "viewer/app/screenshot.h"
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

/// A camera of the scene, or one of its own where `fov` (vertical, degrees) is not 0.
struct View {
    const char* name;
    base::Vec3d eye{};
    base::Vec3d target{};
    double fov = 0.0;
};

std::ostream& operator<<(std::ostream& out, const View& view) {
    return out << view.name;
}

/// The demo, solved roughly, once for all pictures.
class GalleryPictures : public ::testing::TestWithParam<View> {
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

    static inline std::shared_ptr<const scene::Scene> scene_;
    static inline std::unique_ptr<solve::Solver> solver_;
};

// To take a new picture for the right one: look at what the failing test wrote, and copy it to tests/golden.
TEST_P(GalleryPictures, LookAsTheyShould) {
    const View& view = GetParam();
    scene::Camera camera;
    if (view.fov == 0.0) {
        const auto named =
            std::find_if(scene_->cameras.begin(), scene_->cameras.end(),
                         [&view](const scene::Camera& candidate) { return candidate.name == view.name; });
        ASSERT_NE(named, scene_->cameras.end());
        camera = *named;
    } else {
        camera = render::lookAt(view.eye, view.target, view.fov);
    }
    const auto context = gl::makeHeadlessContext(gl::HeadlessKind::osmesa);
    const auto drawn =
        app::drawPicture(*context, scene_, solver_->litMeshes(), camera, kSize, render::ToneCurve::filmic);
    const std::string name = std::string("gallery-") + view.name + ".png";
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

// From near, outlines show chords if there are any.
INSTANTIATE_TEST_SUITE_P(All, GalleryPictures,
                         ::testing::Values(View{"entrance"}, View{"torus"}, View{"vases"},
                                           View{"near-torus", {9.9, 1.4, 5.4}, {11.2, 1.4, 4.5}, 55.0},
                                           View{"near-bowl", {6.1, 1.55, 5.2}, {6.2, 1.3, 5.95}, 45.0}));

}  // namespace
}  // namespace fluxwalk
