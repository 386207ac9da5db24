#include "core/cli/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/cli/output.h"
#include "core/cli/progress.h"
#include "core/io/file.h"
#include "core/solve/options_table.h"

namespace fluxwalk::cli {

namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(solve::Outcome outcome) {
    switch (outcome) {
        case solve::Outcome::reachedError:
            return "reachedError";
        case solve::Outcome::reachedTimeLimit:
            return "reachedTimeLimit";
        case solve::Outcome::reachedLinkLimit:
            return "reachedLinkLimit";
        case solve::Outcome::reachedMemoryLimit:
            return "reachedMemoryLimit";
        case solve::Outcome::stopped:
            break;
    }
    return "stopped";
}

/// What ended a solve before the requested error.
const char* describeEnd(solve::Outcome outcome) {
    switch (outcome) {
        case solve::Outcome::stopped:
            return " (stopped before)";
        case solve::Outcome::reachedTimeLimit:
            return " (time limit before)";
        case solve::Outcome::reachedLinkLimit:
            return " (link limit before)";
        case solve::Outcome::reachedMemoryLimit:
            return " (memory limit before)";
        case solve::Outcome::reachedError:
            break;
    }
    return "";
}

template <class Vector>
Json toArray(const Vector& v) {
    return Json::array({v.x, v.y, v.z});
}

Json optionsJson(const SolverArguments& arguments) {
    Json json;
    for (const solve::OptionInfo& option : solve::optionsTable()) {
        const double value = option.get(arguments.options);
        Json& entry = json[std::string(option.name)];
        switch (option.kind) {
            case solve::OptionKind::choice:
                entry = solve::formatOption(option, value);
                break;
            case solve::OptionKind::flag:
                entry = value != 0.0;
                break;
            case solve::OptionKind::bytes:
            case solve::OptionKind::integer:
                entry = static_cast<std::uint64_t>(value);
                break;
            case solve::OptionKind::fraction:
            case solve::OptionKind::quantity:
                entry = value;
                break;
        }
    }
    json["threads"] = arguments.threads;
    return json;
}

/// Bytes for one of them; null where there is none.
Json ratio(std::uint64_t bytes, std::uint64_t count) {
    return count == 0 ? Json() : Json(static_cast<double>(bytes) / static_cast<double>(count));
}

Json countersJson(const solve::Counters& c) {
    return {{"nodes", c.nodes},
            {"leaves", c.leaves},
            {"links", c.links},
            {"waves", c.waves},
            {"sweeps", c.sweeps},
            {"rays", c.rays},
            {"kernelEvaluations", c.kernelEvaluations},
            {"certificates", c.certificates},
            {"bytesNodes", c.bytesNodes},
            {"bytesLinks", c.bytesLinks},
            {"bytesCounted", c.bytesCounted},
            {"bytesPerNode", ratio(c.bytesNodes, c.nodes)},
            {"bytesPerLink", ratio(c.bytesLinks, c.links)}};
}

Json timesJson(const solve::StageTimes& t) {
    return {{"build", t.build}, {"refine", t.refine},   {"sweep", t.sweep},
            {"audit", t.audit}, {"display", t.display}, {"total", t.total}};
}

Json auditJson(const solve::Audit& a) {
    return {{"emitted", toArray(a.emitted)},  {"absorbed", toArray(a.absorbed)},
            {"escaped", toArray(a.escaped)},  {"relativeDefect", a.relativeDefect()},
            {"isClosed", a.isClosed},         {"rowDefectMean", a.rowDefectMean},
            {"rowDefectP99", a.rowDefectP99}, {"pullDefect", a.pullDefect}};
}

/// Estimates are negative while unknown.
Json knownOrNull(double value) {
    return value < 0.0 ? Json() : Json(value);
}

}  // namespace

Json toJson(const solve::Statistics& s) {
    Json history = Json::array();
    for (const solve::HistoryEntry& entry : s.history) {
        history.push_back({{"seconds", entry.seconds},
                           {"threshold", entry.threshold},
                           {"residual", entry.residual},
                           {"error", knownOrNull(entry.error)},
                           {"links", entry.links}});
    }
    return {{"estimatedError", knownOrNull(s.estimatedError)},
            {"meanIrradiance", s.meanIrradiance},
            {"residual", s.residual},
            {"threshold", s.threshold},
            {"largestLinkError", s.largestError},
            {"counters", countersJson(s.counters)},
            {"seconds", timesJson(s.times)},
            {"audit", auditJson(s.audit)},
            {"history", std::move(history)}};
}

Json toJson(const Report& report) {
    Json json = {{"program", "fluxwalk"},
                 {"version", FLUXWALK_VERSION},
                 {"command", report.command},
                 {"scene", toJson(report.scene)},
                 {"options", optionsJson(report.arguments)},
                 {"outcome", nameOf(report.outcome)}};
    json.update(toJson(report.statistics));
    json["counters"]["bytesPeak"] = report.bytesPeak;
    json["outputs"] = report.outputs;
    json["units"] = {{"error", "part of the mean irradiance"},
                     {"irradiance, threshold and largestLinkError", "lux"},
                     {"audit", "lm for red, green and blue"},
                     {"scene", scene::kDescriptionUnits}};
    return json;
}

std::string formatSummary(const Report& report) {
    const solve::Statistics& s = report.statistics;
    const solve::Counters& c = s.counters;
    std::string text;
    for (const std::string& output : report.outputs) {
        text += fmt::format("wrote      {}\n", output);
    }
    const std::string achieved =
        s.estimatedError < 0.0 ? "not estimated" : fmt::format("{:.2g} %", 100.0 * s.estimatedError);
    text += fmt::format("error      {} of the mean, {:g} % requested{}\n", achieved,
                        100.0 * report.arguments.options.error, describeEnd(report.outcome));
    if (s.largestError > s.threshold) {
        text += fmt::format("links      left with errors of up to {:.3g} lux, {:.3g} lux wanted\n",
                            s.largestError, s.threshold);
    }
    text += fmt::format("mean       {:.4g} lux\n", s.meanIrradiance);
    text += fmt::format("work       {} links between {} elements, {} rays, {}\n", c.links, c.leaves, c.rays,
                        formatDuration(s.times.total));
    const auto lumens = [](const base::Vec3d& flux) { return base::luminance(base::Rgb(flux)); };
    text +=
        fmt::format("balance    {:.4g} lm emitted, {:.4g} absorbed, {:.4g} escaped, {:.2g} % unaccounted\n",
                    lumens(s.audit.emitted), lumens(s.audit.absorbed), lumens(s.audit.escaped),
                    100.0 * s.audit.relativeDefect());
    if (report.arguments.options.pullRule != solve::PullRule::trueArea) {
        text += fmt::format("pull       {:+.2g} % of the radiated power, made by the projected rule\n",
                            100.0 * s.audit.pullDefect);
    }
    return text;
}

std::string toText(const Json& json) {
    // Names from files may hold bytes that are no UTF-8: they are replaced, not refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void deliver(const Report& report, const OutputArguments& output) {
    if (!output.report.empty() || output.json) {
        const std::string text = toText(toJson(report));
        if (!output.report.empty()) {
            writeOutput([&] { io::writeFile(output.report, text); });
        }
        if (output.json) {
            printText(text);
        }
    }
    if (!output.json && !output.quiet) {
        printText(formatSummary(report));
    }
}

}  // namespace fluxwalk::cli
