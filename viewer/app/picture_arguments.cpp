#include <CLI/App.hpp>

#include "core/cli/values.h"
#include "viewer/app/choice.h"
#include "viewer/app/look_arguments.h"

namespace fluxwalk::app {
namespace {

using render::ToneCurve;

constexpr const char* kGroup = "Picture";
constexpr Choices<ToneCurve, 4> kCurves{{{"linear", ToneCurve::linear},
                                         {"filmic", ToneCurve::filmic},
                                         {"reinhard", ToneCurve::reinhard},
                                         {"hue", ToneCurve::hue}}};
constexpr double kDarkest = -20.0;
constexpr double kBrightest = 30.0;
constexpr unsigned kMostSamples = 16;

}  // namespace

void addToneOptions(CLI::App& app, LookArguments& look) {
    app.add_option_function<std::string>(
           "--tone",
           [&look](const std::string& text) { look.draw.curve = parseChoice("--tone", text, kCurves); },
           "From light to the screen: filmic by default, with dark tones deepened and highlights rolled off; "
           "linear clips at white; reinhard compresses highlights; hue is filmic by the brightest channel, "
           "so "
           "that no colour drifts.")
        ->type_name("linear|filmic|reinhard|hue")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--exposure",
           [&look](const std::string& text) {
               look.draw.exposure = render::exposureFromValue(
                   cli::parseNumberOption("--exposure", text, kDarkest, kBrightest, "EV"));
           },
           "Exposure value at ISO 100: white is at 1.2 x 2^EV cd/m\u00b2. By default metered on what is "
           "seen, "
           "most on its middle.")
        ->type_name("EV")
        ->group(kGroup);
}

void addPictureOptions(CLI::App& app, LookArguments& look) {
    addToneOptions(app, look);
    app.add_option_function<std::string>(
           "--samples",
           [&look](const std::string& text) {
               look.samples = static_cast<int>(cli::parseCountOption("--samples", text, 1, kMostSamples));
           },
           "Samples a pixel of a written picture, for smooth edges; 8 by default.")
        ->type_name("N")
        ->group(kGroup);
    app.add_flag_callback(
           "--glow", [&look] { look.draw.glow = true; },
           "The veil that lenses and eyes spread around lamps: a twentieth of the light, blurred.")
        ->group(kGroup);
}

}  // namespace fluxwalk::app
