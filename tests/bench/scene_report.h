#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "tests/bench/convergence.h"
#include "tests/bench/transport_costs.h"

namespace fluxwalk::bench {

/// What is hoped for, printed beside what was measured; on 2 cores, from a loaded scene.
struct Target {
    solve::ErrorOf what{};
    double error = 0.0;
    double seconds = 0.0;
};
struct Targets {
    double firstSeconds = 0.1;
    double firstError = 0.3;
    double bytesPerNode = 200.0;
    double bytesPerLink = 16.0;  ///< directed
    std::vector<Target> times{{solve::ErrorOf::gathered, 0.02, 0.3},
                              {solve::ErrorOf::gathered, 0.01, 1.0},
                              {solve::ErrorOf::gathered, 0.005, 4.0},
                              {solve::ErrorOf::displayed, 0.02, 1.5}};
};

/// All measurements of one scene.
struct SceneReport {
    std::string scene;
    unsigned threads = 0;
    unsigned repeats = 0;
    double load = 0.0;  ///< of the machine, mean of the last minute, before the first run
    std::size_t sensorCount = 0;
    std::size_t hiddenCount = 0;
    double meanIrradiance = 0.0;  ///< lux, of the reference
    NoiseFigures noise;
    FirstSnapshot first;
    std::vector<Level> gatheredLevels;
    std::vector<Level> displayedLevels;
    std::vector<ClosedLoop> loops;
    TransportCosts costs;

    const std::vector<Level>& levels(solve::ErrorOf what) const {
        return what == solve::ErrorOf::displayed ? displayedLevels : gatheredLevels;
    }
};

/// A table for people.
std::string formatReport(const SceneReport& report, const Targets& targets);
/// The same numbers; seconds, fractions, lux and bytes.
nlohmann::ordered_json toJson(const SceneReport& report, const Targets& targets);

}  // namespace fluxwalk::bench
