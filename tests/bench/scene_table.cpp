#include <iterator>

#include <fmt/format.h>

#include "tests/bench/scene_report.h"

namespace fluxwalk::bench {

namespace {

using Out = std::back_insert_iterator<std::string>;

const char* nameOf(solve::ErrorOf what) {
    return what == solve::ErrorOf::displayed ? "displayed mesh" : "sensors";
}

std::string thousands(std::uint64_t n) {
    return n < 10'000       ? fmt::format("{}", n)
           : n < 10'000'000 ? fmt::format("{:.0f}k", static_cast<double>(n) * 1e-3)
                            : fmt::format("{:.1f}M", static_cast<double>(n) * 1e-6);
}

std::string workOf(const solve::Counters& c) {
    return fmt::format("{:>7} {:>7} {:>7} {:>8}", thousands(c.leaves), thousands(c.links), thousands(c.rays),
                       thousands(c.kernelEvaluations));
}

std::string errorsOf(const TrueErrors& errors) {
    std::string text;
    for (const ErrorFigures& e : {errors.leaves, errors.displayed, errors.gathered}) {
        text += fmt::format("  {:5.2f} {:5.2f} {:+6.2f}", 100.0 * e.rms, 100.0 * e.p95, 100.0 * e.bias);
    }
    return text;
}

constexpr const char* kColumns =
    "{:>11} {:>8} {:>7} {:>7} {:>7} {:>8}   leaf constant        displayed mesh       gathered\n"
    "{:>11} {:>8} {:>7} {:>7} {:>7} {:>8}   RMS   p95   bias     RMS   p95   bias     RMS   p95   bias\n";

void addHeader(Out out, const SceneReport& r) {
    fmt::format_to(out,
                   "{}: {} threads, fastest of {} runs, load of the machine {:.1f}\n"
                   "{} sensors of {} drawn ({} lie under solids), mean {:.1f} lux, noise of the reference "
                   "{:.2f} % (taken off RMS, not off p95)\n"
                   "Seconds from a loaded scene. Errors in % of the mean; p95: of |E - E*| / E* where E* > "
                   "0.1 mean.\n\n",
                   r.scene, r.threads, r.repeats, r.load, r.sensorCount, r.sensorCount + r.hiddenCount,
                   r.hiddenCount, r.meanIrradiance, 100.0 * r.referenceNoise);
}

void addTargets(Out out, const SceneReport& r, const Targets& targets) {
    fmt::format_to(out,
                   "First lit snapshot       {:7.3f} s  (target {} s)   error {:.1f} % (target {:.0f} %), {} "
                   "links, {} leaves\n",
                   r.first.seconds, targets.firstSeconds, 100.0 * r.first.error, 100.0 * targets.firstError,
                   thousands(r.first.links), thousands(r.first.leaves));
    for (const Target& target : targets.times) {
        const Level* level = firstBelow(r.levels(target.what), target.what, target.error);
        const std::string goal = fmt::format("{:g} % {}", 100.0 * target.error, nameOf(target.what));
        if (level == nullptr) {
            fmt::format_to(out, "{:<24}  not reached (target {} s)\n", goal, target.seconds);
            continue;
        }
        const solve::Counters& c = level->statistics.counters;
        fmt::format_to(out, "{:<24} {:7.3f} s  (target {} s)   {} rays, {} links, really {:.2f} %\n", goal,
                       level->seconds, target.seconds, thousands(c.rays), thousands(c.links),
                       100.0 * level->errors.of(target.what));
    }
    fmt::format_to(out, "(first level of a refining run whose true error is below)\n\n");
}

void addLevels(Out out, const std::vector<Level>& levels, const char* title) {
    fmt::format_to(out, "{}\n", title);
    fmt::format_to(out, fmt::runtime(kColumns), "threshold", "seconds", "leaves", "links", "rays", "kernel",
                   "lux", "", "", "", "", "evals");
    for (const Level& level : levels) {
        fmt::format_to(out, "{:>11.4g} {:>8.3f} {}{}\n", level.statistics.threshold, level.seconds,
                       workOf(level.statistics.counters), errorsOf(level.errors));
    }
    fmt::format_to(out, "\n");
}

void addLoops(Out out, const SceneReport& r) {
    fmt::format_to(out, "Closed loop: stops by its own estimate\n");
    fmt::format_to(out, fmt::runtime(kColumns), "requested", "seconds", "leaves", "links", "rays", "kernel",
                   "", "", "", "", "", "evals");
    for (const ClosedLoop& loop : r.loops) {
        fmt::format_to(out, "{:>4g} % {:>4.4} {:>8.3f} {}{}   estimated {:.2f}{}\n", 100.0 * loop.requested,
                       nameOf(loop.what), loop.seconds, workOf(loop.statistics.counters),
                       errorsOf(loop.errors), 100.0 * loop.statistics.estimatedError,
                       loop.isReached ? "" : " (out of time)");
    }
    fmt::format_to(out, "\n");
}

void addShares(Out out, const SceneReport& r) {
    fmt::format_to(out,
                   "Stages in % of the seconds; refinement's parts from unit costs and counters\n"
                   "{:>11} {:>8} {:>6} {:>7} = {:>7} {:>6} {:>8} {:>6}  {:>6} {:>6} {:>8} {:>6}\n",
                   "requested", "seconds", "build", "refine", "factors", "rays", "(tracer)", "rest", "sweep",
                   "audit", "display*", "other");
    for (const ClosedLoop& loop : r.loops) {
        const solve::StageTimes& t = loop.statistics.times;
        const RefineShares s = estimateShares(r.costs, loop.statistics, r.threads);
        const auto part = [&](double seconds) { return 100.0 * seconds / loop.seconds; };
        fmt::format_to(out,
                       "{:>4g} % {:>4.4} {:>8.3f} {:>6.1f} {:>7.1f} = {:>7.1f} {:>6.1f} {:>8.1f} {:>6.1f}  "
                       "{:>6.1f} {:>6.1f} "
                       "{:>8.1f} {:>6.1f}\n",
                       100.0 * loop.requested, nameOf(loop.what), loop.seconds, part(t.build), part(t.refine),
                       part(s.formFactors), part(s.rays), part(s.tracing), part(s.rest), part(t.sweep),
                       part(t.audit), part(t.display),
                       part(loop.seconds - t.build - t.refine - t.sweep - t.audit));
    }
    fmt::format_to(out,
                   "(audit holds the error estimate; * display lies within it, or within publishing)\n\n");
}

void addCosts(Out out, const SceneReport& r, const Targets& targets) {
    const TransportCosts& c = r.costs;
    const auto rate = [&](double nanoseconds) { return 1e3 * r.threads / nanoseconds; };
    fmt::format_to(out,
                   "Unit costs of one thread over {} links ({} of them not certainly open): form factor "
                   "{:.2f} us, certificate "
                   "{:.2f} us, ray with its generation {:.0f} ns\n",
                   c.links, c.testedLinks, 1e-3 * c.perFactor, 1e-3 * c.perCertificate, c.perRay);
    const ClosedLoop& last = r.loops.back();
    fmt::format_to(
        out,
        "Million rays a second on {} threads: {:.2f} in refinement as a whole, {:.2f} in visibility, {:.2f} "
        "bare bundles of 16, {:.2f} bare single rays (bare: Embree through the guard of core/rays)\n",
        r.threads, 1e-6 * static_cast<double>(last.statistics.counters.rays) / last.statistics.times.refine,
        rate(c.perRay), rate(c.perBundledRay), rate(c.perSingleRay));
    const solve::Counters& n = last.statistics.counters;
    fmt::format_to(
        out,
        "Bytes: {:.1f} per node (target {:.0f}), {:.1f} per directed link (target {:.0f}): one record and "
        "two list entries serve both directions of a pair\n",
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
