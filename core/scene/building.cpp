#include "core/scene/building.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/scene/builders.h"

namespace fluxwalk::scene {

namespace {

constexpr std::string_view kPrefix = "building:";
constexpr unsigned kFewestPolygons = 10'000;
constexpr unsigned kMostPolygons = 2'000'000;
/// Polygons for each room, its part of corridor and stairs included, that the coarsest furniture takes at
/// most.
constexpr unsigned kFewestPerRoom = 1150;

unsigned parseCount(std::string_view name, std::string_view text, std::string_view what, unsigned least,
                    unsigned most) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
        throw base::UsageError(
            fmt::format("{}: {} must be a whole number from {} to {}", name, what, least, most));
    }
    return value;
}

// Rooms of the coarsest furniture that take about so many polygons.
building::Plan planFor(unsigned polygons) {
    building::Plan plan = building::planStoreys(polygons / kFewestPerRoom);
    // Corridors and stairs do not grow in proportion, so the number is corrected twice.
    for (int i = 0; i < 3; ++i) {
        const std::size_t made = building::construct(nullptr, plan, {}, {});
        const double rooms = plan.rooms * (static_cast<double>(polygons) / static_cast<double>(made));
        plan = building::planStoreys(std::max(1u, static_cast<unsigned>(std::lround(rooms))));
    }
    return plan;
}

// Fineness with which a plan takes about so many polygons.
building::Detail detailFor(const building::Plan& plan, unsigned polygons) {
    const auto missOf = [&](double level) {
        return static_cast<double>(building::construct(nullptr, plan, {}, {level})) - polygons;
    };
    building::Detail best;
    double bestMiss = missOf(best.level);
    double low = 1.0;
    double high = 1.0;
    double miss = bestMiss;
    const auto keep = [&](double level) {
        miss = missOf(level);
        if (std::abs(miss) < std::abs(bestMiss)) {
            best.level = level;
            bestMiss = miss;
        }
    };
    while (miss < 0.0) {
        low = high;
        high *= 2.0;
        keep(high);
    }
    constexpr double kCloseEnough = 0.01;
    for (int i = 0; i < 20 && std::abs(bestMiss) > kCloseEnough * polygons; ++i) {
        const double level = std::sqrt(low * high);
        keep(level);
        (miss < 0.0 ? low : high) = level;
    }
    return best;
}

}  // namespace

bool isBuilding(std::string_view name) {
    return name.starts_with(kPrefix);
}

Scene buildBuilding(std::string_view name) {
    const std::string_view sizes = name.substr(kPrefix.size());
    const std::size_t colon = sizes.find(':');
    const unsigned polygons =
        parseCount(name, sizes.substr(0, colon), "the number of polygons", kFewestPolygons, kMostPolygons);
    building::Plan plan;
    building::Detail detail;
    if (colon == std::string_view::npos) {
        plan = planFor(polygons);
    } else {
        plan = building::planStoreys(
            parseCount(name, sizes.substr(colon + 1), "the number of rooms", 1, polygons / kFewestPerRoom));
        detail = detailFor(plan, polygons);
    }
    Scene scene;
    scene.name = name;
    building::construct(&scene, plan, building::addPalette(scene), detail);
    building::addCameras(scene, plan);
    return scene;
}

}  // namespace fluxwalk::scene
