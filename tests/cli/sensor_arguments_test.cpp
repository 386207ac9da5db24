#include "core/cli/sensor_arguments.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/scene/builders.h"

namespace fluxwalk::cli {
namespace {

std::string refusal(const std::function<void()>& act) {
    try {
        act();
    } catch (const base::UsageError& error) {
        return error.what();
    }
    return "no error";
}

TEST(GridArgument, NamesAPlaneOrAnObject) {
    const GridRequest plane = parseGrid("plane:y=0.8,0.25");
    EXPECT_EQ(plane.height, 0.8);
    EXPECT_EQ(plane.spacing, 0.25);
    const GridRequest object = parseGrid("desk, left,0.1");
    EXPECT_FALSE(object.height);
    EXPECT_EQ(object.object, "desk, left") << "names may hold commas";
    EXPECT_EQ(object.spacing, 0.1);
}

TEST(GridArgument, SaysWhatIsWrong) {
    const auto refusalOf = [](const char* text) { return refusal([&] { parseGrid(text); }); };
    EXPECT_NE(refusalOf("desk").find("OBJECT,SPACING"), std::string::npos);
    EXPECT_NE(refusalOf(",0.1").find("OBJECT,SPACING"), std::string::npos);
    EXPECT_NE(refusalOf("desk,0").find("--grid: '0'"), std::string::npos);
    EXPECT_NE(refusalOf("desk,-1").find("--grid: '-1'"), std::string::npos);
    EXPECT_NE(refusalOf("desk,wide").find("--grid: 'wide'"), std::string::npos);
    EXPECT_NE(refusalOf("plane:z=1,0.1").find("plane:y=HEIGHT"), std::string::npos);
    EXPECT_NE(refusalOf("plane:y=high,0.1").find("--grid: 'high'"), std::string::npos);
}

TEST(GridArgument, UnknownObjectsGetTheNearestOrAList) {
    const scene::Scene box = *scene::buildScene("cornell-box");
    EXPECT_EQ(box.objects[findObject(box, "floor")].name, "floor");
    EXPECT_NE(refusal([&] { findObject(box, "flor"); }).find("did you mean 'floor'?"), std::string::npos);
    EXPECT_NE(refusal([&] { findObject(box, "desk"); }).find("it has floor, ceiling"), std::string::npos);
}

}  // namespace
}  // namespace fluxwalk::cli
