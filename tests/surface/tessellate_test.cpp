#include "tests/support/tessellate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/surface/curved_shapes.h"

namespace fluxwalk {
namespace {

using base::Vec2d;
using base::Vec3d;
using test::Tessellation;

// Its own type, so that a failure names the shape.
class Tessellated : public testing::TestWithParam<test::CurvedShape> {};

// A point of the domain, triangle or square.
Vec2d randomPlace(const surface::Surface& surface, std::uint32_t patch, base::RandomStream& random) {
    Vec2d uv(random.next(), random.next());
    if (surface.domain(patch) == surface::PatchDomain::triangle && uv.x + uv.y > 1.0) {
        uv = 1.0 - uv;
    }
    return uv;
}

TEST_P(Tessellated, isCutEvenlyWithCornersOnTheSurface) {
    const test::SurfacePtr surface = GetParam().make(base::Mat4d(1.0), false);
    for (const std::uint32_t perSide : {1u, 2u, 5u}) {
        const Tessellation cut(*surface, perSide);
        std::size_t triangles = 0;
        for (std::uint32_t patch = 0; patch < surface->patchCount(); ++patch) {
            const bool isTriangle = surface->domain(patch) == surface::PatchDomain::triangle;
            triangles += (isTriangle ? 1u : 2u) * perSide * perSide;
            const double size = surface->bounds().diagonal();
            for (std::uint32_t j = 0; j <= perSide; ++j) {
                for (std::uint32_t i = 0; i <= (isTriangle ? perSide - j : perSide); ++i) {
                    const Vec2d uv = Vec2d(i, j) / static_cast<double>(perSide);
                    const Tessellation::Place place = cut.find(patch, uv);
                    const Vec3d there = cut.mesh()->evaluate(place.patch, place.uv).position;
                    EXPECT_LT(glm::distance(there, surface->evaluate(patch, uv).position), 1e-6 * size);
                }
            }
        }
        EXPECT_EQ(cut.mesh()->triangles().triangles.size(), triangles);
    }
}

// Between the corners the flat place is off by the rise of a chord, a quarter of it with half as long ones.
TEST_P(Tessellated, placesApproachTheSurfaceWithTheSquareOfTheCuts) {
    const test::SurfacePtr surface = GetParam().make(base::Mat4d(1.0), true);
    base::RandomStream random(17);
    const auto farthest = [&](std::uint32_t perSide) {
        const Tessellation cut(*surface, perSide);
        double largest = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const std::uint32_t patch = test::randomPatch(*surface, random);
            const Vec2d uv = randomPlace(*surface, patch, random);
            const Tessellation::Place place = cut.find(patch, uv);
            const surface::SurfacePoint flat = cut.mesh()->evaluate(place.patch, place.uv);
            const surface::SurfacePoint exact = surface->evaluate(patch, uv);
            largest = std::max(largest, glm::distance(flat.position, exact.position));
            if (perSide == 32) {
                EXPECT_GT(glm::dot(flat.normal, exact.normal), .9);
            }
        }
        return largest;
    };
    const double coarse = farthest(16);
    const double fine = farthest(32);
    const double rounding = 1e-6 * surface->bounds().diagonal();
    EXPECT_LT(fine, .3 * coarse + rounding);
    EXPECT_LT(coarse, .02 * surface->bounds().diagonal());
}

// Patches whose side is one point would give triangles without area.
bool hasPoles(const surface::Surface& surface) {
    const surface::Region whole = surface::wholePatch(surface.domain(0));
    for (std::uint32_t i = 0; i < whole.cornerCount; ++i) {
        const Vec3d here = surface.evaluate(0, whole.corners[i]).position;
        const Vec3d next = surface.evaluate(0, whole.corners[(i + 1) % whole.cornerCount]).position;
        if (glm::distance(here, next) < 1e-9) {
            return true;
        }
    }
    return false;
}

std::vector<test::CurvedShape> shapesWithoutPoles() {
    std::vector<test::CurvedShape> shapes = test::curvedShapes();
    std::erase_if(shapes, [](const test::CurvedShape& shape) {
        return hasPoles(*shape.make(base::Mat4d(1.0), false));
    });
    return shapes;
}

INSTANTIATE_TEST_SUITE_P(Shapes, Tessellated, testing::ValuesIn(shapesWithoutPoles()),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace fluxwalk
