#include "viewer/app/look_arguments.h"

#include <CLI/App.hpp>

#include "core/cli/values.h"
#include "viewer/app/choice.h"

namespace fluxwalk::app {
namespace {

using render::Shown;
using render::ValueScale;

constexpr const char* kGroup = "Seeing why";
constexpr double kLargestValue = 1e9;
constexpr Choices<Shown, 7> kShown{{{"picture", Shown::picture},
                                    {"lux", Shown::illuminance},
                                    {"luminance", Shown::luminance},
                                    {"level", Shown::level},
                                    {"residual", Shown::residual},
                                    {"objects", Shown::objects},
                                    {"errors", Shown::linkErrors}}};
enum class OverlayName : std::uint8_t { elements, clusters, links, contributors, visibility };
constexpr Choices<OverlayName, 5> kOverlays{{{"elements", OverlayName::elements},
                                             {"clusters", OverlayName::clusters},
                                             {"links", OverlayName::links},
                                             {"contributors", OverlayName::contributors},
                                             {"visibility", OverlayName::visibility}}};
constexpr unsigned kDeepestCluster = 64;

void setOverlay(LookArguments& look, const std::string& name) {
    switch (parseChoice("--overlay", name, kOverlays)) {
        case OverlayName::elements:
            look.draw.elementEdges = true;
            return;
        case OverlayName::clusters:
            look.draw.clusterBoxes = true;
            return;
        case OverlayName::links:
            look.inspection.links = true;
            return;
        case OverlayName::contributors:
            look.inspection.contributors = true;
            return;
        case OverlayName::visibility:
            look.inspection.visibility = true;
            return;
    }
}

constexpr Choices<ValueScale, 2> kScales{{{"log", ValueScale::logarithmic}, {"linear", ValueScale::linear}}};

}  // namespace

render::ValueRange parseRange(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) {
        throw base::UsageError("--range: '" + text + "' is not two numbers as in 10:500");
    }
    const auto parse = [](const std::string& part) {
        return cli::parseNumberOption("--range", part, 0.0, kLargestValue, "lx or cd/m\u00b2");
    };
    const render::ValueRange range{parse(text.substr(0, colon)), parse(text.substr(colon + 1))};
    if (!(range.least < range.most)) {
        throw base::UsageError("--range: '" + text + "' must rise, as in 10:500");
    }
    return range;
}

void checkLook(const LookArguments& look) {
    const render::DrawSettings& draw = look.draw;
    if (draw.range && draw.range->least <= 0.0 && draw.scale == ValueScale::logarithmic) {
        throw base::UsageError("--range: a logarithmic scale must begin above 0 (or add --scale linear)");
    }
    if (draw.range && (draw.shown != Shown::illuminance && draw.shown != Shown::luminance)) {
        throw base::UsageError("--range is for --show lux and --show luminance");
    }
}

void addLookOptions(CLI::App& app, LookArguments& look) {
    app.add_option_function<std::string>(
           "--show",
           [&look](const std::string& text) { look.draw.shown = parseChoice("--show", text, kShown); },
           "What is seen: the picture, or as colours with a legend the light that arrives (lux) or the "
           "brightness of the surfaces (luminance, in cd/m\u00b2), how often elements are quartered (level), "
           "what "
           "a further sweep would change (residual), each object in a colour of its own, or the error in lux "
           "that "
           "the links of each element leave in its light (errors).")
        ->type_name("picture|lux|luminance|level|residual|objects|errors")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--scale",
           [&look](const std::string& text) { look.draw.scale = parseChoice("--scale", text, kScales); },
           "Scale of the colours; log by default.")
        ->type_name("log|linear")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--range", [&look](const std::string& text) { look.draw.range = parseRange(text); },
           "Values of the first and the last colour, in lux or cd/m\u00b2; by default round numbers about "
           "what the "
           "scene has.")
        ->type_name("FROM:TO")
        ->group(kGroup);
    app.add_flag_callback(
           "--no-isolines", [&look] { look.draw.isolines = false; },
           "No lines of equal value at the legend's round numbers.")
        ->group(kGroup);
    app.add_option_function<std::vector<std::string>>(
           "--overlay",
           [&look](const std::vector<std::string>& names) {
               for (const std::string& name : names) {
                   setOverlay(look, name);
               }
           },
           "What is drawn over it, names with commas between: edges of the elements, boxes of the clusters; "
           "of the point of --pick the links of its element (wider lines carry more light), a list of "
           "what lights it, and its links by how much of each is not blocked (visibility).")
        ->delimiter(',')
        ->type_name("elements,clusters,links,contributors,visibility")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--cluster-level",
           [&look](const std::string& text) {
               look.draw.clusterDepth = cli::parseCountOption("--cluster-level", text, 0, kDeepestCluster);
           },
           "Clusters so many steps below the whole scene; 5 by default.")
        ->type_name("N")
        ->group(kGroup);
    app.add_option_function<std::vector<double>>(
           "--pick",
           [&look](const std::vector<double>& pixel) { look.pick = base::Vec2d(pixel[0], pixel[1]); },
           "With --screenshot: marks the point that is seen at a pixel, counted from the upper left, and "
           "prints "
           "its values, as measure gives them.")
        ->delimiter(',')
        ->expected(2)
        ->type_name("X,Y")
        ->group(kGroup);
}

}  // namespace fluxwalk::app
