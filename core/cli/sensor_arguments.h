#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/hierarchy/reach.h"
#include "core/image/grid.h"
#include "core/scene/scene.h"

namespace CLI {
class App;
}

namespace fluxwalk::cli {

/// --grid as typed: a horizontal plane or an object, and metres between sensors.
struct GridRequest {
    std::optional<double> height;  ///< y of the plane, metres
    std::string object;
    double spacing = 0.0;
};

/// "plane:y=0.8,0.25" or "table top,0.1". Throws base::UsageError.
GridRequest parseGrid(const std::string& text);

/// Index of the object of that name, the first of several. Throws base::UsageError that suggests the nearest.
std::uint32_t findObject(const scene::Scene& scene, const std::string& name);

/// Where to measure, as typed.
struct SensorArguments {
    std::filesystem::path sensors;
    std::optional<GridRequest> grid;
};

/// Declares --sensors and --grid, of which one is needed at most.
void addSensorOptions(CLI::App& app, SensorArguments& arguments);

/// The sensors asked for, in order.
class SensorSource {
  public:
    /// Reads the file, if there is one: throws base::FileError, and base::UsageError where neither is named.
    SensorSource(const SensorArguments& arguments, const std::string& command);

    /// Looks whether the grid fits the scene, as far as that is known before light is. Throws
    /// base::UsageError.
    void check(const scene::Scene& scene) const;
    image::Grid make(const scene::Scene& scene, const hierarchy::ReachedSides& reached) const;

  private:
    std::optional<GridRequest> request_;
    std::vector<scene::Sensor> sensors_;
};

}  // namespace fluxwalk::cli
