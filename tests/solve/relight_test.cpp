#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/image/sensors.h"
#include "core/scene/builders.h"
#include "core/scene/lighting.h"
#include "core/solve/checkpoint.h"
#include "core/solve/probes.h"
#include "core/solve/solver.h"
#include "tests/solve/plain_sweeps.h"

// Lights that are turned: at once as full sweeps over the links that stand, and in the end as if solved so.

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using scene::Lighting;
using solve::Options;
using solve::Outcome;
using solve::Solver;
using ScenePtr = std::shared_ptr<const scene::Scene>;

/// The Cornell box with a lamp, a point light in front of the blocks, a spot and a directional light that
/// comes in through the open side.
ScenePtr makeBox() {
    scene::Scene scene = *scene::buildScene("cornell-box");
    const base::Box box = scene.bounds();
    const Vec3d size = box.upper - box.lower;
    const Vec3d middle = box.center();
    scene::Light point;
    point.name = "point";
    point.intensity = Rgb(10.0f, 20.0f, 30.0f);
    point.position = middle + Vec3d(-0.3, 0.3, 0.35) * size;
    scene.lights.push_back(point);
    scene::Light spot;
    spot.name = "spot";
    spot.kind = scene::LightKind::spot;
    spot.intensity = Rgb(60.0f, 50.0f, 10.0f);
    spot.position = middle + Vec3d(0.3, 0.3, 0.35) * size;
    spot.direction = glm::normalize(Vec3d(-0.3, -0.7, -0.5));
    scene.lights.push_back(spot);
    scene::Light sun;
    sun.name = "sun";
    sun.kind = scene::LightKind::directional;
    sun.intensity = Rgb(40.0f, 35.0f, 30.0f);
    sun.direction = glm::normalize(Vec3d(0.2, -0.4, -1.0));
    scene.lights.push_back(sun);
    return std::make_shared<const scene::Scene>(std::move(scene));
}

Options withError(double error) {
    Options options;
    options.error = error;
    options.errorOf = solve::ErrorOf::gathered;
    return options;
}

/// Lamp dimmed, point off, spot turned green, sun brighter.
Lighting turned(const scene::Scene& scene) {
    Lighting lighting;
    for (const scene::LightSource& source : scene::listLightSources(scene)) {
        Rgb factor(0.25f);
        if (source.kind == scene::LightSource::Kind::light) {
            factor = source.name == "point"  ? Rgb(0.0f)
                     : source.name == "spot" ? Rgb(0.2f, 3.0f, 0.1f)
                                             : Rgb(2.0f);
        }
        scene::setFactor(lighting, source, factor);
    }
    return lighting;
}

Options with(Options options, const Lighting& lighting) {
    options.lighting = lighting;
    return options;
}

/// Turns the lights of a solver at rest and holds it as soon as the light followed them, over the links that
/// stand.
void follow(Solver& solver, const Lighting& lighting) {
    solver.setOptions(with(solver.options(), lighting));
    // Shown twice: at once, and converged.
    int shown = 0;
    solve::Callbacks callbacks;
    callbacks.publish = [&](const std::shared_ptr<const solve::Snapshot>& snapshot) {
        shown += snapshot->lighting == lighting ? 1 : 0;
    };
    callbacks.shouldStop = [&] { return shown >= 2; };
    EXPECT_EQ(solver.solve(callbacks), Outcome::stopped);
}

double meanOf(const Solver& solver) {
    return solver.statistics().meanIrradiance;
}

/// Power that lands elsewhere, as a part of all of that.
double differenceOf(const Solver& one, const Solver& other) {
    const hierarchy::Hierarchy& h = one.problem().hierarchy;
    double wrong = 0.0;
    double all = 0.0;
    for (const NodeId id : test::leavesOf(h)) {
        const auto area = static_cast<double>(h.shape(id).exposedArea());
        const Vec3d a(h.light(id).irradiance);
        const Vec3d b(other.problem().hierarchy.light(id).irradiance);
        wrong += area * glm::dot(glm::abs(a - b), Vec3d(1.0));
        all += area * glm::dot(b, Vec3d(1.0));
    }
    return wrong / all;
}

/// Irradiance at points drawn by area, gathered.
std::vector<Rgb> gathered(const Solver& solver) {
    const std::vector<solve::Probe> probes = solve::drawProbes(solver.problem(), 400, 77);
    return solve::gatherProbes(solver.problem(), probes);
}

TEST(Relight, followsAtOnceOverTheLinksThatStand) {
    const ScenePtr box = makeBox();
    Solver solver(box, withError(0.05), 2);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const std::uint64_t links = solver.statistics().counters.links;
    const std::size_t nodes = solver.problem().hierarchy.nodeCount();
    const std::uint64_t rays = solver.statistics().counters.rays;
    follow(solver, turned(*box));
    EXPECT_EQ(solver.problem().links.links.size(), links);
    EXPECT_EQ(solver.problem().hierarchy.nodeCount(), nodes);
    EXPECT_EQ(solver.statistics().counters.rays, rays);
    // Sweeps that know nothing of the light before: all that it left must be gone.
    Solver dark(box, withError(0.05), 2);
    ASSERT_EQ(dark.solve({}), Outcome::reachedError);
    Lighting off = turned(*box);
    for (const scene::LightSource& source : scene::listLightSources(*box)) {
        scene::setFactor(off, source, Rgb(0.0f));
    }
    follow(dark, off);
    follow(dark, turned(*box));
    EXPECT_LT(differenceOf(solver, dark), 3e-6);
    EXPECT_LT(solver.statistics().residual, 1e-6);
}

TEST(Relight, convergesToPlainSweepsOfTheTurnedLamp) {
    Options options;
    options.clusterLinks = solve::ClusterLinks::off;  // the plain sweeps know elements only
    const auto problem = test::makeProblem(*scene::buildScene("cornell-box-unit"), options);
    test::refine(*problem, 1e-4);
    test::converge(*problem, 1e-3);
    test::refine(*problem, 5e-6);
    for (hierarchy::Link& link : problem->links.links) {
        link.gradientA = link.gradientB = {};  // constant ends, as theirs are
    }
    test::converge(*problem);
    const std::vector<double> before = test::PlainSweeps(*problem).radiosities();
    Lighting lighting;
    lighting.materials.assign(problem->scene->materials.size(), Rgb(0.3f));
    problem->hierarchy.relight(lighting, problem->executor);
    test::converge(*problem);
    const test::PlainSweeps plain(*problem);
    EXPECT_GT(plain.radiosities().size(), 200u);
    EXPECT_GT(plain.errorOf(before, plain.solve()), 0.5);
    EXPECT_LT(plain.errorOf(plain.radiosities(), plain.solve()), 1e-6);
}

TEST(Relight, endsAsAFreshSolveWithThoseLights) {
    const ScenePtr box = makeBox();
    constexpr double kError = 0.03;
    Solver relit(box, withError(kError), 2);
    ASSERT_EQ(relit.solve({}), Outcome::reachedError);
    relit.setOptions(with(withError(kError), turned(*box)));
    ASSERT_EQ(relit.solve({}), Outcome::reachedError);
    EXPECT_GE(relit.statistics().estimatedError, 0.0);
    EXPECT_LE(relit.statistics().estimatedError, kError);
    Solver fresh(box, with(withError(kError), turned(*box)), 2);
    ASSERT_EQ(fresh.solve({}), Outcome::reachedError);
    EXPECT_LT(solve::relativeRmsOffLamps(gathered(relit), gathered(fresh)), kError);
    // And as a scene that was made so.
    Solver made(scene::relightScene(box, turned(*box)), withError(kError), 2);
    ASSERT_EQ(made.solve({}), Outcome::reachedError);
    EXPECT_LT(solve::relativeRmsOffLamps(gathered(relit), gathered(made)), kError);
    const solve::Audit& audit = relit.statistics().audit;
    EXPECT_LT(audit.relativeDefect(), made.statistics().audit.relativeDefect() + 0.01);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(audit.emitted[c], made.statistics().audit.emitted[c], 0.01 * audit.emitted[c]);
    }
}

TEST(Relight, offAndOnAgainGivesTheFirstSolutionBack) {
    const ScenePtr box = makeBox();
    Solver solver(box, withError(0.05), 2);
    Solver kept(box, withError(0.05), 2);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    ASSERT_EQ(kept.solve({}), Outcome::reachedError);
    Lighting off;
    off.lights = {Rgb(0.0f), Rgb(1.0f), Rgb(1.0f)};
    follow(solver, off);
    EXPECT_GT(differenceOf(solver, kept), 0.01);
    follow(solver, {});
    EXPECT_LT(differenceOf(solver, kept), 3e-6);
    // Also where refinement went on in between.
    solver.setOptions(with(withError(0.05), off));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    solver.setOptions(withError(0.05));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_LT(solve::relativeRmsOffLamps(gathered(solver), gathered(kept)), 0.05);
}

TEST(Relight, dimmedLightIsTheSameSolutionDimmed) {
    // A power of two, so that nothing is rounded.
    const ScenePtr box = makeBox();
    Solver solver(box, withError(0.05), 2);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const double mean = meanOf(solver);
    const double threshold = solver.statistics().threshold;
    Lighting dimmed;
    for (const scene::LightSource& source : scene::listLightSources(*box)) {
        scene::setFactor(dimmed, source, Rgb(0.5f));
    }
    const std::uint64_t links = solver.statistics().counters.links;
    follow(solver, dimmed);
    EXPECT_NEAR(meanOf(solver), 0.5 * mean, 1e-5 * mean);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_NEAR(solver.statistics().threshold, 0.5 * threshold, 1e-12 * threshold);
    // Links follow the light that is really there, which is a little more than in their first refinement.
    EXPECT_NEAR(static_cast<double>(solver.statistics().counters.links), static_cast<double>(links),
                0.1 * static_cast<double>(links));
}

TEST(Relight, allOffIsDarkAndLightComesBack) {
    const ScenePtr box = makeBox();
    Lighting off;
    for (const scene::LightSource& source : scene::listLightSources(*box)) {
        scene::setFactor(off, source, Rgb(0.0f));
    }
    Solver first(box, withError(0.1), 2);
    ASSERT_EQ(first.solve({}), Outcome::reachedError);
    const double mean = meanOf(first);
    first.setOptions(with(withError(0.1), off));
    EXPECT_EQ(first.solve({}), Outcome::reachedError);
    EXPECT_EQ(meanOf(first), 0.0);
    EXPECT_EQ(first.statistics().estimatedError, 0.0);
    EXPECT_EQ(first.statistics().residual, 0.0);
    first.setOptions(withError(0.1));
    EXPECT_EQ(first.solve({}), Outcome::reachedError);
    EXPECT_NEAR(meanOf(first), mean, 0.05 * mean);
    // Dark from the start: nothing is refined until there is light.
    Solver second(box, with(withError(0.1), off), 2);
    EXPECT_EQ(second.solve({}), Outcome::reachedError);
    EXPECT_EQ(meanOf(second), 0.0);
    second.setOptions(withError(0.1));
    EXPECT_EQ(second.solve({}), Outcome::reachedError);
    EXPECT_NEAR(meanOf(second), mean, 1e-5 * mean);
}

TEST(Relight, reachesARunningSolveAndShowsItselfFirst) {
    const ScenePtr box = makeBox();
    Solver solver(box, withError(0.02), 2);
    int asked = 0;
    bool isTurned = false;
    std::vector<std::uint64_t> linksSeen;
    bool isRight = true;
    solve::Callbacks callbacks;
    callbacks.newOptions = [&]() -> std::optional<Options> {
        if (++asked == 25) {
            isTurned = true;
            return with(withError(0.02), turned(*box));
        }
        return std::nullopt;
    };
    callbacks.publish = [&](const std::shared_ptr<const solve::Snapshot>& snapshot) {
        isRight = isRight && (isTurned || snapshot->lighting.isNeutral());
        if (snapshot->lighting == turned(*box)) {
            linksSeen.push_back(snapshot->statistics.counters.links);
        }
    };
    ASSERT_EQ(solver.solve(callbacks), Outcome::reachedError);
    EXPECT_TRUE(isTurned);
    EXPECT_TRUE(isRight);
    // Two of them before anything is refined: at once and converged.
    ASSERT_GE(linksSeen.size(), 3u);
    EXPECT_EQ(linksSeen[0], linksSeen[1]);
    Solver fresh(box, with(withError(0.02), turned(*box)), 2);
    ASSERT_EQ(fresh.solve({}), Outcome::reachedError);
    EXPECT_LT(solve::relativeRmsOffLamps(gathered(solver), gathered(fresh)), 0.02);
}

TEST(Relight, isTheSameForAnyNumberOfThreads) {
    const ScenePtr box = makeBox();
    Solver one(box, withError(0.1), 1);
    Solver two(box, withError(0.1), 3);
    for (Solver* solver : {&one, &two}) {
        solver->solve({});
        solver->setOptions(with(withError(0.1), turned(*box)));
        solver->solve({});
    }
    ASSERT_EQ(one.problem().hierarchy.nodeCount(), two.problem().hierarchy.nodeCount());
    EXPECT_EQ(differenceOf(one, two), 0.0);
}

TEST(Relight, staysInACheckpoint) {
    const ScenePtr box = makeBox();
    Solver solver(box, withError(0.1), 2);
    solver.solve({});
    solver.setOptions(with(withError(0.1), turned(*box)));
    // Held in each stage: while it follows, while it refines, at the end.
    for (const int allowed : {1, 6, 1000000}) {
        Solver whole(box, withError(0.1), 2);
        whole.solve({});
        whole.setOptions(with(withError(0.1), turned(*box)));
        std::optional<base::NamedArrays> kept;
        solve::Callbacks callbacks;
        int asked = 0;
        callbacks.resumable = [&](solve::Moment) {
            if (asked++ <= allowed) {
                kept = whole.checkpoint();
            }
        };
        whole.solve(callbacks);
        ASSERT_TRUE(kept);
        const Options stored = solve::storedOptions(*kept, withError(0.1), "kept");
        EXPECT_EQ(stored.lighting, turned(*box));
        Solver resumed(box, stored, 2);
        resumed.restore(*kept, "kept");
        ASSERT_EQ(resumed.solve({}), Outcome::reachedError);
        ASSERT_EQ(resumed.problem().hierarchy.nodeCount(), whole.problem().hierarchy.nodeCount());
        EXPECT_EQ(differenceOf(resumed, whole), 0.0) << allowed;
        // Other lights are turned from there.
        Solver other(box, withError(0.1), 2);
        other.restore(*kept, "kept");
        ASSERT_EQ(other.solve({}), Outcome::reachedError);
        Solver plain(box, withError(0.1), 2);
        plain.solve({});
        EXPECT_LT(solve::relativeRmsOffLamps(gathered(other), gathered(plain)), 0.1);
    }
}

TEST(Relight, badLightsInACheckpointAreRefused) {
    const ScenePtr box = makeBox();
    Solver solver(box, withError(0.3), 2);
    std::optional<base::NamedArrays> kept;
    solve::Callbacks callbacks;
    callbacks.resumable = [&](solve::Moment) { kept = solver.checkpoint(); };
    solver.solve(callbacks);
    ASSERT_TRUE(kept);
    const std::vector<std::vector<float>> bad{{-1.0f, 1.0f, 1.0f}, {NAN, 1.0f, 1.0f}, {1e9f, 1.0f, 1.0f}};
    for (const std::vector<float>& values : bad) {
        base::NamedArrays altered = *kept;
        for (base::NamedArray& array : altered.arrays) {
            if (array.name == "lighting/sky") {
                array.values = values;
            }
        }
        Solver other(box, withError(0.3), 2);
        EXPECT_THROW(other.restore(altered, "altered"), base::FileError);
    }
    base::NamedArrays longer = *kept;
    for (base::NamedArray& array : longer.arrays) {
        if (array.name == "lighting/lights") {
            array.values = std::vector<float>(3 * 50, 1.0f);
        }
    }
    Solver other(box, withError(0.3), 2);
    EXPECT_THROW(other.restore(longer, "longer"), base::FileError);
}

TEST(Relight, sensorsSeeTheTurnedLights) {
    // A cube with a point light of the closed form: I / r2 below it, and nothing where it is off.
    const auto cube = std::make_shared<const scene::Scene>(*scene::buildScene("cie-5.8"));
    Solver solver(cube, withError(0.05), 2);
    solver.solve({});
    scene::Sensor sensor;
    sensor.position = cube->bounds().center();
    sensor.normal = Vec3d(0.0, 1.0, 0.0);
    const std::vector<scene::Sensor> sensors{sensor};
    const Rgb before = image::measure(solver, sensors)[0];
    Lighting lighting;
    lighting.lights = {Rgb(0.5f, 2.0f, 0.0f)};
    follow(solver, lighting);
    const Rgb after = image::measure(solver, sensors)[0];
    EXPECT_GT(before.g, 0.0f);
    EXPECT_NEAR(after.r, 0.5f * before.r, 1e-4f * before.r);
    EXPECT_NEAR(after.g, 2.0f * before.g, 1e-4f * before.g);
    EXPECT_LT(after.b, 1e-5f * before.b);
}

}  // namespace
}  // namespace fluxwalk
