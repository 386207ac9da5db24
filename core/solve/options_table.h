#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/solve/options.h"

/// Every option of the solver once: what the command line offers, the panel shows and the report repeats.
namespace fluxwalk::solve {

enum class OptionKind : std::uint8_t {
    fraction,  ///< shown and typed in percent ("2%" or 0.02)
    quantity,  ///< a real number with a unit
    integer,   ///< whole, up to 2^53
    bytes,     ///< shown and typed with K, M, G or T for powers of 1024
    flag,      ///< 0 or 1
    choice     ///< index into `choices`
};

struct OptionInfo {
    std::string_view name{};  ///< as typed after "--", "time-limit"
    OptionKind kind = OptionKind::quantity;
    std::string_view unit{};  ///< "lux", "m2", "s", "links" or empty
    double minimum = 0.0;
    double maximum = 0.0;
    std::vector<std::string_view> choices{};
    /// What 0 means where it does not mean zero, "automatic"; empty otherwise.
    std::string_view zero{};
    std::string_view explanation{};
    double (*get)(const Options&) = nullptr;
    void (*set)(Options&, double) = nullptr;

    double defaultValue() const { return get(Options{}); }
};

/// In the order in which they are shown.
std::span<const OptionInfo> optionsTable();

/// The entry of that name, or nullptr.
const OptionInfo* findOption(std::string_view name);

/// Value of what the user typed. Throws base::UsageError that names the option and its range.
double parseOption(const OptionInfo& option, std::string_view text);

/// The value as the user would type it, with its unit: "2 %", "bounded", "0.5 lux".
std::string formatOption(const OptionInfo& option, double value);

/// "0.01 % to 100 %", "bounded, bfa, bf or strict"; empty for flags.
std::string describeRange(const OptionInfo& option);

}  // namespace fluxwalk::solve
