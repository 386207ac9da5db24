#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/cli/solver_arguments.h"
#include "core/scene/describe.h"
#include "core/solve/solver.h"

/// What `--report` and `--json` hold. Numbers carry their units in their names or as said under "units".
namespace fluxwalk::cli {

struct Report {
    std::string command;
    scene::SceneDescription scene;
    SolverArguments arguments;
    solve::Outcome outcome = solve::Outcome::stopped;
    solve::Statistics statistics;
    std::vector<std::string> outputs;  ///< files written
    std::uint64_t bytesPeak = 0;       ///< most memory that the process held
};

nlohmann::ordered_json toJson(const scene::SceneDescription& scene);
nlohmann::ordered_json toJson(const solve::Statistics& statistics);
nlohmann::ordered_json toJson(const Report& report);

/// A few lines for people: error, illuminance, work and balance.
std::string formatSummary(const Report& report);
/// The scene for people, as `info` prints it.
std::string formatDescription(const scene::SceneDescription& scene);

/// JSON as text, indented, with a line's end.
std::string toText(const nlohmann::ordered_json& json);

/// Writes and prints what the user asked for. Throws WriteError.
void deliver(const Report& report, const OutputArguments& output);

}  // namespace fluxwalk::cli
