#include <iterator>

#include <fmt/format.h>

#include "tests/bench/scene_report.h"

namespace fluxwalk::bench {

namespace {

using Out = std::back_insert_iterator<std::string>;

const char* nameOf(solve::ErrorOf what) {
    return what == solve::ErrorOf::displayed ? "displayed mesh" : "sensors";
}

std::string shorten(std::uint64_t n) {
    return n < 10'000       ? fmt::format("{}", n)
           : n < 10'000'000 ? fmt::format("{:.0f}k", static_cast<double>(n) * 1e-3)
                            : fmt::format("{:.1f}M", static_cast<double>(n) * 1e-6);
}

std::string describeRequest(const ClosedLoop& loop) {
    return fmt::format("{:g} % {:.4}", 100.0 * loop.requested, nameOf(loop.what));
}

constexpr const char* kColumns =
    "{:>11}     wall      CPU  leaves   links    rays  kernels   leaf constant       displayed mesh"
    "      gathered\n{:>11}        s        s                                    RMS   p95   bias"
    "    RMS   p95   bias    RMS   p95   bias\n";

// Work and errors in the columns of above.
std::string describeState(const Duration& duration, const solve::Counters& c, const TrueErrors& errors) {
    std::string text =
        fmt::format("{:>8.3f} {:>8.3f} {:>7} {:>7} {:>7} {:>8} ", duration.seconds, duration.cpuSeconds,
                    shorten(c.leaves), shorten(c.links), shorten(c.rays), shorten(c.kernelEvaluations));
    for (const ErrorFigures& e : {errors.leaves, errors.displayed, errors.gathered}) {
        text += fmt::format(" {:5.2f} {:5.2f} {:+6.2f}", 100.0 * e.rms, 100.0 * e.p95, 100.0 * e.bias);
    }
    return text;
}

void addHeader(Out out, const SceneReport& r) {
    fmt::format_to(out,
                   "{}: {} threads, fastest of {} runs, from a loaded scene; load of the machine {:.1f}\n"
                   "{} sensors of {} drawn ({} lie under solids), mean {:.1f} lux\n"
                   "Errors in %: RMS and bias of the mean, p95 of |E - E*| / E* where E* > 0.1 mean.\n"
                   "Noise of the reference: {:.2f} RMS, taken off; {:.2f} in p95, not taken off; {:.2f} in "
                   "bias.\n\n",
                   r.scene, r.threads, r.repeats, r.load, r.sensorCount, r.sensorCount + r.hiddenCount,
                   r.hiddenCount, r.meanIrradiance, 100.0 * r.noise.rms, 100.0 * r.noise.p95,
                   100.0 * r.noise.bias);
}

void addTargets(Out out, const SceneReport& r, const Targets& targets) {
    fmt::format_to(out, "{:<24} {:>8}  {:>7} {:>8} {:>8}\n", "Time to error", "seconds", "target", "between",
                   "CPU");
    fmt::format_to(
        out, "{:<24} {:>8.3f}  {:>7g} {:>8} {:>8.3f}   really {:.1f} % (target {:g} %), {} links\n",
        "first lit snapshot", r.first.duration.seconds, targets.firstSeconds, "", r.first.duration.cpuSeconds,
        100.0 * r.first.error, 100.0 * targets.firstError, shorten(r.first.links));
    for (const Target& target : targets.times) {
        const Level* level = firstBelow(r.levels(target.what), target.what, target.error);
        const std::string goal = fmt::format("{:g} % {}", 100.0 * target.error, nameOf(target.what));
        if (level == nullptr) {
            fmt::format_to(out, "{:<24} {:>8}  {:>7g}\n", goal, "never", target.seconds);
            continue;
        }
        const auto between = interpolateSeconds(r.levels(target.what), target.what, target.error);
        const solve::Counters& c = level->statistics.counters;
        fmt::format_to(out, "{:<24} {:>8.3f}  {:>7g} {:>8} {:>8.3f}   really {:.2f} %, {} rays, {} links\n",
                       goal, level->duration.seconds, target.seconds,
                       between ? fmt::format("{:.3f}", *between) : "", level->duration.cpuSeconds,
                       100.0 * level->errors.of(target.what), shorten(c.rays), shorten(c.links));
    }
    fmt::format_to(out,
                   "(seconds: the first level of a refining run whose true error is below; between: "
                   "interpolated from the level before)\n\n");
}

void addLevels(Out out, const std::vector<Level>& levels, const char* title) {
    fmt::format_to(out, "{}\n", title);
    fmt::format_to(out, fmt::runtime(kColumns), "threshold", "lux");
    for (const Level& level : levels) {
        const solve::Statistics& s = level.statistics;
        fmt::format_to(out, "{:>11.4g} {}\n", s.threshold,
                       describeState(level.duration, s.counters, level.errors));
    }
    fmt::format_to(out, "\n");
}

void addLoops(Out out, const SceneReport& r) {
    fmt::format_to(out, "Closed loop: stops by its own estimate, converged and audited\n");
    fmt::format_to(out, fmt::runtime(kColumns), "requested", "");
    for (const ClosedLoop& loop : r.loops) {
        fmt::format_to(out, "{:>11} {}   estimated {:.2f}{}\n", describeRequest(loop),
                       describeState(loop.duration, loop.statistics.counters, loop.errors),
                       100.0 * loop.statistics.estimatedError, loop.isReached ? "" : ", out of time");
    }
    fmt::format_to(out, "\n");
}

void addShares(Out out, const SceneReport& r) {
    fmt::format_to(out,
                   "Share of each stage in %; refinement's parts are CPU costs times counters\n"
                   "{:>11}   build  refine = factors    rays (traced)    rest   sweep   audit (display)\n",
                   "requested");
    for (const ClosedLoop& loop : r.loops) {
        const solve::StageTimes& t = loop.statistics.times;
        const RefineShares s = estimateShares(r.costs, loop.statistics.counters, loop.duration.cpuSeconds);
        const auto part = [&](double seconds) { return 100.0 * seconds / loop.duration.seconds; };
        fmt::format_to(
            out,
            "{:>11} {:>7.1f} {:>7.1f} = {:>7.1f} {:>7.1f} {:>8.1f} {:>7.1f} {:>7.1f} {:>7.1f} {:>9.1f}\n",
            describeRequest(loop), part(t.build), part(t.refine), 100.0 * s.formFactors, 100.0 * s.rays,
            100.0 * s.tracing, part(t.refine) - 100.0 * (s.formFactors + s.rays), part(t.sweep),
            part(t.audit), part(t.display));
    }
    fmt::format_to(out,
                   "(rest: certificates, decisions, splits, lists; audit holds the error estimate, which "
                   "holds the display)\n\n");
}

void addCosts(Out out, const SceneReport& r, const Targets& targets) {
    const TransportCosts& c = r.costs;
    const ClosedLoop& last = r.loops.back();
    const solve::Counters& n = last.statistics.counters;
    const double refineCpu = last.statistics.times.refine * last.duration.cpuSeconds / last.duration.seconds;
    fmt::format_to(out,
                   "CPU time, over {} links ({} that are not certainly open): form factor {:.2f} us, "
                   "certificate {:.2f} us, ray with its generation {:.0f} ns\n",
                   shorten(c.links), shorten(c.testedLinks), 1e-3 * c.perFactor, 1e-3 * c.perCertificate,
                   c.perRay);
    fmt::format_to(out,
                   "Million rays a CPU second: {:.1f} in refinement as a whole, {:.1f} in visibility, {:.1f} "
                   "bare in bundles of 16, {:.1f} bare one by one\n"
                   "(bare: segments made beforehand, Embree through the guard of core/rays)\n",
                   1e-6 * static_cast<double>(n.rays) / refineCpu, 1e3 / c.perRay, 1e3 / c.perBundledRay,
                   1e3 / c.perSingleRay);
    fmt::format_to(
        out,
        "Bytes: {:.1f} a node (target {:g}); {:.1f} a directed link (target {:g}): a record and two "
        "list entries serve both directions\n",
        static_cast<double>(n.bytesNodes) / static_cast<double>(n.nodes), targets.bytesPerNode,
        0.5 * static_cast<double>(n.bytesLinks) / static_cast<double>(n.links), targets.bytesPerLink);
}

}  // namespace

std::string formatReport(const SceneReport& report, const Targets& targets) {
    std::string text;
    const Out out(text);
    addHeader(out, report);
    addTargets(out, report, targets);
    addLevels(out, report.gatheredLevels, "Levels of a run for sensors");
    addLevels(out, report.displayedLevels, "Levels of a run for the displayed mesh");
    addLoops(out, report);
    addShares(out, report);
    addCosts(out, report, targets);
    return text;
}

}  // namespace fluxwalk::bench
