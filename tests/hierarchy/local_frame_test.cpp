#include "core/hierarchy/local_frame.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/region.h"

namespace fluxwalk {
namespace {

using base::Vec2;
using base::Vec2d;
using hierarchy::LocalFrame;
using hierarchy::localFrame;

// Local coordinates of the point (s, t) of the unit square mapped to the region.
Vec2d localOf(std::uint32_t corners, const Vec2d& st) {
    if (corners == 4) {
        return 2.0 * st - 1.0;
    }
    const double root = std::sqrt(st.x);
    return Vec2d(1.0 - root, st.y * root) - Vec2d(1.0 / 3.0);
}

// Mean over an element by the midpoint rule.
double meanOver(std::uint32_t corners, const std::function<double(const Vec2d&)>& f) {
    constexpr int kCount = 400;
    double sum = 0.0;
    for (int j = 0; j < kCount; ++j) {
        for (int i = 0; i < kCount; ++i) {
            sum += f(localOf(corners, {(i + 0.5) / kCount, (j + 0.5) / kCount}));
        }
    }
    return sum / (kCount * kCount);
}

// A unit square as one patch, or half of it.
surface::PolygonMesh patchOf(std::uint32_t corners) {
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}};
    if (corners == 4) {
        soup.triangles.push_back({0, 2, 3});
    }
    return surface::PolygonMesh(std::move(soup));
}

// Inverse of the local coordinates: parameters of a region.
Vec2d parameterAt(const surface::Region& region, const Vec2d& local) {
    const auto& c = region.corners;
    if (region.cornerCount == 3) {
        const Vec2d uv = local + Vec2d(1.0 / 3.0);
        return (1.0 - uv.x - uv.y) * c[0] + uv.x * c[1] + uv.y * c[2];
    }
    const Vec2d st = 0.5 * (local + Vec2d(1.0));
    return (1.0 - st.y) * ((1.0 - st.x) * c[0] + st.x * c[1]) + st.y * ((1.0 - st.x) * c[3] + st.x * c[2]);
}

class LocalFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(LocalFrames, momentsAreMeansOverTheElement) {
    const std::uint32_t n = GetParam();
    const LocalFrame& frame = localFrame(n);
    EXPECT_NEAR(meanOver(n, [](const Vec2d& p) { return p.x; }), 0.0, 1e-5);
    EXPECT_NEAR(meanOver(n, [](const Vec2d& p) { return p.y; }), 0.0, 1e-5);
    EXPECT_NEAR(meanOver(n, [](const Vec2d& p) { return p.x * p.x; }), static_cast<double>(frame.xx), 1e-5);
    EXPECT_NEAR(meanOver(n, [](const Vec2d& p) { return p.x * p.y; }), static_cast<double>(frame.xy), 1e-5);
    EXPECT_NEAR(meanOver(n, [](const Vec2d& p) { return p.y * p.y; }), static_cast<double>(frame.yy), 1e-5);
    const Vec2 g(0.7f, -0.2f);
    const Vec2 h(-0.4f, 0.9f);
    EXPECT_NEAR(meanOver(n, [&](const Vec2d& p) { return glm::dot(Vec2d(g), p) * glm::dot(Vec2d(h), p); }),
                static_cast<double>(frame.product(g, h)), 1e-5);
}

struct Children {
    std::uint32_t cornerCount;
    surface::Split split;
};

class ChildFrames : public testing::TestWithParam<Children> {};

// A point of a child has the same parameters whether named by the child's coordinates or the whole's.
TEST_P(ChildFrames, childrenLieWhereRegionsAreSplit) {
    const auto [n, split] = GetParam();
    const hierarchy::ChildFrame& frame = hierarchy::childFrame(n, split);
    const surface::PolygonMesh mesh = patchOf(n);
    const surface::Region whole = surface::wholePatch(mesh.domain(0));
    ASSERT_EQ(whole.cornerCount, n);
    base::RandomStream random(4);
    for (unsigned c = 0; c < 4; ++c) {
        const surface::Region part = surface::childRegion(mesh, 0, whole, split, c);
        for (int i = 0; i < 20; ++i) {
            const Vec2d local = localOf(n, random.next2());
            const Vec2d inWhole = Vec2d(frame.middle(c)) + Vec2d(frame.scale(c)) * local;
            EXPECT_LT(glm::distance(parameterAt(part, local), parameterAt(whole, inWhole)), 1e-7) << c;
        }
    }
}

// Push: each child takes the parent's value at its middle and the scaled slope. Pull: mean, and slope by
// least squares over the children. A linear function survives both.
TEST_P(ChildFrames, linearFunctionsSurvivePushAndPull) {
    const auto [n, split] = GetParam();
    const LocalFrame& frame = localFrame(n);
    const hierarchy::ChildFrame& children = hierarchy::childFrame(n, split);
    const double mean = 3.0;
    const Vec2 slope(0.8f, -0.5f);
    double pulledMean = 0.0;
    Vec2d moment(0.0);
    for (unsigned c = 0; c < 4; ++c) {
        const Vec2 middle = children.middle(c);
        const float value = static_cast<float>(mean) + glm::dot(slope, middle);
        const Vec2 childSlope = children.scale(c) * slope;
        pulledMean += 0.25 * static_cast<double>(value);
        // Mean over the child of f(x) x, with x = middle + scale y in the whole's coordinates.
        const Vec2 scale = children.scale(c);
        const Vec2 spread(frame.xx * childSlope.x + frame.xy * childSlope.y,
                          frame.xy * childSlope.x + frame.yy * childSlope.y);
        moment += 0.25 * Vec2d(value * middle + scale * spread);
    }
    EXPECT_NEAR(pulledMean, mean, 1e-6);
    const double xx = static_cast<double>(frame.xx);
    const double xy = static_cast<double>(frame.xy);
    const double yy = static_cast<double>(frame.yy);
    const double det = xx * yy - xy * xy;
    EXPECT_NEAR((yy * moment.x - xy * moment.y) / det, static_cast<double>(slope.x), 1e-5);
    EXPECT_NEAR((xx * moment.y - xy * moment.x) / det, static_cast<double>(slope.y), 1e-5);
}

// The corners of a back side are the region's in reverse order.
TEST_P(LocalFrames, mirroredGradientsDescribeTheSameFunction) {
    const std::uint32_t n = GetParam();
    const Vec2 g(0.6f, -1.1f);
    const Vec2 mirrored = hierarchy::mirrorGradient(n, g);
    EXPECT_EQ(hierarchy::mirrorGradient(n, mirrored), g) << "its own inverse";
    surface::Region region =
        surface::wholePatch(n == 3 ? surface::PatchDomain::triangle : surface::PatchDomain::quad);
    surface::Region back = region;
    for (std::uint32_t i = 0; i < n; ++i) {
        back.corners[i] = region.corners[n - 1 - i];
    }
    base::RandomStream random(5);
    for (int i = 0; i < 20; ++i) {
        const Vec2d inBack = localOf(n, random.next2());
        const Vec2d uv = parameterAt(back, inBack);
        const Vec2d inRegion = n == 3 ? uv - Vec2d(1.0 / 3.0) : 2.0 * uv - 1.0;
        EXPECT_NEAR(glm::dot(Vec2d(g), inBack), glm::dot(Vec2d(mirrored), inRegion), 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(TrianglesAndQuads, LocalFrames, testing::Values(3u, 4u));
INSTANTIATE_TEST_SUITE_P(AllSplits, ChildFrames,
                         testing::Values(Children{3, surface::Split::quarters},
                                         Children{4, surface::Split::quarters},
                                         Children{4, surface::Split::stripsAlongU},
                                         Children{4, surface::Split::stripsAlongV}));

}  // namespace
}  // namespace fluxwalk
