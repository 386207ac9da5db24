#include "tests/viewer/golden_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "core/io/image_write.h"

namespace fluxwalk::testing {
namespace {

constexpr gl::PixelSize kSize = kGoldenSize;
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

}  // namespace

void expectGolden(const std::vector<std::uint8_t>& drawn, const std::string& name) {
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
    if (difference.mean < kMeanTolerance && difference.worstBlock < kBlockTolerance) {
        return;
    }
    const std::filesystem::path here = std::filesystem::current_path() / name;
    io::writePng(here, static_cast<std::uint32_t>(kSize.width), static_cast<std::uint32_t>(kSize.height),
                 drawn);
    ADD_FAILURE() << "differs by " << difference.mean << " in the mean and " << difference.worstBlock
                  << " in the worst block: compare " << here << " with " << wanted;
}

}  // namespace fluxwalk::testing
