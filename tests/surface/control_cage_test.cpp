#include "core/surface/control_cage.h"

#include <gtest/gtest.h>

#include "tests/surface/cages.h"

namespace fluxwalk {

using surface::ControlCage;

TEST(ControlCage, defectsAreNamed) {
    using surface::findDefect;
    const auto defectOf = [](const auto& damage) {
        ControlCage cage = test::cubeCage();
        damage(cage);
        return findDefect(cage).value_or("none");
    };
    EXPECT_EQ(defectOf([](ControlCage&) {}), "none");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.faceSizes.clear(); }), "it has no faces");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.corners[5] = 8; }), "a face names vertex 8 of 8");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.faceSizes[2] = 2; }), "face 2 has fewer than three corners");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.corners.pop_back(); }),
              "its faces have 24 corners, but 23 are given");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.positions[3].y = NAN; }), "vertex 3 is not finite");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.corners[1] = c.corners[0]; }), "face 0 uses vertex 0 twice");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.positions.emplace_back(5, 5, 5); }),
              "vertex 8 belongs to no face");
    EXPECT_EQ(defectOf([](ControlCage& c) { std::swap(c.corners[1], c.corners[3]); }),
              "faces 0 and 2 on the two sides of the edge between vertices 0 and 1 face opposite ways");
    EXPECT_EQ(defectOf([](ControlCage& c) {
                  c.positions.emplace_back(3, 3, 3);
                  c.positions.emplace_back(3, 0, 3);
                  test::addFace(c, {0, 1, 8, 9});
              }),
              "the edge between vertices 0 and 1 belongs to more than two faces");
    EXPECT_EQ(defectOf([](ControlCage& c) {
                  c.positions.emplace_back(-3, -3, -3);
                  c.positions.emplace_back(-3, -4, -3);
                  test::addFace(c, {0, 8, 9});
              }),
              "at vertex 0 faces meet that share no edge there");
    EXPECT_EQ(defectOf([](ControlCage& c) {
                  for (const std::uint32_t v : {0u, 1u, 2u, 3u}) {
                      c.positions[v] = {c.positions[v].x, 0, 0};
                  }
              }),
              "face 0 has no area");
    EXPECT_EQ(defectOf([](ControlCage& c) {
                  c.creases = {{0, 7, 1.0f}};
              }),
              "a crease runs between vertices 0 and 7, where there is no edge");
    EXPECT_EQ(defectOf([](ControlCage& c) {
                  c.creases = {{0, 1, NAN}};
              }),
              "the sharpness of the edge between vertices 0 and 1 is not a number from 0 on");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.texcoords[0].resize(3); }),
              "it has 3 texture coordinates for 24 corners");
    EXPECT_EQ(defectOf([](ControlCage& c) { c.scheme = surface::SubdivisionScheme::loop; }),
              "face 0 is no triangle, as the scheme of Loop needs");
}

}  // namespace fluxwalk
