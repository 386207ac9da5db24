#pragma once

#include <cstdint>
#include <string>

/// Numbers as people read them, three digits that matter.
namespace fluxwalk::ui {

/// "950", "12.4 k", "3.10 M".
std::string formatCount(std::uint64_t count);
/// "0.0123", "12.3", "1230", "1.2e+06".
std::string formatValue(double value);
/// Seconds as "12 ms", "3.45 s", "2 min 05 s".
std::string formatSeconds(double seconds);
/// A part of one as "2.0 %".
std::string formatPercent(double part);
/// Bytes as "12.4 MiB".
std::string formatBytes(std::uint64_t bytes);

}  // namespace fluxwalk::ui
