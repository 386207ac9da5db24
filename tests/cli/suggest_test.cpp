#include "core/cli/suggest.h"

#include <vector>

#include <gtest/gtest.h>

namespace fluxwalk::cli {
namespace {

TEST(EditDistance, CountsEdits) {
    EXPECT_EQ(editDistance("", ""), 0u);
    EXPECT_EQ(editDistance("", "abc"), 3u);
    EXPECT_EQ(editDistance("abc", ""), 3u);
    EXPECT_EQ(editDistance("error", "error"), 0u);
    EXPECT_EQ(editDistance("eror", "error"), 1u);
    EXPECT_EQ(editDistance("errror", "error"), 1u);
    EXPECT_EQ(editDistance("ermor", "error"), 1u);
    EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
}

TEST(EditDistance, SwappedNeighboursAreOneEdit) {
    EXPECT_EQ(editDistance("oracel", "oracle"), 1u);
    EXPECT_EQ(editDistance("slove", "solve"), 1u);
}

TEST(EditDistance, IsSymmetric) {
    const std::vector<std::string> words = {"solve",   "measure", "info",      "threshold",
                                            "threads", "",        "time-limit"};
    for (const std::string& a : words) {
        for (const std::string& b : words) {
            EXPECT_EQ(editDistance(a, b), editDistance(b, a)) << a << ' ' << b;
        }
    }
}

TEST(Suggest, FindsTheNearest) {
    const std::vector<std::string> options = {"--threads", "--threshold", "--error", "--oracle"};
    EXPECT_EQ(suggestNearest("--eror", options), "--error");
    EXPECT_EQ(suggestNearest("--oracel", options), "--oracle");
    EXPECT_EQ(suggestNearest("--treshold", options), "--threshold");
    EXPECT_EQ(suggestNearest("--thread", options), "--threads");
    EXPECT_EQ(suggestNearest("-error", options), "--error") << "a forgotten dash";
}

TEST(Suggest, IsSilentWhereNothingIsNear) {
    const std::vector<std::string> options = {"--threads", "--error"};
    EXPECT_EQ(suggestNearest("--camera", options), std::nullopt);
    EXPECT_EQ(suggestNearest("-x", options), std::nullopt);
    EXPECT_EQ(suggestNearest("", options), std::nullopt);
    EXPECT_EQ(didYouMean("--camera", options), "");
    EXPECT_EQ(didYouMean("--erorr", options), "; did you mean '--error'?");
}

TEST(Suggest, TakesTheFirstOfEquals) {
    const std::vector<std::string> words = {"abcde1", "abcde2"};
    EXPECT_EQ(suggestNearest("abcde3", words), "abcde1");
}

}  // namespace
}  // namespace fluxwalk::cli
