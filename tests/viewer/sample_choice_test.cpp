#include "viewer/app/sample_choice.h"

#include <gtest/gtest.h>

namespace fluxwalk::app {
namespace {

TEST(SampleChoice, TakesFewerWhereFramesAreSlow) {
    SampleChoice choice(4, false);
    EXPECT_EQ(choice.choose(true), 4);
    for (int i = 0; i < 2; ++i) {
        choice.report(4, 0.1);
    }
    EXPECT_EQ(choice.choose(true), 4);  // one hitch is none
    choice.report(4, 0.1);
    EXPECT_EQ(choice.choose(true), 2);
    EXPECT_EQ(choice.choose(false), 4);  // standing still, all of them
    choice.report(4, 0.1);               // a picture at rest says nothing of those in motion
    choice.report(4, 0.1);
    choice.report(4, 0.1);
    EXPECT_EQ(choice.choose(true), 2);
}

TEST(SampleChoice, ComesBackSlowly) {
    SampleChoice choice(4, true);
    EXPECT_EQ(choice.choose(true), 1);
    for (int i = 0; i < 59; ++i) {
        choice.report(1, 0.005);
    }
    EXPECT_EQ(choice.choose(true), 1);
    choice.report(1, 0.005);
    EXPECT_EQ(choice.choose(true), 2);
}

}  // namespace
}  // namespace fluxwalk::app
