#include "core/cli/sensor_files.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/cli/output.h"
#include "core/cli/report.h"
#include "core/image/grid.h"
#include "core/io/file.h"
#include "core/io/sensors_csv.h"

namespace fluxwalk::cli {

namespace {

using base::Vec3d;
using Json = nlohmann::ordered_json;

Json toArray(const Vec3d& v) {
    return Json::array({v.x, v.y, v.z});
}

const char* nameOf(image::SensorPlace place) {
    switch (place) {
        case image::SensorPlace::surface:
            return "surface";
        case image::SensorPlace::space:
            return "space";
        case image::SensorPlace::solid:
            break;
    }
    return "solid";
}

Json statisticsJson(const image::IlluminanceStatistics& s) {
    return {{"count", s.count},     {"inSolids", s.inSolids}, {"mean", s.mean},
            {"minimum", s.minimum}, {"maximum", s.maximum},   {"uniformity", s.uniformity}};
}

double medianWidth(std::span<const image::Measurement> measured) {
    std::vector<double> widths;
    for (const image::Measurement& m : measured) {
        if (m.place != image::SensorPlace::solid && m.illuminance > 0.0) {
            widths.push_back((m.high - m.low) / m.illuminance);
        }
    }
    if (widths.empty()) {
        return 0.0;
    }
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::nth_element(widths.begin(), middle, widths.end());
    return *middle;
}

Json measurementsJson(std::span<const scene::Sensor> sensors, std::span<const image::Measurement> measured,
                      image::IntervalKind kind) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const image::Measurement& m = measured[i];
        rows.push_back({{"position", toArray(sensors[i].position)},
                        {"normal", toArray(sensors[i].normal)},
                        {"irradiance", toArray(Vec3d(m.irradiance))},
                        {"lux", m.illuminance},
                        {"interval", Json::array({m.low, m.high})},
                        {"deviations",
                         {{"shadows", m.parts.shadows},
                          {"range", m.parts.range},
                          {"kernel", m.parts.kernel},
                          {"solution", m.parts.solution},
                          {"gaps", m.parts.gaps},
                          {"defect", m.parts.defect}}},
                        {"place", nameOf(m.place)}});
    }
    return {{"units", "metres; lux, irradiance per channel of linear Rec. 709"},
            {"interval", kind == image::IntervalKind::likely ? "99 %" : "strict"},
            {"statistics", statisticsJson(image::summarize(measured))},
            {"medianIntervalWidth", medianWidth(measured)},
            {"sensors", std::move(rows)}};
}

}  // namespace

bool isJsonFile(const std::filesystem::path& file) {
    return file.extension() == ".json";
}

void writeMeasurements(const std::filesystem::path& file, std::span<const scene::Sensor> sensors,
                       std::span<const image::Measurement> measured, image::IntervalKind kind) {
    if (isJsonFile(file)) {
        const std::string text = toText(measurementsJson(sensors, measured, kind));
        writeOutput([&] { io::writeFile(file, text); });
        return;
    }
    std::vector<Vec3d> irradiance;
    io::SensorColumn low{"low", {}};
    io::SensorColumn high{"high", {}};
    io::SensorColumn solid{"solid", {}};
    for (const image::Measurement& m : measured) {
        irradiance.emplace_back(m.irradiance);
        low.values.push_back(m.low);
        high.values.push_back(m.high);
        solid.values.push_back(m.place == image::SensorPlace::solid ? 1.0 : 0.0);
    }
    io::SensorTable table{{sensors.begin(), sensors.end()}, io::irradianceColumns(irradiance)};
    for (io::SensorColumn* column : {&low, &high, &solid}) {
        table.columns.push_back(std::move(*column));
    }
    writeOutput([&] { io::writeSensorTable(file, table); });
}

void writeReference(const std::filesystem::path& file, std::span<const scene::Sensor> sensors,
                    std::span<const reference::Estimate> estimates,
                    const reference::IrradianceTracer& tracer) {
    Json rows = Json::array();
    io::SensorTable table;
    std::vector<Vec3d> irradiance;
    std::vector<io::SensorColumn> errors{{"se_r", {}}, {"se_g", {}}, {"se_b", {}}, {"se_lux", {}}};
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const reference::Estimate& e = estimates[i];
        if (!std::isfinite(e.luminanceError)) {
            continue;
        }
        if (isJsonFile(file)) {
            rows.push_back({{"position", toArray(sensors[i].position)},
                            {"normal", toArray(sensors[i].normal)},
                            {"irradiance", toArray(e.mean)},
                            {"standardError", toArray(e.standardError)},
                            {"lux", e.luminance},
                            {"luxStandardError", e.luminanceError}});
            continue;
        }
        table.sensors.push_back(sensors[i]);
        irradiance.push_back(e.mean);
        for (int c = 0; c < 3; ++c) {
            errors[static_cast<std::size_t>(c)].values.push_back(e.standardError[c]);
        }
        errors[3].values.push_back(e.luminanceError);
    }
    if (isJsonFile(file)) {
        const std::string text = toText({{"units", "metres; lux, irradiance per channel of linear Rec. 709"},
                                         {"paths", tracer.paths()},
                                         {"rays", tracer.rays()},
                                         {"sensors", std::move(rows)}});
        writeOutput([&] { io::writeFile(file, text); });
        return;
    }
    table.columns = io::irradianceColumns(irradiance);
    for (io::SensorColumn& column : errors) {
        table.columns.push_back(std::move(column));
    }
    writeOutput([&] { io::writeSensorTable(file, table); });
}

std::string describeMeasurements(std::span<const image::Measurement> measured, image::IntervalKind kind) {
    const image::IlluminanceStatistics s = image::summarize(measured);
    std::string text = fmt::format("{} sensors: mean {:.4g} lx, least {:.4g} lx, most {:.4g} lx, U0 {:.2f}\n",
                                   s.count, s.mean, s.minimum, s.maximum, s.uniformity);
    text +=
        fmt::format("{} intervals: {:.1f} % wide (median)\n",
                    kind == image::IntervalKind::likely ? "99 %" : "strict", 100.0 * medianWidth(measured));
    if (s.inSolids > 0) {
        text += fmt::format("{} more lie in solids or where no light comes: flagged, and not counted\n",
                            s.inSolids);
    }
    return text;
}

}  // namespace fluxwalk::cli
