#pragma once

#include <string_view>

namespace fluxwalk::cli {

/// Number typed for an option, within [minimum, maximum]. Throws base::UsageError that names option, range
/// and unit.
double parseNumberOption(std::string_view option, std::string_view text, double minimum, double maximum,
                         std::string_view unit);

/// The same for whole numbers.
unsigned parseCountOption(std::string_view option, std::string_view text, unsigned minimum, unsigned maximum);

}  // namespace fluxwalk::cli
