#include "core/cli/output.h"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace fluxwalk::cli {
namespace {

class OutputTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("fluxwalk_output_" + std::to_string(getpid()));
        std::filesystem::create_directory(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
};

TEST_F(OutputTest, PlacesThatCanBeWrittenAreLeftAsTheyAre) {
    requireWritable(folder_ / "new.glb");
    EXPECT_TRUE(std::filesystem::is_empty(folder_)) << "the probe is gone";
    const std::filesystem::path old = folder_ / "old.glb";
    std::ofstream(old) << "content";
    requireWritable(old);
    EXPECT_EQ(std::filesystem::file_size(old), 7u);
}

TEST_F(OutputTest, PlacesThatCannotBeWrittenAreNamed) {
    EXPECT_THROW(requireWritable(folder_), WriteError);
    EXPECT_THROW(requireWritable(folder_ / "missing" / "out.glb"), WriteError);
    EXPECT_THROW(requireWritable(""), WriteError);
    try {
        requireWritable(folder_ / "missing" / "out.glb");
    } catch (const WriteError& error) {
        EXPECT_EQ(error.what(), (folder_ / "missing" / "out.glb").string() +
                                    ": cannot be written: No such file or directory");
    }
}

TEST_F(OutputTest, DevicesAreAllowed) {
    EXPECT_NO_THROW(requireWritable("/dev/null"));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(Output, FailuresOfWritersBecomeWriteErrors) {
    try {
        writeOutput([] { throw base::FileError("out.glb", "/nodes/1", "disk full"); });
        FAIL();
    } catch (const WriteError& error) {
        EXPECT_STREQ(error.what(), "out.glb: /nodes/1: disk full");
        EXPECT_EQ(error.file(), "out.glb");
        EXPECT_EQ(error.place(), "/nodes/1");
    }
    EXPECT_THROW(writeOutput([] { throw base::UsageError("other"); }), base::UsageError);
}

}  // namespace
}  // namespace fluxwalk::cli
