#include "viewer/ui/format.h"

#include <gtest/gtest.h>

namespace fluxwalk::ui {
namespace {

TEST(Format, Counts) {
    EXPECT_EQ(formatCount(0), "0");
    EXPECT_EQ(formatCount(9999), "9999");
    EXPECT_EQ(formatCount(12345), "12.3 k");
    EXPECT_EQ(formatCount(999499), "999 k");
    EXPECT_EQ(formatCount(999500), "1.00 M");
    EXPECT_EQ(formatCount(3100000000ull), "3.10 G");
}

TEST(Format, ValuesAndParts) {
    EXPECT_EQ(formatValue(0.0), "0");
    EXPECT_EQ(formatValue(9.9951), "10.0");
    EXPECT_EQ(formatValue(99.951), "100");
    EXPECT_EQ(formatValue(-1.234), "-1.23");
    EXPECT_EQ(formatValue(0.01234), "0.0123");
    EXPECT_EQ(formatValue(1.5e-7), "1.50e-07");
    EXPECT_EQ(formatPercent(0.02), "2.00 %");
    EXPECT_EQ(formatPercent(0.0), "0 %");
    EXPECT_EQ(formatPercent(1.1e-5), "0.0011 %");
    EXPECT_EQ(formatPercent(-3e-7), "< 0.001 %");
}

TEST(Format, TimesAndBytes) {
    EXPECT_EQ(formatSeconds(0.0123), "12 ms");
    EXPECT_EQ(formatSeconds(3.456), "3.46 s");
    EXPECT_EQ(formatSeconds(125.2), "2 min 05 s");
    EXPECT_EQ(formatBytes(2048), "2.00 KiB");
    EXPECT_EQ(formatBytes(13u << 20), "13.0 MiB");
    EXPECT_EQ(formatBytes(3ull << 30), "3.00 GiB");
}

}  // namespace
}  // namespace fluxwalk::ui
