#include "core/cli/light_arguments.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/scene/builders.h"

namespace fluxwalk::cli {
namespace {

using scene::Rgb;

std::string refusalOf(std::string_view text) {
    try {
        parseTurnedLight(text);
    } catch (const base::UsageError& error) {
        return error.what();
    }
    return {};
}

TEST(LightArguments, factorsAndColours) {
    EXPECT_EQ(parseTurnedLight("lamp=0").factor, Rgb(0.0f));
    EXPECT_EQ(parseTurnedLight("lamp=0.25").factor, Rgb(0.25f));
    const TurnedLight colored = parseTurnedLight("a=b=1,0.5,0");
    EXPECT_EQ(colored.name, "a=b");
    EXPECT_EQ(colored.factor, Rgb(1.0f, 0.5f, 0.0f));
}

TEST(LightArguments, whatCannotBeIsRefused) {
    for (const char* text : {"lamp", "=1", "lamp=", "lamp=-1", "lamp=nan", "lamp=1001", "lamp=1,2",
                             "lamp=1,2,3,4", "lamp=1,,2", "lamp=bright"}) {
        EXPECT_NE(refusalOf(text).find("--light"), std::string::npos) << text;
    }
}

TEST(LightArguments, namesAreThoseOfTheScene) {
    scene::Scene scene = *scene::buildScene("cornell-box");
    scene.lights.resize(2);
    scene.lights[1].name = "spot";
    scene.sky = Rgb(100.0f);
    const std::vector<scene::LightSource> sources = scene::listLightSources(scene);
    ASSERT_EQ(sources.size(), 4u);
    EXPECT_EQ(sources[1].name, "light 0");
    scene::Lighting before;
    before.lights = {Rgb(0.5f)};
    const scene::Lighting lighting =
        turnLights({{"spot", Rgb(2.0f)}, {"sky", Rgb(0.0f)}, {sources[0].name, Rgb(0.1f)}}, scene, before);
    EXPECT_EQ(lighting.ofLight(0), Rgb(0.5f));
    EXPECT_EQ(lighting.ofLight(1), Rgb(2.0f));
    EXPECT_EQ(lighting.sky, Rgb(0.0f));
    EXPECT_EQ(lighting.ofMaterial(sources[0].index), Rgb(0.1f));
    try {
        turnLights({{"sopt", Rgb(1.0f)}}, scene, {});
        FAIL();
    } catch (const base::UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean 'spot'"), std::string::npos);
    }
}

TEST(LightArguments, neutralListsOfAnyLengthAreTheSame) {
    scene::Lighting lighting;
    lighting.materials.assign(5, Rgb(1.0f));
    EXPECT_TRUE(lighting.isNeutral());
    lighting.materials[4].b = 0.5f;
    EXPECT_FALSE(lighting.isNeutral());
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    EXPECT_EQ(scene::relightScene(scene, {}), scene);
}

}  // namespace
}  // namespace fluxwalk::cli
