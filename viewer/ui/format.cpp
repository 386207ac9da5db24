#include "viewer/ui/format.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace fluxwalk::ui {
namespace {

template <class... Values>
std::string print(const char* format, Values... values) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

/// Digits behind the point that leave three in all.
int decimals(double value) {
    const double size = std::abs(value);
    return size >= 99.95 ? 0 : size >= 9.995 ? 1 : size >= 0.9995 ? 2 : size >= 0.09995 ? 3 : 4;
}

}  // namespace

std::string formatCount(std::uint64_t count) {
    const auto value = static_cast<double>(count);
    if (count < 10000) {
        return std::to_string(count);
    }
    if (value < 999.5e3) {
        return print("%.*f k", decimals(value / 1e3), value / 1e3);
    }
    if (value < 999.5e6) {
        return print("%.*f M", decimals(value / 1e6), value / 1e6);
    }
    return print("%.*f G", decimals(value / 1e9), value / 1e9);
}

std::string formatValue(double value) {
    const double size = std::abs(value);
    if (size != 0.0 && (size < 1e-3 || size >= 1e6)) {
        return print("%.2e", value);
    }
    return print("%.*f", size == 0.0 ? 0 : decimals(value), value);
}

std::string formatSeconds(double seconds) {
    if (seconds < 0.9995) {
        return print("%.0f ms", seconds * 1e3);
    }
    if (seconds < 99.95) {
        return print("%.*f s", decimals(seconds), seconds);
    }
    const auto whole = static_cast<long>(std::lround(seconds));
    return print("%ld min %02ld s", whole / 60, whole % 60);
}

std::string formatPercent(double part) {
    const double percent = part * 100.0;
    return std::abs(percent) < 1e-3 && percent != 0.0 ? print("%.1e %%", percent)
                                                      : print("%.*f %%", decimals(percent), percent);
}

std::string formatBytes(std::uint64_t bytes) {
    const auto value = static_cast<double>(bytes);
    if (value < 1024.0 * 1024.0) {
        return print("%.*f KiB", decimals(value / 1024.0), value / 1024.0);
    }
    const double mebibytes = value / (1024.0 * 1024.0);
    if (mebibytes < 1023.5) {
        return print("%.*f MiB", decimals(mebibytes), mebibytes);
    }
    return print("%.*f GiB", decimals(mebibytes / 1024.0), mebibytes / 1024.0);
}

}  // namespace fluxwalk::ui
