#include <gtest/gtest.h>

#include "core/surface/subdivision_surface.h"
#include "tests/support/curved_scenes.h"
#include "tests/surface/cages.h"
#include "tests/surface/curved_shapes.h"

// Surfaces that tell for less whether a region's normals lie within an angle must say what their bounds say.

namespace fluxwalk::surface {
namespace {

std::vector<std::pair<std::string, test::SurfacePtr>> surfaces() {
    std::vector<std::pair<std::string, test::SurfacePtr>> all;
    for (const test::CurvedShape& shape : test::curvedShapes()) {
        all.emplace_back(shape.name, shape.make(base::Mat4d(1.0), false));
        all.emplace_back("skew " + shape.name, shape.make(test::skewMap(true), true));
    }
    all.emplace_back("vase", std::make_shared<SubdivisionSurface>(test::closedVaseCage()));
    all.emplace_back("loop", std::make_shared<SubdivisionSurface>(test::octahedronCage()));
    return all;
}

// What post-refinement makes of elements: cut in one direction only.
Region halved(const Region& region) {
    Region half = region;
    constexpr double kPart = 0.5;
    half.corners[1] = glm::mix(region.corners[0], region.corners[1], kPart);
    half.corners[2] =
        region.cornerCount == 4 ? glm::mix(region.corners[3], region.corners[2], kPart) : region.corners[2];
    return half;
}

TEST(NormalsLieWithin, SaysWhatTheBoundsSay) {
    for (const auto& [name, surface] : surfaces()) {
        base::RandomStream random(7);
        unsigned within = 0;
        for (unsigned n = 0; n < 400; ++n) {
            const auto patch = static_cast<std::uint32_t>(random.next() * surface->patchCount());
            Path path = kRootPath;
            for (unsigned level = static_cast<unsigned>(random.next() * 6.0); level > 0; --level) {
                path = childPath(path, static_cast<unsigned>(4.0 * random.next()));
            }
            const Region whole = regionOf(*surface, patch, path);
            const Region region = n % 2 == 0 ? whole : halved(whole);
            const double halfAngle = surface->bounds(patch, region).normals.halfAngle;
            if (halfAngle >= 0.5 * base::kPi || halfAngle <= 0.0) {
                continue;
            }
            ++within;
            EXPECT_TRUE(surface->normalsLieWithin(patch, region, halfAngle)) << name << ' ' << n;
            EXPECT_TRUE(surface->normalsLieWithin(patch, region, 1.01 * halfAngle)) << name << ' ' << n;
            EXPECT_FALSE(surface->normalsLieWithin(patch, region, std::nextafter(halfAngle, 0.0)))
                << name << ' ' << n;
            EXPECT_FALSE(surface->normalsLieWithin(patch, region, 0.99 * halfAngle)) << name << ' ' << n;
        }
        // Flat ones have nothing to tell.
        const bool isFlat =
            name.find("disk") != std::string::npos || name.find("annulus") != std::string::npos;
        EXPECT_TRUE(isFlat || within > 100) << name << ' ' << within;
    }
}

}  // namespace
}  // namespace fluxwalk::surface
