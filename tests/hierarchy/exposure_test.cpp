#include "core/hierarchy/exposure.h"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/polygons.h"
#include "tests/support/built.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3d;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using hierarchy::Shape;
using scene::boxFaces;
using test::Built;

// A floor of 4 x 4 m under a lamp, in a room so large that nothing touches its walls; object 0 is the floor.
scene::Scene floorUnder(const scene::Quads& block) {
    scene::Scene scene;
    scene::addMaterial(scene, "grey", base::Rgb(0.5f));
    scene::addMaterial(scene, "lamp", base::Rgb(0.5f), base::Rgb(100.0f));
    scene::addPolygons(scene, "floor", 0, boxFaces({0, 0, 0}, {4, 0, 4}, scene::kTop));
    scene::addPolygons(scene, "lamp", 1, boxFaces({-2, 3, -2}, {6, 3, 6}, scene::kBottom));
    scene::addPolygons(scene, "block", 0, block);
    return scene;
}

// A box without top and bottom, turned about the vertical through (2, 2).
scene::Quads turnedBlock(double half, double degrees) {
    const double c = std::cos(degrees * 0.017453292519943295);
    const double s = std::sin(degrees * 0.017453292519943295);
    scene::Quads quads = boxFaces({-half, 0, -half}, {half, 1, half}, scene::kStanding);
    for (scene::Quad& quad : quads) {
        for (Vec3d& p : quad) {
            p = {2.0 + c * p.x + s * p.z, p.y, 2.0 - s * p.x + c * p.z};
        }
    }
    return quads;
}

void expectAncestorsToSum(const Hierarchy& tree) {
    for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
        const NodeId id{n};
        if (tree.kind(id) != NodeKind::element || tree.isLeaf(id)) {
            continue;
        }
        double sum = 0.0;
        for (unsigned c = 0; c < 4; ++c) {
            sum += static_cast<double>(tree.shape(tree.child(id, c)).areaInParent());
        }
        const Shape& shape = tree.shape(id);
        EXPECT_NEAR(static_cast<double>(shape.exposedArea()), sum, 1e-6 * static_cast<double>(shape.area));
    }
}

TEST(Exposure, cellsUnderABlockAreHidden) {
    Built built(floorUnder(boxFaces({1, 0, 1}, {2, 1, 2}, scene::kStanding)));
    const NodeId floor = built.tree.patchNode(0, 0, false);
    ASSERT_NE(floor, NodeId::none);
    const Shape whole = built.tree.shape(floor);
    EXPECT_EQ(std::popcount(whole.exposedCells), 15);
    EXPECT_FLOAT_EQ(whole.exposed, 15.0f / 16.0f);
    EXPECT_FLOAT_EQ(whole.area, 16.0f) << "the area itself is not touched";
    built.split(3);
    const Shape& after = built.tree.shape(floor);
    EXPECT_NEAR(after.exposedArea(), 15.0f, 1e-5f);
    int wholeHidden = 0;
    for (const NodeId leaf : built.leavesOf(floor)) {
        const Shape& shape = built.tree.shape(leaf);
        const bool isUnder =
            shape.center.x > 1.0f && shape.center.x < 2.0f && shape.center.z > 1.0f && shape.center.z < 2.0f;
        EXPECT_EQ(shape.exposedCells, isUnder ? 0 : 0xffff) << shape.center.x << ' ' << shape.center.z;
        wholeHidden += isUnder ? 1 : 0;
    }
    EXPECT_EQ(wholeHidden, 4);
    expectAncestorsToSum(built.tree);
}

TEST(Exposure, bitsNameTheCellsOfTheRegion) {
    const double half = 0.6;
    Built built(floorUnder(turnedBlock(half, 0.0)));
    built.split(2);
    const surface::Surface& surface = *built.scene.objects[0].surface;
    int hidden = 0;
    for (const NodeId leaf : built.leavesOf(built.tree.patchNode(0, 0, false))) {
        const surface::Region region = built.tree.region(leaf);
        for (unsigned cell = 0; cell < 16; ++cell) {
            const base::Vec2d st((cell % 4 + 0.5) / 4.0, (cell / 4 + 0.5) / 4.0);
            const Vec3d p = surface.evaluate(0, surface::mapToRegion(region, st).uv).position;
            const bool isUnder = std::abs(p.x - 2.0) < half && std::abs(p.z - 2.0) < half;
            EXPECT_EQ((built.tree.shape(leaf).exposedCells & (1u << cell)) == 0, isUnder);
            hidden += isUnder ? 1 : 0;
        }
    }
    EXPECT_GT(hidden, 10);
}

TEST(Exposure, hiddenAreaConvergesUnderATurnedBlock) {
    const double half = 0.7;
    double last = 1e9;
    for (const unsigned level : {1u, 3u, 5u}) {
        Built built(floorUnder(turnedBlock(half, 27.0)));
        built.split(level);
        expectAncestorsToSum(built.tree);
        const Shape& floor = built.tree.shape(built.tree.patchNode(0, 0, false));
        const double miss =
            std::abs(static_cast<double>(floor.area - floor.exposedArea()) - 4.0 * half * half);
        // About the block's outline times half a cell, most of which cancels.
        EXPECT_LT(miss, 0.2 * 8.0 * half * 4.0 / std::exp2(level + 2)) << level;
        last = miss;
    }
    EXPECT_LT(last, 0.01);
}

TEST(Exposure, onlyTheLeavesThatSplitChangeTheirAncestors) {
    Built built(floorUnder(turnedBlock(0.7, 27.0)));
    for (std::uint64_t round = 0; round < 5; ++round) {
        built.split(1, [&](NodeId id) { return (built.tree.key(id) >> 7 & 1u) != 0; });
        expectAncestorsToSum(built.tree);
    }
}

TEST(Exposure, theBackOfAPlateHasItsOwnCells) {
    // A plate lit from both sides; a block hangs below it, which hides cells of the back only.
    scene::Scene scene = floorUnder(boxFaces({1, -1, 1}, {2, 0, 2}, scene::kAround | scene::kBottom));
    scene::addPolygons(scene, "lower lamp", 1, boxFaces({-2, -3, -2}, {6, -3, 6}, scene::kTop));
    Built built(std::move(scene));
    const NodeId front = built.tree.patchNode(0, 0, false);
    const NodeId back = built.tree.patchNode(0, 0, true);
    ASSERT_NE(front, NodeId::none);
    ASSERT_NE(back, NodeId::none);
    EXPECT_EQ(built.tree.shape(front).exposedCells, 0xffff);
    EXPECT_EQ(std::popcount(built.tree.shape(back).exposedCells), 15);
    built.split(2);
    EXPECT_NEAR(built.tree.shape(back).exposedArea(), 15.0f, 1e-5f);
    EXPECT_NEAR(built.tree.shape(front).exposedArea(), 16.0f, 1e-5f);
    for (const NodeId leaf : built.leavesOf(back)) {
        const Shape& shape = built.tree.shape(leaf);
        const bool isUnder =
            shape.center.x > 1.0f && shape.center.x < 2.0f && shape.center.z > 1.0f && shape.center.z < 2.0f;
        EXPECT_EQ(shape.exposedCells, isUnder ? 0 : 0xffff);
    }
}

TEST(Exposure, nothingIsHiddenWhereNothingTouches) {
    const Built built(floorUnder(boxFaces({1, 0.5, 1}, {2, 1, 2})));
    for (const NodeId id : built.tree.patches()) {
        EXPECT_EQ(built.tree.shape(id).exposedCells, 0xffff);
        EXPECT_EQ(built.tree.shape(id).exposed, 1.0f);
    }
    EXPECT_NEAR(built.tree.totalArea(), 16.0 + 2 * 64.0 + 16.0 - 64.0 + 2 * 1.0 + 4 * 0.5 - 16.0, 1e-4);
}

// A plate of 2 x 2 m over the middle of the floor, thick enough that its top is nowhere near.
scene::Quads plateAbove(double gap) {
    return boxFaces({1, gap, 1}, {3, gap + 0.5, 3}, scene::kAround | scene::kBottom | scene::kTop);
}

TEST(Exposure, aNarrowGapIsDarkAtItsScale) {
    // Cells of the floor are 1 m, those of the plate's underside 0.5 m.
    for (const double gap : {0.02, 0.1}) {
        const Built built(floorUnder(plateAbove(gap)));
        const Shape& floor = built.tree.shape(built.tree.patchNode(0, 0, false));
        EXPECT_EQ(floor.exposedCells, 0xf99f) << gap;
        EXPECT_FLOAT_EQ(floor.exposedArea(), 12.0f);
        EXPECT_TRUE(floor.isCovered);
    }
    const Built wide(floorUnder(plateAbove(0.3)));
    EXPECT_EQ(wide.tree.shape(wide.tree.patchNode(0, 0, false)).exposedCells, 0xffff);
    EXPECT_FALSE(wide.tree.shape(wide.tree.patchNode(0, 0, false)).isCovered);
}

TEST(Exposure, refinementOpensAGapButNotToTheParentsLight) {
    Built built(floorUnder(plateAbove(0.1)));
    const NodeId floor = built.tree.patchNode(0, 0, false);
    built.split(2);  // elements of 1 m, cells of 0.25 m: the gap is 0.4 of one and 0.2 of their parents'
    int opened = 0;
    for (const NodeId leaf : built.leavesOf(floor)) {
        const Shape& shape = built.tree.shape(leaf);
        const bool isUnder = std::abs(shape.center.x - 2.0f) < 1.0f && std::abs(shape.center.z - 2.0f) < 1.0f;
        EXPECT_EQ(shape.exposedCells, 0xffff);
        if (isUnder) {
            ++opened;
            // At most the cells at the plate's rim show to both scales.
            EXPECT_LE(shape.partOfParent(), 0.5f);
        } else {
            EXPECT_EQ(shape.partOfParent(), 1.0f);
        }
    }
    EXPECT_EQ(opened, 4);
    const Shape& whole = built.tree.shape(floor);
    EXPECT_GE(whole.exposedArea(), 12.0f - 1e-4f);
    EXPECT_LE(whole.exposedArea(), 14.0f);
}

TEST(Exposure, aGapInWhichALampShinesIsNone) {
    scene::Scene scene = floorUnder({});
    scene::addPolygons(scene, "panel", 1, plateAbove(0.02));
    const Built built(std::move(scene));
    EXPECT_EQ(built.tree.shape(built.tree.patchNode(0, 0, false)).exposedCells, 0xffff);
    for (const NodeId id : built.tree.patches()) {
        EXPECT_FALSE(built.tree.shape(id).isCovered);
    }
}

}  // namespace
}  // namespace fluxwalk
