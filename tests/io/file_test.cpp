#include "core/io/file.h"

#include <gtest/gtest.h>

#include "core/io/image_write.h"
#include "stb/stb_image.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

namespace fs = std::filesystem;

std::string writeErrorOf(const fs::path& file) {
    try {
        io::writeFile(file, std::string_view("text"));
    } catch (const base::FileError& e) {
        return e.what();
    }
    return "no error";
}

std::size_t entriesIn(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
}

TEST(File, ReplacesTheOldContentAndLeavesNothingBeside) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "out.txt";
    io::writeFile(file, std::string_view("first"));
    io::writeFile(file, std::string_view("second"));
    EXPECT_EQ(io::readFile(file), test::bytesOf("second"));
    EXPECT_EQ(entriesIn(folder.path()), 1u);
}

TEST(File, WritesThroughALink) {
    const test::TemporaryFolder folder;
    io::writeFile(folder.path() / "target.txt", std::string_view("old"));
    fs::create_symlink(folder.path() / "target.txt", folder.path() / "link.txt");
    io::writeFile(folder.path() / "link.txt", std::string_view("new"));
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link.txt"));
    EXPECT_EQ(io::readFile(folder.path() / "target.txt"), test::bytesOf("new"));
}

TEST(File, WritesToADeviceWithoutReplacingIt) {
    io::writeFile("/dev/null", std::string_view("gone"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(File, SaysWhyItCannotBeWritten) {
    const test::TemporaryFolder folder;
    EXPECT_NE(writeErrorOf(folder.path() / "missing" / "out.txt").find("cannot be written: No such file"),
              std::string::npos);
    EXPECT_NE(writeErrorOf(folder.path()).find("it is a folder"), std::string::npos);
    EXPECT_NE(writeErrorOf("/dev/full").find("cannot be written: No space left"), std::string::npos);
    EXPECT_EQ(entriesIn(folder.path()), 0u);
}

TEST(File, SaysWhyItCannotBeRead) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(io::readFile(folder.path() / "missing"), base::FileError);
    EXPECT_THROW(io::readFile(folder.path()), base::FileError);
    io::writeFile(folder.path() / "long", std::string_view("12345"));
    EXPECT_THROW(io::readFile(folder.path() / "long", 4), base::FileError);
    EXPECT_EQ(io::readFile(folder.path() / "long", 5).size(), 5u);
}

TEST(ImageWrite, KeepsPixelsAndRowOrder) {
    const test::TemporaryFolder folder;
    const std::vector<std::uint8_t> rgb{255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30, 40, 50, 60, 70, 80, 90};
    const fs::path file = folder.path() / "picture.png";
    io::writePng(file, 3, 2, rgb);
    int width = 0;
    int height = 0;
    int channels = 0;
    stbi_uc* pixels = stbi_load(file.c_str(), &width, &height, &channels, 3);
    ASSERT_NE(pixels, nullptr);
    EXPECT_EQ(width, 3);
    EXPECT_EQ(height, 2);
    EXPECT_EQ(std::vector<std::uint8_t>(pixels, pixels + 18), rgb);
    stbi_image_free(pixels);
    EXPECT_THROW(io::writePng(folder.path() / "missing" / "picture.png", 3, 2, rgb), base::FileError);
}

}  // namespace
}  // namespace fluxwalk
