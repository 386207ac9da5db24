#include "core/cli/light_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/cli/suggest.h"
#include "core/cli/values.h"

namespace fluxwalk::cli {

namespace {

constexpr const char* kOption = "--light";

float parseFactor(std::string_view text) {
    return static_cast<float>(
        parseNumberOption(kOption, text, 0.0, static_cast<double>(scene::kLargestLightFactor), "times"));
}

}  // namespace

TurnedLight parseTurnedLight(std::string_view text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string_view::npos || equals == 0) {
        throw base::UsageError(fmt::format("{}: '{}' is not NAME=FACTOR or NAME=r,g,b", kOption, text));
    }
    TurnedLight light;
    light.name = text.substr(0, equals);
    const std::string_view value = text.substr(equals + 1);
    const std::size_t first = value.find(',');
    if (first == std::string_view::npos) {
        light.factor = scene::Rgb(parseFactor(value));
        return light;
    }
    const std::size_t second = value.find(',', first + 1);
    if (second == std::string_view::npos) {
        throw base::UsageError(fmt::format("{}: '{}' is neither a factor nor three, r,g,b", kOption, value));
    }
    light.factor = {parseFactor(value.substr(0, first)),
                    parseFactor(value.substr(first + 1, second - first - 1)),
                    parseFactor(value.substr(second + 1))};
    return light;
}

scene::Lighting turnLights(const std::vector<TurnedLight>& lights, const scene::Scene& scene,
                           scene::Lighting lighting) {
    if (lights.empty()) {
        return lighting;
    }
    const std::vector<scene::LightSource> sources = scene::listLightSources(scene);
    std::vector<std::string> names;
    for (const scene::LightSource& source : sources) {
        names.push_back(source.name);
    }
    for (const TurnedLight& light : lights) {
        bool isFound = false;
        for (const scene::LightSource& source : sources) {
            if (source.name == light.name) {
                scene::setFactor(lighting, source, light.factor);
                isFound = true;
            }
        }
        if (!isFound) {
            throw base::UsageError(fmt::format("{}: nothing that shines is called '{}' here; there is: {}{}",
                                               kOption, light.name, fmt::join(names, ", "),
                                               didYouMean(light.name, names)));
        }
    }
    return lighting;
}

}  // namespace fluxwalk::cli
