#include <set>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/cli/values.h"
#include "core/solve/options_table.h"

namespace fluxwalk::solve {
namespace {

double parse(const char* name, const char* text) {
    const OptionInfo* option = findOption(name);
    EXPECT_NE(option, nullptr) << name;
    return parseOption(*option, text);
}

/// The message with which a value is refused; empty where it is taken.
std::string refusal(const char* name, const char* text) {
    try {
        parse(name, text);
    } catch (const base::UsageError& error) {
        return error.what();
    }
    return {};
}

TEST(OptionsTable, EntriesAreCompleteAndUnique) {
    std::set<std::string_view> names;
    for (const OptionInfo& option : optionsTable()) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name;
        EXPECT_GT(option.explanation.size(), 20u) << option.name;
        EXPECT_LE(option.minimum, option.defaultValue()) << option.name;
        EXPECT_GE(option.maximum, option.defaultValue()) << option.name;
        EXPECT_LT(option.minimum, option.maximum) << option.name;
        EXPECT_EQ(option.kind == OptionKind::choice, !option.choices.empty()) << option.name;
        if (option.kind == OptionKind::quantity) {
            EXPECT_FALSE(option.unit.empty()) << option.name;
        }
    }
}

TEST(OptionsTable, GettersAndSettersMeetInOneField) {
    for (const OptionInfo& option : optionsTable()) {
        Options options;
        const double other = option.defaultValue() == option.minimum ? option.maximum : option.minimum;
        option.set(options, other);
        EXPECT_EQ(option.get(options), other) << option.name;
        for (const OptionInfo& unrelated : optionsTable()) {
            if (unrelated.name != option.name) {
                EXPECT_EQ(unrelated.get(options), unrelated.defaultValue())
                    << option.name << " changes " << unrelated.name;
            }
        }
    }
}

TEST(OptionsTable, DefaultsAreTheProgramsOwn) {
    EXPECT_EQ(findOption("error")->defaultValue(), 0.02);
    EXPECT_EQ(formatOption(*findOption("error"), 0.02), "2 %");
    EXPECT_EQ(formatOption(*findOption("oracle"), 0.0), "bounded");
    EXPECT_EQ(formatOption(*findOption("threshold"), 0.0), "automatic");
    EXPECT_EQ(formatOption(*findOption("threshold"), 0.5), "0.5 lux");
    EXPECT_EQ(formatOption(*findOption("time-limit"), 0.0), "none");
    EXPECT_EQ(formatOption(*findOption("seed"), 9007199254740992.0), "9007199254740992");
    EXPECT_EQ(findOption("eror"), nullptr);
}

TEST(OptionsTable, ChoicesFollowTheEnum) {
    EXPECT_EQ(parse("oracle", "bounded"), static_cast<double>(OracleKind::bounded));
    EXPECT_EQ(parse("oracle", "bfa"), static_cast<double>(OracleKind::bfa));
    EXPECT_EQ(parse("oracle", "bf"), static_cast<double>(OracleKind::bf));
    EXPECT_EQ(parse("oracle", "strict"), static_cast<double>(OracleKind::strict));
    EXPECT_EQ(refusal("oracle", "fb"), "--oracle: 'fb' is not bounded, bfa, bf or strict");
}

TEST(OptionsTable, FractionsComeInPercentOrAsNumbers) {
    EXPECT_DOUBLE_EQ(parse("error", "2%"), 0.02);
    EXPECT_DOUBLE_EQ(parse("error", "0.5 %"), 0.005);
    EXPECT_DOUBLE_EQ(parse("error", "0.02"), 0.02);
    EXPECT_DOUBLE_EQ(parse("error", "1e-3"), 0.001);
    EXPECT_EQ(refusal("error", "2"), "--error: '2' is not 0.01 % to 100 %; did you mean 2%?");
    EXPECT_EQ(refusal("error", "200%"), "--error: '200%' is not 0.01 % to 100 %");
    for (const char* bad : {"", "%", "two", "2%%", "0", "-1%", "nan", "inf", "0x1p-3", "2,5%", " 2%"}) {
        EXPECT_NE(refusal("error", bad), "") << bad;
    }
}

TEST(OptionsTable, QuantitiesAndIntegersAreBounded) {
    EXPECT_EQ(parse("threshold", "0.25"), 0.25);
    EXPECT_EQ(parse("seed", "12345678901"), 12345678901.0);
    for (const char* bad : {"-1", "1e10", "nan", "inf", "1 lux", ""}) {
        EXPECT_NE(refusal("threshold", bad), "") << bad;
    }
    for (const char* bad : {"1.5", "-1", "1e300", "x"}) {
        EXPECT_NE(refusal("seed", bad), "") << bad;
    }
    EXPECT_EQ(refusal("threshold", "-1"), "--threshold: '-1' is not 0 to 1e+09 lux");
}

TEST(OptionsTable, FormattedValuesParseBack) {
    for (const char* name : {"error", "seed", "oracle"}) {
        const OptionInfo& option = *findOption(name);
        EXPECT_EQ(parseOption(option, formatOption(option, option.defaultValue())), option.defaultValue())
            << name;
    }
}

TEST(Values, NumbersAndCountsNameTheirRange) {
    EXPECT_EQ(cli::parseNumberOption("--sky", "10000", 0.0, 1e6, "lux"), 10000.0);
    EXPECT_EQ(cli::parseCountOption("--threads", "8", 0, 1024), 8u);
    for (const char* bad : {"-1", "nan", "", "1e7", "3 lux"}) {
        EXPECT_THROW(cli::parseNumberOption("--sky", bad, 0.0, 1e6, "lux"), base::UsageError) << bad;
    }
    for (const char* bad : {"-1", "1.5", "", "1025", "99999999999999999999"}) {
        EXPECT_THROW(cli::parseCountOption("--threads", bad, 0, 1024), base::UsageError) << bad;
    }
}

}  // namespace
}  // namespace fluxwalk::solve
