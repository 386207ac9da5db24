#include "core/transport/element_part.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/transport/element_points.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3d;
using surface::childPath;
using surface::kRootPath;
using transport::PartExposure;

// Quads, triangles, spheres and ellipsoids, inside and outside, fronts and backs, split once.
const test::Built& zoo() {
    static test::Built built(test::randomScene(22, 2, 6, 6));
    if (built.tree.leafCount() == built.tree.patches().size()) {
        built.split(1);
    }
    return built;
}

template <class Check>
void forElements(const Check& check) {
    for (std::uint32_t n = 0; n < zoo().tree.nodeCount(); ++n) {
        if (zoo().tree.kind(NodeId{n}) == hierarchy::NodeKind::element) {
            check(NodeId{n}, zoo().tree.shape(NodeId{n}));
        }
    }
}

transport::ElementPoints partOf(NodeId id, surface::Path part) {
    return transport::makeRegionPoints(zoo().tree, id, transport::partRegion(zoo().tree.region(id), part));
}

TEST(ElementPart, FourQuartersMakeTheWhole) {
    int curved = 0;
    forElements([&](NodeId id, const hierarchy::Shape& shape) {
        double area = 0.0;
        double cells = 0.0;
        base::Vec2 middle(0.0f);
        for (unsigned k = 0; k < 4; ++k) {
            const surface::Path part = childPath(kRootPath, k);
            area += partOf(id, part).area;
            middle += 0.25f * transport::partMiddle(shape.cornerCount, part);
            for (unsigned j = 0; j < 4; ++j) {
                cells += partOf(id, childPath(part, j)).area;
            }
        }
        const auto whole = static_cast<double>(shape.area);
        // Cubature of a curved part errs by the fourth power of its size.
        const double tolerance = shape.isPlanar ? 1e-6 : 0.02;
        EXPECT_NEAR(area, whole, tolerance * whole);
        EXPECT_NEAR(cells, whole, (shape.isPlanar ? 1e-6 : 0.002) * whole);
        EXPECT_NEAR(middle.x, 0.0f, 1e-6f);
        EXPECT_NEAR(middle.y, 0.0f, 1e-6f);
        curved += shape.isPlanar ? 0 : 1;
    });
    EXPECT_GT(curved, 20);
}

TEST(ElementPart, FacesTheSideOfItsElement) {
    forElements([&](NodeId id, const hierarchy::Shape& shape) {
        const transport::ElementPoints whole = transport::makeElementPoints(zoo().tree, id);
        const transport::ElementPoints part = partOf(id, childPath(childPath(kRootPath, 2), 1));
        const Vec3d normal(part.normal.x[0], part.normal.y[0], part.normal.z[0]);
        const Vec3d turned = glm::cross(part.corners[1] - part.corners[0], part.corners[2] - part.corners[1]);
        EXPECT_GT(glm::dot(turned, normal), 0.0);
        EXPECT_GE(glm::dot(normal, Vec3d(shape.axis)), std::cos(static_cast<double>(shape.halfAngle)) - 1e-5);
        EXPECT_LE(glm::distance(part.center, whole.center) + part.radius, 1.001 * whole.radius + 1e-9);
        // Points of it lie on it, and their measure adds up to its area.
        double sum = 0.0;
        constexpr int kSide = 8;
        const surface::Region region =
            transport::partRegion(zoo().tree.region(id), childPath(childPath(kRootPath, 2), 1));
        for (int i = 0; i < kSide * kSide; ++i) {
            const transport::SurfaceSample p = transport::sampleRegion(
                zoo().tree, id, region, {(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide});
            EXPECT_GE(glm::dot(p.normal, Vec3d(shape.axis)),
                      std::cos(static_cast<double>(shape.halfAngle)) - 1e-5);
            EXPECT_LE(glm::distance(p.position, part.center), 1.05 * part.radius + 1e-9);
            sum += p.measure / (kSide * kSide);
        }
        EXPECT_NEAR(sum, part.area, 0.01 * part.area);
    });
}

// Quarters of quarters of a quad are the cells of its mask.
TEST(ElementPart, CellsAreTheMasks) {
    hierarchy::Shape shape;
    shape.cornerCount = 4;
    for (unsigned cell = 0; cell < 16; ++cell) {
        shape.exposedCells = static_cast<std::uint16_t>(1u << cell);
        int exposed = 0;
        for (unsigned k = 0; k < 4; ++k) {
            const surface::Path part = childPath(kRootPath, k);
            bool any = false;
            for (unsigned j = 0; j < 4; ++j) {
                const surface::Path quarter = childPath(part, j);
                if (transport::partExposure(shape, quarter) == PartExposure::none) {
                    continue;
                }
                EXPECT_EQ(transport::partExposure(shape, quarter), PartExposure::all);
                any = true;
                ++exposed;
                // Coordinates run over [-1, 1].
                const base::Vec2 middle = transport::partMiddle(4, quarter);
                const auto at = [](float x) { return static_cast<unsigned>(2.0f * (x + 1.0f)); };
                EXPECT_EQ(4 * at(middle.y) + at(middle.x), cell);
            }
            EXPECT_EQ(transport::partExposure(shape, part), any ? PartExposure::some : PartExposure::none);
        }
        EXPECT_EQ(exposed, 1);
    }
    shape.exposedCells = 0xffff;
    EXPECT_EQ(transport::partExposure(shape, childPath(kRootPath, 1)), PartExposure::all);
    shape.cornerCount = 3;
    shape.exposedCells = 0x00ff;
    EXPECT_EQ(transport::partExposure(shape, childPath(kRootPath, 1)), PartExposure::some);
}

}  // namespace
}  // namespace fluxwalk
