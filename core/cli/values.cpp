#include "core/cli/values.h"

#include <charconv>

#include <fmt/format.h>

#include "core/base/error.h"

namespace fluxwalk::cli {

namespace {

template <class Number>
bool parseWhole(std::string_view text, Number& value) {
    const char* last = text.data() + text.size();
    const auto [end, failure] = std::from_chars(text.data(), last, value);
    return failure == std::errc{} && end == last;
}

}  // namespace

double parseNumberOption(std::string_view option, std::string_view text, double minimum, double maximum,
                         std::string_view unit) {
    double value = 0.0;
    // Written so that it is also false for NaN.
    if (!parseWhole(text, value) || !(value >= minimum && value <= maximum)) {
        throw base::UsageError(
            fmt::format("{}: '{}' is not {:g} to {:g} {}", option, text, minimum, maximum, unit));
    }
    return value;
}

unsigned parseCountOption(std::string_view option, std::string_view text, unsigned minimum,
                          unsigned maximum) {
    unsigned value = 0;
    if (!parseWhole(text, value) || value < minimum || value > maximum) {
        throw base::UsageError(
            fmt::format("{}: '{}' is not a whole number from {} to {}", option, text, minimum, maximum));
    }
    return value;
}

}  // namespace fluxwalk::cli
