#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/cli/report.h"

namespace fluxwalk::cli {

namespace {

using Json = nlohmann::ordered_json;

// Beyond these many lines of one sort, a count tells more to a reader; JSON holds all.
constexpr std::size_t kMostLines = 12;

template <class Vector>
Json toArray(const Vector& v) {
    return Json::array({v.x, v.y, v.z});
}

template <class Items, class Format>
void appendItems(std::string& text, const Items& items, Format format) {
    for (std::size_t i = 0; i < std::min(items.size(), kMostLines); ++i) {
        text += "  " + format(items[i]) + "\n";
    }
    if (items.size() > kMostLines) {
        text += fmt::format("  and {} more\n", items.size() - kMostLines);
    }
}

std::string formatLight(const scene::LightDescription& light) {
    const bool isDirectional = light.kind == scene::LightKind::directional;
    return fmt::format("{}: {} light, {:.4g} {}{}", light.name, scene::nameOf(light.kind),
                       base::luminance(light.intensity), isDirectional ? "lux" : "cd",
                       isDirectional ? std::string() : fmt::format(", {:.4g} lm", light.lumens));
}

std::string formatBounds(const scene::Box& bounds) {
    const scene::Vec3d size = bounds.size();
    return fmt::format(
        "{:.4g} x {:.4g} x {:.4g} m, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}), y up", size.x,
        size.y, size.z, bounds.lower.x, bounds.lower.y, bounds.lower.z, bounds.upper.x, bounds.upper.y,
        bounds.upper.z);
}

}  // namespace

Json toJson(const scene::SceneDescription& s) {
    Json kinds = Json::array();
    for (const scene::SurfaceKindDescription& kind : s.kinds) {
        kinds.push_back(
            {{"kind", kind.kind}, {"objects", kind.objects}, {"patches", kind.patches}, {"area", kind.area}});
    }
    Json emitters = Json::array();
    for (const scene::EmitterDescription& emitter : s.emitters) {
        emitters.push_back({{"object", emitter.object},
                            {"area", emitter.area},
                            {"flux", toArray(emitter.flux)},
                            {"lumens", emitter.lumens},
                            {"doubleSided", emitter.doubleSided}});
    }
    Json lights = Json::array();
    for (const scene::LightDescription& light : s.lights) {
        lights.push_back({{"name", light.name},
                          {"kind", scene::nameOf(light.kind)},
                          {"intensity", toArray(light.intensity)},
                          {"lumens", light.lumens}});
    }
    return {{"name", s.name},
            {"objects", s.objects},
            {"patches", s.patches},
            {"triangles", s.triangles},
            {"droppedTriangles", s.droppedTriangles},
            {"sides", s.sides},
            {"area", s.area},
            {"emittingArea", s.emittingArea},
            {"doubleSidedArea", s.doubleSidedArea},
            {"surfaces", std::move(kinds)},
            {"emitters", std::move(emitters)},
            {"lights", std::move(lights)},
            {"lumens", s.lumens},
            {"sky", toArray(s.sky)},
            {"materials", s.materials},
            {"images", s.images},
            {"bounds", {{"lower", toArray(s.bounds.lower)}, {"upper", toArray(s.bounds.upper)}}},
            {"cameras", s.cameras},
            {"warnings", s.warnings},
            {"units", scene::kDescriptionUnits}};
}

std::string formatDescription(const scene::SceneDescription& s) {
    std::string text = fmt::format("scene      {}\n", s.name);
    text += fmt::format("bounds     {}\n", formatBounds(s.bounds));
    text += fmt::format(
        "objects    {} with {} patches ({} sides), {:.4g} m2; {} triangles, {} without area dropped\n",
        s.objects, s.patches, s.sides, s.area, s.triangles, s.droppedTriangles);
    appendItems(text, s.kinds, [](const scene::SurfaceKindDescription& kind) {
        return fmt::format("{}: {} objects, {} patches, {:.4g} m2", kind.kind, kind.objects, kind.patches,
                           kind.area);
    });
    text += fmt::format("materials  {}, {} images; {:.4g} m2 marked double-sided\n", s.materials, s.images,
                        s.doubleSidedArea);
    text += fmt::format("emitters   {} surfaces ({:.4g} m2) and {} lights, {:.4g} lm\n", s.emitters.size(),
                        s.emittingArea, s.lights.size(), s.lumens);
    appendItems(text, s.emitters, [](const scene::EmitterDescription& emitter) {
        return fmt::format("{}: {:.4g} m2, {:.4g} lm{}", emitter.object, emitter.area, emitter.lumens,
                           emitter.doubleSided ? ", both sides" : "");
    });
    appendItems(text, s.lights, formatLight);
    text += fmt::format("sky        {:.4g} lux\n", base::luminance(s.sky));
    text += fmt::format("cameras    {}\n", s.cameras.size());
    appendItems(text, s.cameras, [](const std::string& name) { return name; });
    text += fmt::format("warnings   {}\n", s.warnings.size());
    for (const std::string& warning : s.warnings) {
        text += "  " + warning + "\n";
    }
    return text;
}

}  // namespace fluxwalk::cli
