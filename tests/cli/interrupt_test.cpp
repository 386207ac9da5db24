#include "core/cli/interrupt.h"

#include <gtest/gtest.h>

namespace fluxwalk::cli {
namespace {

TEST(Interrupt, FirstSignalOnlyAsks) {
    const Interrupt interrupt;
    EXPECT_FALSE(Interrupt::isRequested());
    raise(SIGINT);
    EXPECT_TRUE(Interrupt::isRequested());
}

TEST(Interrupt, EachStartsAfresh) {
    {
        const Interrupt interrupt;
        raise(SIGTERM);
        EXPECT_TRUE(Interrupt::isRequested());
    }
    const Interrupt interrupt;
    EXPECT_FALSE(Interrupt::isRequested());
}

TEST(InterruptDeathTest, SecondSignalEndsTheProgram) {
    EXPECT_EXIT(
        {
            const Interrupt interrupt;
            raise(SIGINT);
            raise(SIGINT);
            std::exit(0);
        },
        testing::KilledBySignal(SIGINT), "");
}

TEST(InterruptDeathTest, SignalsAreAsBeforeAfterwards) {
    EXPECT_EXIT(
        {
            { const Interrupt interrupt; }
            raise(SIGTERM);
            std::exit(0);
        },
        testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace fluxwalk::cli
