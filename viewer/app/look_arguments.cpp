#include "viewer/app/look_arguments.h"

#include <CLI/App.hpp>

#include "core/cli/values.h"
#include "viewer/app/choice.h"

namespace fluxwalk::app {
namespace {

using render::Shown;
using render::ValueScale;

constexpr const char* kGroup = "False colour";
constexpr double kLargestValue = 1e9;
constexpr Choices<Shown, 3> kShown{
    {{"picture", Shown::picture}, {"lux", Shown::illuminance}, {"luminance", Shown::luminance}}};
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

void checkLook(const render::DrawSettings& look) {
    if (look.range && look.range->least <= 0.0 && look.scale == ValueScale::logarithmic) {
        throw base::UsageError("--range: a logarithmic scale must begin above 0 (or add --scale linear)");
    }
}

void addLookOptions(CLI::App& app, render::DrawSettings& look) {
    app.add_option_function<std::string>(
           "--show", [&look](const std::string& text) { look.shown = parseChoice("--show", text, kShown); },
           "What is seen: the picture, or as colours with a legend the light that arrives (lux) or the "
           "brightness of the surfaces (luminance, in cd/m\u00b2).")
        ->type_name("picture|lux|luminance")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--scale",
           [&look](const std::string& text) { look.scale = parseChoice("--scale", text, kScales); },
           "Scale of the colours; log by default.")
        ->type_name("log|linear")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--range", [&look](const std::string& text) { look.range = parseRange(text); },
           "Values of the first and the last colour, in lux or cd/m\u00b2; by default round numbers about "
           "what the "
           "scene has.")
        ->type_name("FROM:TO")
        ->group(kGroup);
    app.add_flag_callback(
           "--no-isolines", [&look] { look.isolines = false; },
           "No lines of equal value at the legend's round numbers.")
        ->group(kGroup);
}

}  // namespace fluxwalk::app
