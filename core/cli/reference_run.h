#pragma once

#include <cstdint>
#include <string>

#include "core/reference/path_tracer.h"

namespace CLI {
class App;
}

namespace fluxwalk::cli {

/// How long the reference traces: until the first of these is reached. 0 stands for no limit.
struct TraceLimits {
    std::uint64_t paths = 0;  ///< for each sensor
    double seconds = 0.0;
    double precision = 0.0;  ///< RMS of the standard errors by the mean, of illuminance
};

/// Declares --paths, --time and --precision.
void addTraceOptions(CLI::App& app, TraceLimits& limits);

/// RMS of the standard errors of illuminance by its mean; infinite while a sensor has none.
double precisionOf(const reference::IrradianceTracer& tracer);

/// Adds paths, with progress on standard error, until a limit or Ctrl-C; without any limit, `fallback` paths
/// for each sensor. Returns whether it was stopped by Ctrl-C; what was done by then stays.
bool traceUntil(reference::IrradianceTracer& tracer, TraceLimits limits, std::uint64_t fallback, bool quiet);

}  // namespace fluxwalk::cli
