#include "core/image/intervals.h"

#include <gtest/gtest.h>

#include "core/image/sensors.h"
#include "core/reference/agreement.h"
#include "core/scene/builders.h"
#include "core/solve/probes.h"
#include "tests/image/measuring.h"
#include "tests/support/curved_room.h"

// Scenes on which the weights of the intervals' parts were not fixed.
namespace fluxwalk {
namespace {

std::vector<scene::Sensor> drawSensors(const solve::Solver& solver, std::size_t count) {
    std::vector<scene::Sensor> sensors;
    for (const solve::Probe& p : solve::drawProbes(solver.problem(), count, 41)) {
        sensors.push_back({p.position, p.normal});
    }
    return sensors;
}

reference::Agreement compareIntervals(const solve::Solver& solver, std::size_t count, std::uint64_t paths) {
    const solve::Problem& problem = solver.problem();
    std::vector<scene::Sensor> sensors;
    std::vector<reference::Claim> claims;
    const std::vector<scene::Sensor> drawn = drawSensors(solver, count);
    const std::vector<image::Measurement> measured = image::measureIntervals(solver, drawn);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (measured[i].place != image::SensorPlace::solid) {
            sensors.push_back(drawn[i]);
            claims.push_back({measured[i].illuminance, measured[i].low, measured[i].high});
        }
    }
    const reference::PathResult traced =
        reference::traceIrradiance(*problem.scene, problem.rays, problem.executor, sensors, {17, paths});
    return reference::compare(claims, traced.irradiance);
}

}  // namespace

TEST(Intervals, holdTheReferenceAmongCurvedObjects) {
    const auto solver = test::solveScene(test::buildCurvedRoom(), 0.02);
    const reference::Agreement a = compareIntervals(*solver, 300, 8192);
    EXPECT_LE(a.noise, 0.02) << "so that a wrong interval could be told";
    EXPECT_GE(100 * a.held, 99 * a.count);
    EXPECT_LE(a.medianWidth, 0.10);
    EXPECT_GE(a.medianWidth, 0.01) << "nobody knows that much";
}

TEST(Intervals, holdTheClosedFormOfAFurnace) {
    const auto solver = test::solveScene(scene::buildFurnace(0.5f, true), 0.01);
    std::size_t held = 0;
    const std::vector<image::Measurement> measured =
        image::measureIntervals(*solver, drawSensors(*solver, 200));
    for (const image::Measurement& m : measured) {
        held += m.low <= 2.0 && 2.0 <= m.high ? 1u : 0u;
        EXPECT_LE(m.low, m.illuminance);
        EXPECT_GE(m.high, m.illuminance);
    }
    EXPECT_GE(100 * held, 99 * measured.size());
}

TEST(Intervals, strictOnesAreWider) {
    const auto solver = test::solveScene(scene::buildTwoRooms(), 0.05);
    const std::vector<scene::Sensor> sensors = drawSensors(*solver, 100);
    const std::vector<image::Measurement> likely = image::measureIntervals(*solver, sensors);
    const std::vector<image::Measurement> strict =
        image::measureIntervals(*solver, sensors, image::IntervalKind::strict);
    const std::vector<base::Rgb> plain = image::measure(*solver, sensors);
    std::size_t wider = 0;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        EXPECT_EQ(likely[i].irradiance, plain[i]);
        EXPECT_EQ(strict[i].irradiance, plain[i]);
        EXPECT_LE(strict[i].low, strict[i].illuminance);
        EXPECT_GE(strict[i].high, strict[i].illuminance);
        wider += strict[i].high - strict[i].low >= likely[i].high - likely[i].low ? 1u : 0u;
    }
    EXPECT_GE(wider, 90u);
}

}  // namespace fluxwalk
