#include "core/cli/sensor_arguments.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/cli/suggest.h"
#include "core/cli/values.h"
#include "core/io/sensors_csv.h"

namespace fluxwalk::cli {

namespace {

constexpr const char* kGrid = "--grid";
constexpr double kLeastSpacing = 1e-3;
constexpr double kLargestSpacing = 1e4;
constexpr double kFarthest = 1e6;

}  // namespace

GridRequest parseGrid(const std::string& text) {
    const std::size_t comma = text.rfind(',');
    if (comma == std::string::npos || comma == 0) {
        throw base::UsageError(
            fmt::format("--grid: '{}' is neither OBJECT,SPACING nor plane:y=HEIGHT,SPACING", text));
    }
    GridRequest request;
    request.spacing =
        parseNumberOption(kGrid, text.substr(comma + 1), kLeastSpacing, kLargestSpacing, "metres");
    const std::string what = text.substr(0, comma);
    constexpr std::string_view kPlane = "plane:";
    if (!what.starts_with(kPlane)) {
        request.object = what;
        return request;
    }
    constexpr std::string_view kHeight = "plane:y=";
    if (!what.starts_with(kHeight)) {
        throw base::UsageError(fmt::format("--grid: '{}' is not plane:y=HEIGHT, in metres", what));
    }
    request.height = parseNumberOption(kGrid, what.substr(kHeight.size()), -kFarthest, kFarthest, "metres");
    return request;
}

std::uint32_t findObject(const scene::Scene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.objects[i].name == name) {
            return i;
        }
        names.push_back(scene.objects[i].name);
    }
    std::string hint = didYouMean(name, names);
    if (hint.empty()) {
        constexpr std::size_t kShown = 8;
        std::string list;
        for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i) {
            list += (i > 0 ? ", " : "") + names[i];
        }
        hint = "; it has " + list +
               (names.size() > kShown ? fmt::format(" and {} more", names.size() - kShown) : "");
    }
    throw base::UsageError(
        base::toOneLine(fmt::format("--grid: the scene has no object '{}'{}", name, hint)));
}

void addSensorOptions(CLI::App& app, SensorArguments& arguments) {
    CLI::Option* sensors =
        app.add_option("--sensors", arguments.sensors,
                       "Points and normals, on surfaces or in free space: a header and rows "
                       "x,y,z,nx,ny,nz (metres, y up).");
    sensors->type_name("IN.csv")->group("Sensors");
    app.add_option_function<std::string>(
           "--grid", [&arguments](const std::string& text) { arguments.grid = parseGrid(text); },
           "Sensors in regular order instead, SPACING metres apart: over the sides of an object that light "
           "reaches, as in 'desk,0.1', or looking up from a horizontal plane over the whole scene, as in "
           "plane:y=0.8,0.25.")
        ->type_name("OBJECT|plane:y=H,SPACING")
        ->excludes(sensors)
        ->group("Sensors");
}

SensorSource::SensorSource(const SensorArguments& arguments, const std::string& command)
    : request_(arguments.grid) {
    if (request_) {
        return;
    }
    if (arguments.sensors.empty()) {
        throw base::UsageError(command + ": where? --sensors IN.csv or --grid OBJECT,SPACING is needed");
    }
    sensors_ = io::readSensors(arguments.sensors);
}

void SensorSource::check(const scene::Scene& scene) const {
    if (!request_) {
        return;
    }
    if (request_->height) {
        image::makePlaneGrid(scene, *request_->height, request_->spacing);
    } else {
        findObject(scene, request_->object);
    }
}

image::Grid SensorSource::make(const scene::Scene& scene, const hierarchy::ReachedSides& reached) const {
    if (!request_) {
        image::Grid grid;
        grid.sensors = sensors_;
        return grid;
    }
    return request_->height ? image::makePlaneGrid(scene, *request_->height, request_->spacing)
                            : image::makeObjectGrid(scene, reached, findObject(scene, request_->object),
                                                    request_->spacing);
}

}  // namespace fluxwalk::cli
