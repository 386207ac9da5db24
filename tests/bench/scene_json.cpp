#include <nlohmann/json.hpp>

#include "tests/bench/scene_report.h"

namespace fluxwalk::bench {

namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(solve::ErrorOf what) {
    return what == solve::ErrorOf::displayed ? "displayed" : "gathered";
}

Json figures(const ErrorFigures& e) {
    return {{"rms", e.rms}, {"p95", e.p95}, {"bias", e.bias}};
}

Json errors(const TrueErrors& e) {
    return {{"leaves", figures(e.leaves)},
            {"displayed", figures(e.displayed)},
            {"gathered", figures(e.gathered)}};
}

Json work(const solve::Statistics& s) {
    const solve::Counters& c = s.counters;
    return {{"leaves", c.leaves},
            {"links", c.links},
            {"rays", c.rays},
            {"kernelEvaluations", c.kernelEvaluations},
            {"certificates", c.certificates},
            {"sweeps", c.sweeps}};
}

Json levels(const std::vector<Level>& levels) {
    Json json = Json::array();
    for (const Level& level : levels) {
        json.push_back({{"threshold", level.statistics.threshold},
                        {"seconds", level.duration.seconds},
                        {"cpuSeconds", level.duration.cpuSeconds},
                        {"work", work(level.statistics)},
                        {"estimatedError", level.statistics.estimatedError},
                        {"errors", errors(level.errors)}});
    }
    return json;
}

Json loop(const ClosedLoop& loop, const TransportCosts& costs) {
    const solve::StageTimes& t = loop.statistics.times;
    const RefineShares s = estimateShares(costs, loop.statistics.counters, loop.duration.cpuSeconds);
    return {{"of", nameOf(loop.what)},
            {"requested", loop.requested},
            {"seconds", loop.duration.seconds},
            {"cpuSeconds", loop.duration.cpuSeconds},
            {"isReached", loop.isReached},
            {"estimatedError", loop.statistics.estimatedError},
            {"work", work(loop.statistics)},
            {"errors", errors(loop.errors)},
            {"stages",
             {{"build", t.build},
              {"refine", t.refine},
              {"sweep", t.sweep},
              {"audit", t.audit},
              {"display", t.display}}},
            {"cpuShares", {{"formFactors", s.formFactors}, {"rays", s.rays}, {"tracing", s.tracing}}}};
}

Json costs(const TransportCosts& c) {
    return {{"links", c.links},
            {"testedLinks", c.testedLinks},
            {"perFactor", c.perFactor},
            {"perEvaluation", c.perEvaluation},
            {"perCertificate", c.perCertificate},
            {"perRay", c.perRay},
            {"perBundledRay", c.perBundledRay},
            {"perSingleRay", c.perSingleRay}};
}

Json timesToError(const SceneReport& r, const Targets& targets) {
    Json json = Json::array();
    for (const Target& target : targets.times) {
        const Level* level = firstBelow(r.levels(target.what), target.what, target.error);
        Json entry{{"of", nameOf(target.what)},
                   {"error", target.error},
                   {"targetSeconds", target.seconds},
                   {"seconds", nullptr}};
        if (level != nullptr) {
            entry["seconds"] = level->duration.seconds;
            const auto between = interpolateSeconds(r.levels(target.what), target.what, target.error);
            entry["interpolatedSeconds"] = between ? Json(*between) : Json();
            entry["work"] = work(level->statistics);
        }
        json.push_back(entry);
    }
    return json;
}

}  // namespace

Json toJson(const SceneReport& r, const Targets& targets) {
    const solve::Counters& n = r.loops.back().statistics.counters;
    Json json{{"scene", r.scene},
              {"threads", r.threads},
              {"repeats", r.repeats},
              {"load", r.load},
              {"reference",
               {{"sensors", r.sensorCount},
                {"hidden", r.hiddenCount},
                {"meanIrradiance", r.meanIrradiance},
                {"noise", {{"rms", r.noise.rms}, {"p95", r.noise.p95}, {"bias", r.noise.bias}}}}},
              {"firstSnapshot",
               {{"seconds", r.first.duration.seconds},
                {"cpuSeconds", r.first.duration.cpuSeconds},
                {"targetSeconds", targets.firstSeconds},
                {"error", r.first.error},
                {"targetError", targets.firstError},
                {"links", r.first.links},
                {"leaves", r.first.leaves}}},
              {"timesToError", timesToError(r, targets)},
              {"gatheredLevels", levels(r.gatheredLevels)},
              {"displayedLevels", levels(r.displayedLevels)}};
    for (const ClosedLoop& l : r.loops) {
        json["closedLoops"].push_back(loop(l, r.costs));
    }
    json["nanoseconds"] = costs(r.costs);
    json["bytesPerNode"] = {{"value", static_cast<double>(n.bytesNodes) / static_cast<double>(n.nodes)},
                            {"target", targets.bytesPerNode}};
    json["bytesPerDirectedLink"] = {
        {"value", 0.5 * static_cast<double>(n.bytesLinks) / static_cast<double>(n.links)},
        {"target", targets.bytesPerLink}};
    return json;
}

}  // namespace fluxwalk::bench
