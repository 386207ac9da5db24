#include "viewer/ui/format.h"

#include <cmath>

#include <fmt/format.h>

namespace fluxwalk::ui {
namespace {

/// Smaller parts are noise that nobody wants digits of.
constexpr double kLeastPart = 1e-5;

/// Three digits in all.
std::string withThreeDigits(double value) {
    const double size = std::abs(value);
    const int decimals = size >= 99.95 ? 0 : size >= 9.995 ? 1 : size >= 0.9995 ? 2 : size >= 0.09995 ? 3 : 4;
    return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

std::string formatCount(std::uint64_t count) {
    const auto value = static_cast<double>(count);
    if (count < 10000) {
        return fmt::format("{}", count);
    }
    if (value < 999.5e3) {
        return withThreeDigits(value / 1e3) + " k";
    }
    if (value < 999.5e6) {
        return withThreeDigits(value / 1e6) + " M";
    }
    return withThreeDigits(value / 1e9) + " G";
}

std::string formatValue(double value) {
    const double size = std::abs(value);
    if (size == 0.0) {
        return "0";
    }
    return size < 1e-3 || size >= 1e6 ? fmt::format("{:.2e}", value) : withThreeDigits(value);
}

std::string formatSeconds(double seconds) {
    if (seconds < 0.9995) {
        return fmt::format("{:.0f} ms", seconds * 1e3);
    }
    if (seconds < 99.95) {
        return withThreeDigits(seconds) + " s";
    }
    const long whole = std::lround(seconds);
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

std::string formatPercent(double part) {
    if (part != 0.0 && std::abs(part) < kLeastPart) {
        return "< 0.001 %";
    }
    return formatValue(part * 100.0) + " %";
}

std::string formatBytes(std::uint64_t bytes) {
    const double kibibytes = static_cast<double>(bytes) / 1024.0;
    if (kibibytes < 1023.5) {
        return withThreeDigits(kibibytes) + " KiB";
    }
    if (kibibytes < 1023.5 * 1024.0) {
        return withThreeDigits(kibibytes / 1024.0) + " MiB";
    }
    return withThreeDigits(kibibytes / (1024.0 * 1024.0)) + " GiB";
}

}  // namespace fluxwalk::ui
