#include "core/cli/reference_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <CLI/CLI.hpp>

#include "core/cli/interrupt.h"
#include "core/cli/progress.h"
#include "core/cli/values.h"

namespace fluxwalk::cli {

namespace {

constexpr unsigned kMostPaths = 1'000'000'000;
constexpr double kLongest = 1e7;          // seconds
constexpr double kLeastPrecision = 1e-5;  // one part of the mean
/// Seconds between two looks at limits and progress.
constexpr double kPass = 0.25;
/// Groups of paths that one pass may hold, for the memory of what they bring.
constexpr std::uint64_t kMostGroups = 1u << 20;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double parsePrecision(std::string text) {
    const bool isPercent = text.ends_with('%');
    if (isPercent) {
        text.pop_back();
    }
    const double scale = isPercent ? 100.0 : 1.0;
    return parseNumberOption("--precision", text, kLeastPrecision * scale, scale, isPercent ? "%" : "of 1") /
           scale;
}

}  // namespace

void addTraceOptions(CLI::App& app, TraceLimits& limits) {
    app.add_option_function<std::string>(
           "--paths",
           [&limits](const std::string& text) {
               limits.paths = parseCountOption("--paths", text, 2, kMostPaths);
           },
           "Paths for each sensor. Default 1024 (64 for a picture) where no other limit is given; with "
           "several, "
           "the first that is reached ends the work.")
        ->type_name("N")
        ->group("Reference");
    app.add_option_function<std::string>(
           "--time",
           [&limits](const std::string& text) {
               limits.seconds = parseNumberOption("--time", text, 0.01, kLongest, "seconds");
           },
           "Seconds after which no more paths begin.")
        ->type_name("S")
        ->group("Reference");
    app.add_option_function<std::string>(
           "--precision", [&limits](const std::string& text) { limits.precision = parsePrecision(text); },
           "Trace until the standard errors (RMS) are this part of the mean illuminance, as in 0.5%.")
        ->type_name("PART|%")
        ->group("Reference");
}

double precisionOf(const reference::IrradianceTracer& tracer) {
    double squares = 0.0;
    double sum = 0.0;
    std::size_t count = 0;
    for (const reference::Estimate& e : tracer.irradiance()) {
        squares += e.luminanceError * e.luminanceError;
        sum += e.luminance;
        ++count;
    }
    const auto n = static_cast<double>(std::max<std::size_t>(1, count));
    return sum > 0.0 ? std::sqrt(squares / n) / (sum / n) : squares > 0.0 ? squares : 0.0;
}

bool traceUntil(reference::IrradianceTracer& tracer, TraceLimits limits, std::uint64_t fallback, bool quiet) {
    if (limits.paths == 0 && limits.seconds <= 0.0 && limits.precision <= 0.0) {
        limits.paths = fallback;
    }
    constexpr std::uint64_t kGroup = reference::IrradianceTracer::kGroup;
    const std::uint64_t mostPaths = limits.paths > 0 ? limits.paths : std::uint64_t{kMostPaths};
    const Interrupt interrupt;
    Progress progress(stderr, chooseStyle(stderr, quiet));
    const double start = now();
    const auto isLate = [&] { return limits.seconds > 0.0 && now() - start >= limits.seconds; };
    const auto shouldStop = [&] { return Interrupt::isRequested() || isLate(); };
    std::uint64_t pass = kGroup;
    while (tracer.paths() < mostPaths && !shouldStop()) {
        const double began = now();
        tracer.add(std::min(pass, mostPaths - tracer.paths()), shouldStop);
        const double precision = limits.precision > 0.0 ? precisionOf(tracer) : 0.0;
        double done = static_cast<double>(tracer.paths()) / static_cast<double>(mostPaths);
        if (limits.seconds > 0.0) {
            done = std::max(done, (now() - start) / limits.seconds);
        }
        if (limits.precision > 0.0 && precision > 0.0) {
            done = std::max(done, limits.precision * limits.precision / (precision * precision));
        }
        progress.update(std::min(1.0, done), "tracing");
        if (limits.precision > 0.0 && precision <= limits.precision) {
            break;
        }
        const std::uint64_t most =
            std::max<std::uint64_t>(1, kMostGroups / std::max<std::size_t>(1, tracer.sensorCount()));
        if (now() - began < kPass && 2 * pass / kGroup <= most) {
            pass *= 2;
        }
    }
    return Interrupt::isRequested();
}

}  // namespace fluxwalk::cli
