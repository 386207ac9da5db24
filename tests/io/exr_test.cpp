#include "core/io/exr.h"

#include <fstream>

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include "core/base/error.h"

namespace fluxwalk::io {
namespace {

TEST(Exr, KeepsLightAndSaysItsUnit) {
    constexpr std::uint32_t kWidth = 5;
    constexpr std::uint32_t kHeight = 3;
    std::vector<float> light;
    for (std::size_t i = 0; i < 3 * kWidth * kHeight; ++i) {
        light.push_back(static_cast<float>(i) * 1234.56f);  // beyond what halves can hold
    }
    light[7] = 3.1e6f;
    const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "light.exr";
    writeExr(path, kWidth, kHeight, light);

    Imf::InputFile file(path.c_str());
    ASSERT_TRUE(Imf::hasWhiteLuminance(file.header()));
    EXPECT_EQ(Imf::whiteLuminance(file.header()), 1.0f);
    const auto& window = file.header().dataWindow();
    ASSERT_EQ(window.max.x, static_cast<int>(kWidth) - 1);
    ASSERT_EQ(window.max.y, static_cast<int>(kHeight) - 1);
    std::vector<float> read(light.size());
    Imf::FrameBuffer channels;
    const char* const names[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        channels.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read.data() + c),
                                             3 * sizeof(float), 3 * sizeof(float) * kWidth));
    }
    file.setFrameBuffer(channels);
    file.readPixels(0, static_cast<int>(kHeight) - 1);
    EXPECT_EQ(read, light);
    std::filesystem::remove(path);
}

TEST(Exr, NamesAFolderThatIsNotThere) {
    const std::vector<float> light(3, 1.0f);
    EXPECT_THROW(writeExr("/no/such/folder/light.exr", 1, 1, light), base::FileError);
}

}  // namespace
}  // namespace fluxwalk::io
