#pragma once

#include <string_view>

#include "core/solve/options.h"

namespace fluxwalk::ui {

/// A row of the panel for an entry of solve::optionsTable(): a slider within its range, a box where 0 stands
/// for something of its own, a list or a tick. On hover: its explanation, range and default. Returns whether
/// it changed. `present`: the value that a slider starts from where 0 was chosen.
bool drawOption(std::string_view name, const char* label, solve::Options& options, double present = 0.0);

}  // namespace fluxwalk::ui
