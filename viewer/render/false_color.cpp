#include "viewer/render/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fluxwalk::render {
namespace {

constexpr double kDarkPart = 0.02;
constexpr double kBrightPart = 0.99;
constexpr double kMostDecades = 4.0;
constexpr std::array<double, 4> kRound{1.0, 2.0, 5.0, 10.0};
/// A linear range has at most as many steps.
constexpr double kSteps = 6.0;
/// Ends typed as decimals may miss round numbers by rounding.
constexpr double kSlack = 1e-9;

double powerBelow(double value) {
    return std::pow(10.0, std::floor(std::log10(value) + kSlack));
}

/// The smallest of 1, 2, 5 times a power of ten that is not below.
double roundUp(double value) {
    const double power = powerBelow(value);
    for (const double digit : kRound) {
        if (digit * power >= value * (1.0 - kSlack)) {
            return digit * power;
        }
    }
    return 10.0 * power;
}

double roundDown(double value) {
    const double power = powerBelow(value);
    double result = power;
    for (const double digit : kRound) {
        if (digit * power <= value * (1.0 + kSlack)) {
            result = digit * power;
        }
    }
    return result;
}

}  // namespace

double placeOf(double value, const ValueRange& range, ValueScale scale) {
    const double place = scale == ValueScale::linear ? (value - range.least) / (range.most - range.least)
                                                     : std::log(std::max(value, 1e-30) / range.least) /
                                                           std::log(range.most / range.least);
    return std::clamp(place, 0.0, 1.0);
}

ValueRange chooseRange(const LuminanceHistogram& values, ValueScale scale) {
    if (values.isEmpty()) {
        return {scale == ValueScale::linear ? 0.0 : 0.1, 1000.0};
    }
    const double most = roundUp(values.percentile(kBrightPart));
    if (scale == ValueScale::linear) {
        return {0.0, most};
    }
    const double least = roundDown(values.percentile(kDarkPart));
    return {std::clamp(least, most * std::pow(10.0, -kMostDecades), most / 10.0), most};
}

double roundStep(const ValueRange& range) {
    return roundUp((range.most - range.least) / kSteps);
}

std::vector<double> roundNumbers(const ValueRange& range, ValueScale scale) {
    std::vector<double> numbers;
    if (scale == ValueScale::linear) {
        const double step = roundStep(range);
        const auto first = static_cast<long>(std::ceil(range.least / step - kSlack));
        const auto last = static_cast<long>(std::floor(range.most / step + kSlack));
        for (long i = first; i <= last; ++i) {
            numbers.push_back(static_cast<double>(i) * step);
        }
        return numbers;
    }
    const auto first = static_cast<int>(std::floor(std::log10(range.least) + kSlack));
    const auto last = static_cast<int>(std::floor(std::log10(range.most) + kSlack));
    for (int decade = first; decade <= last; ++decade) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double number = kRound[i] * std::pow(10.0, decade);
            if (number >= range.least * (1.0 - kSlack) && number <= range.most * (1.0 + kSlack)) {
                numbers.push_back(number);
            }
        }
    }
    return numbers;
}

}  // namespace fluxwalk::render
