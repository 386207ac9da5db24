#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "core/reference/path_tracer.h"
#include "core/reference/random_sensors.h"
#include "core/scene/builders.h"

namespace fluxwalk {
namespace {

using reference::Estimate;
using reference::IrradianceTracer;

class ReferenceInParts : public testing::Test {
  protected:
    IrradianceTracer make(std::uint64_t seed = 5) const { return {scene_, rays_, executor_, sensors_, seed}; }

    scene::Scene scene_ = *scene::buildScene("cornell-box");
    base::Executor executor_{2};
    rays::RayScene rays_{scene_, executor_};
    std::vector<reference::ObjectSide> sides_{{0, false}, {2, false}, {3, false}};
    std::vector<scene::Sensor> sensors_ = reference::randomSensors(scene_, sides_, 40, 3);
};

}  // namespace

TEST_F(ReferenceInParts, addsUpToTheSameBits) {
    IrradianceTracer once = make();
    once.add(300);
    IrradianceTracer parts = make();
    parts.add(64);
    parts.add(192);
    parts.add(44);
    EXPECT_EQ(once.paths(), parts.paths());
    EXPECT_EQ(once.rays(), parts.rays());
    const std::vector<Estimate> a = once.irradiance();
    const std::vector<Estimate> b = parts.irradiance();
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i].luminance, b[i].luminance, 1e-12 * a[i].luminance);
        EXPECT_NEAR(a[i].luminanceError, b[i].luminanceError, 1e-9 * a[i].luminanceError);
    }
}

TEST_F(ReferenceInParts, keepsWhatWasDoneBeforeAStop) {
    IrradianceTracer tracer = make();
    std::atomic<int> asked = 0;
    tracer.add(64, [&] { return ++asked > 10; });
    std::size_t done = 0;
    for (const Estimate& e : tracer.irradiance()) {
        if (std::isfinite(e.luminanceError)) {
            ++done;
            EXPECT_GT(e.luminance, 0.0);
        } else {
            EXPECT_EQ(e.luminance, 0.0);
        }
    }
    EXPECT_GE(done, 1u);
    EXPECT_LE(done, 10u);
}

// The luminance's error is its own: channels vary together, so that it is more than they would give if they
// did not.
TEST_F(ReferenceInParts, saysHowSureItIs) {
    constexpr int kRuns = 24;
    std::vector<double> sums(sensors_.size());
    std::vector<double> squares(sensors_.size());
    double claimed = 0.0;
    for (int run = 0; run < kRuns; ++run) {
        IrradianceTracer tracer = make(100u + static_cast<std::uint64_t>(run));
        tracer.add(256);
        const std::vector<Estimate> found = tracer.irradiance();
        for (std::size_t i = 0; i < found.size(); ++i) {
            sums[i] += found[i].luminance;
            squares[i] += found[i].luminance * found[i].luminance;
            claimed += found[i].luminanceError * found[i].luminanceError;
        }
        const reference::NoiseCheck noise = tracer.checkNoise();
        // Under a block all is dark, for certain.
        EXPECT_GE(noise.count, sensors_.size() - 2);
        EXPECT_NEAR(noise.deviation, std::sqrt(2.0 / static_cast<double>(noise.count)), 1e-12);
        EXPECT_NEAR(noise.ratio, 1.0, 5.0 * noise.deviation);
    }
    double actual = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        actual += (squares[i] - sums[i] * sums[i] / kRuns) / (kRuns - 1);
    }
    EXPECT_NEAR(actual / (claimed / kRuns), 1.0, 0.2);
}

// What a path finds does not depend on its company: bundles of rays meet what single rays do.
TEST_F(ReferenceInParts, bundlesMeetWhatSingleRaysDo) {
    base::RandomStream random(8);
    std::vector<rays::Ray> rays;
    for (int i = 0; i < 150; ++i) {
        const scene::Sensor& s = sensors_[static_cast<std::size_t>(i) % sensors_.size()];
        rays.push_back(
            rays_.halfLine(s.position, s.normal, reference::cosineDirection(s.normal, random.next2())));
    }
    rays[70].tNear = -1.0f;
    std::vector<std::optional<rays::Hit>> hits(rays.size());
    rays_.closest(rays, hits);
    EXPECT_FALSE(hits[70]);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto alone = rays_.closest(rays[i]);
        ASSERT_EQ(alone.has_value(), hits[i].has_value()) << i;
        if (alone) {
            EXPECT_EQ(alone->object, hits[i]->object);
            EXPECT_EQ(alone->patch, hits[i]->patch);
            EXPECT_EQ(alone->back, hits[i]->back);
            EXPECT_NEAR(alone->t, hits[i]->t, 1e-5f * alone->t);
        }
    }
}

}  // namespace fluxwalk
