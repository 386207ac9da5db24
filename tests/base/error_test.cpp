#include "core/base/error.h"

#include <gtest/gtest.h>

#include "core/base/check.h"

namespace fluxwalk::base {
namespace {

TEST(FileError, NamesFileAndPlaceOnOneLine) {
    const FileError error("room.glb", "/meshes/0/primitives/1", "index 99 is out of range");
    EXPECT_STREQ(error.what(), "room.glb: /meshes/0/primitives/1: index 99 is out of range");
    EXPECT_EQ(error.file(), "room.glb");
    EXPECT_EQ(error.place(), "/meshes/0/primitives/1");
}

TEST(FileError, OmitsAnEmptyPlace) {
    EXPECT_STREQ(FileError("room.glb", "", "is empty").what(), "room.glb: is empty");
}

TEST(CheckDeathTest, PrintsBothOperands) {
    const int three = 3;
    EXPECT_DEATH(FLUXWALK_CHECK_EQ(three, 4),
                 "error_test.cpp:[0-9]+: check failed: three == 4  \\(3 vs 4\\)");
    EXPECT_DEATH(FLUXWALK_CHECK(three > 4), "check failed: three > 4");
}

TEST(Check, EvaluatesItsOperandsOnce) {
    int calls = 0;
    FLUXWALK_CHECK_EQ(++calls, 1);
    FLUXWALK_CHECK_LE(++calls, 2);
    EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace fluxwalk::base
