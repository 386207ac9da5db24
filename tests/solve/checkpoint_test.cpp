#include "core/solve/checkpoint.h"

#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// A solve that was stopped and goes on from its checkpoint gets the bits of one that was not.

namespace fluxwalk {

namespace {

using base::NamedArrays;
using solve::Options;
using solve::Outcome;
using solve::Solver;
using ScenePtr = std::shared_ptr<const scene::Scene>;

ScenePtr builtIn(const char* name) {
    return std::make_shared<const scene::Scene>(*scene::buildScene(name));
}

template <class T>
bool isSame(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// All but seconds, and the memory that this process held before.
void expectSameStatistics(const solve::Statistics& a, const solve::Statistics& b) {
    solve::Counters counters = a.counters;
    counters.bytesCounted = b.counters.bytesCounted;
    EXPECT_TRUE(isSame(counters, b.counters));
    EXPECT_EQ(a.threshold, b.threshold);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.estimatedError, b.estimatedError);
    EXPECT_EQ(a.meanIrradiance, b.meanIrradiance);
    EXPECT_EQ(a.audit.absorbed, b.audit.absorbed);
    EXPECT_EQ(a.audit.escaped, b.audit.escaped);
    ASSERT_EQ(a.history.size(), b.history.size());
    for (std::size_t i = 0; i < a.history.size(); ++i) {
        EXPECT_EQ(a.history[i].threshold, b.history[i].threshold);
        EXPECT_EQ(a.history[i].residual, b.history[i].residual);
        EXPECT_EQ(a.history[i].error, b.history[i].error);
        EXPECT_EQ(a.history[i].links, b.history[i].links);
    }
}

void expectSameBits(const Solver& one, const Solver& other) {
    const hierarchy::Hierarchy& h = one.problem().hierarchy;
    const hierarchy::Hierarchy& k = other.problem().hierarchy;
    ASSERT_EQ(h.nodeCount(), k.nodeCount());
    std::size_t different = 0;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const base::NodeId id{i};
        const bool same =
            h.key(id) == k.key(id) && h.parent(id) == k.parent(id) && h.isLeaf(id) == k.isLeaf(id) &&
            isSame(h.light(id), k.light(id)) && h.shape(id).area == k.shape(id).area &&
            h.shape(id).exposed == k.shape(id).exposed && h.shape(id).corners == k.shape(id).corners;
        different += same ? 0u : 1u;
    }
    EXPECT_EQ(different, 0u) << "of " << h.nodeCount() << " nodes";
    EXPECT_EQ(h.leafCount(), k.leafCount());
    EXPECT_EQ(h.sampledAreaBefore(h.patches().size()), k.sampledAreaBefore(k.patches().size()));

    const hierarchy::LinkStore& links = one.problem().links;
    ASSERT_EQ(links.links.size(), other.problem().links.links.size());
    EXPECT_EQ(links.clusterLinks, other.problem().links.clusterLinks);
    different = 0;
    for (std::size_t i = 0; i < links.links.size(); ++i) {
        different += isSame(links.links[i], other.problem().links.links[i]) ? 0u : 1u;
    }
    EXPECT_EQ(different, 0u) << "of " << links.links.size() << " links";
    EXPECT_EQ(one.problem().rowScale, other.problem().rowScale);
    expectSameStatistics(one.statistics(), other.statistics());
}

/// The checkpoint before a solve is stopped when it has been asked `allowed` times, or after its last level.
std::optional<NamedArrays> solveAndStop(const ScenePtr& scene, const Options& options, unsigned threads,
                                        int allowed) {
    Solver solver(scene, options, threads);
    std::optional<NamedArrays> kept;
    int asked = 0;
    solve::Callbacks callbacks;
    callbacks.shouldStop = [&] { return asked++ >= allowed; };
    callbacks.resumable = [&](solve::Moment moment) {
        if (moment != solve::Moment::wave) {
            kept = solver.checkpoint();
        }
    };
    solver.solve(callbacks);
    return kept;
}

// Stops all over a solve, at ends of levels and within them.
void expectToGoOn(const ScenePtr& scene, const Options& options) {
    Solver whole(scene, options, 2);
    int asked = 0;
    solve::Callbacks count;
    count.shouldStop = [&] {
        ++asked;
        return false;
    };
    ASSERT_EQ(whole.solve(count), Outcome::reachedError);
    ASSERT_GT(whole.statistics().history.size(), 1u);
    std::size_t within = 0;
    for (int part = 0; part < 8; ++part) {
        const unsigned threads = 1 + static_cast<unsigned>(part) % 2;
        const auto kept = solveAndStop(scene, options, 3 - threads, asked * part / 8);
        ASSERT_TRUE(kept);
        within += kept->find("pending/a")->rows() > 0 ? 1u : 0u;
        Solver other(scene, options, threads);
        other.restore(*kept, "kept");
        EXPECT_EQ(other.solve({}), Outcome::reachedError);
        expectSameBits(whole, other);
    }
    EXPECT_GE(within, 2u);
}

NamedArrays checkpointOf(const ScenePtr& scene, const Options& options) {
    return *solveAndStop(scene, options, 2, 1 << 30);
}

std::string refusalOf(const ScenePtr& scene, const Options& options, const NamedArrays& arrays) {
    Solver solver(scene, options, 1);
    try {
        solver.restore(arrays, "file.fwc");
    } catch (const base::FileError& e) {
        return e.what();
    }
    return "";
}

Options rough() {
    Options options;
    options.error = .2;
    options.clusterLinks = solve::ClusterLinks::on;
    return options;
}

}  // namespace

TEST(Checkpoint, cornellBoxGoesOnToTheSameBits) {
    Options options;
    options.error = .05;
    expectToGoOn(builtIn("cornell-box"), options);
}

// Curved patches that see themselves, parts inside other solids, scaled rows.
TEST(Checkpoint, furnaceGoesOnToTheSameBits) {
    Options options;
    options.error = .1;
    options.rowScaling = true;
    expectToGoOn(builtIn("furnace"), options);
}

// Clusters, textures, a sky, every curved shape.
TEST(Checkpoint, galleryGoesOnToTheSameBits) {
    const ScenePtr scene = builtIn("gallery");
    const Options options = rough();
    Solver whole(scene, options, 2);
    whole.solve({});
    EXPECT_GT(whole.problem().links.clusterLinks, 0u);
    const NamedArrays kept = checkpointOf(scene, options);
    Solver other(scene, options, 1);
    other.restore(kept, "kept");
    other.solve({});
    expectSameBits(whole, other);
}

// A checkpoint of a finished solve is the state before its last sweeps, from which another error goes on.
TEST(Checkpoint, aSmallerErrorGoesOnFromTheLastLevel) {
    const ScenePtr scene = builtIn("cornell-box");
    const NamedArrays kept = checkpointOf(scene, rough());
    Options finer = rough();
    finer.error = .05;
    Solver other(scene, finer, 2);
    other.restore(kept, "kept");
    const std::size_t levels = other.statistics().history.size();
    EXPECT_GT(levels, 0u);
    EXPECT_EQ(other.solve({}), Outcome::reachedError);
    EXPECT_GT(other.statistics().history.size(), levels);
    EXPECT_LE(other.statistics().estimatedError, .05);
}

// Nothing left to split is not tried again.
TEST(Checkpoint, anExhaustedSolveStaysExhausted) {
    const ScenePtr scene = builtIn("squares-parallel");
    Options options;
    options.error = 1e-4;
    options.minArea = .2;
    Solver whole(scene, options, 2);
    whole.solve({});
    EXPECT_GT(whole.statistics().estimatedError, options.error);
    const NamedArrays kept = checkpointOf(scene, options);
    Solver other(scene, options, 2);
    other.restore(kept, "kept");
    other.solve({});
    expectSameBits(whole, other);
}

TEST(Checkpoint, theTimeLimitCountsAnew) {
    const ScenePtr scene = builtIn("cornell-box");
    NamedArrays kept = checkpointOf(scene, rough());
    for (base::NamedArray& array : kept.arrays) {
        if (array.name == "times/total") {
            array.values = std::vector<double>{3600.0};
        }
    }
    Options options = rough();
    options.timeLimit = 600.0;
    Solver other(scene, options, 2);
    other.restore(kept, "kept");
    EXPECT_EQ(other.solve({}), Outcome::reachedError);
    EXPECT_GT(other.statistics().times.total, 3600.0);
}

TEST(Checkpoint, optionsComeBack) {
    Options options;
    options.error = .3;
    options.oracle = solve::OracleKind::bfa;
    options.seed = 5;
    options.timeLimit = 100.0;
    const NamedArrays kept = checkpointOf(builtIn("cornell-box"), options);
    Options others;
    others.timeLimit = 7.0;
    others.errorOf = solve::ErrorOf::gathered;
    const Options stored = solve::storedOptions(kept, others, "kept");
    EXPECT_EQ(stored.error, .3);
    EXPECT_EQ(stored.oracle, solve::OracleKind::bfa);
    EXPECT_EQ(stored.seed, 5u);
    EXPECT_EQ(stored.timeLimit, 7.0);
    EXPECT_EQ(stored.errorOf, solve::ErrorOf::gathered);
}

TEST(Checkpoint, whatDoesNotFitIsRefused) {
    const ScenePtr scene = builtIn("cornell-box");
    const NamedArrays kept = checkpointOf(scene, rough());
    ASSERT_EQ(refusalOf(scene, rough(), kept), "");
    scene::Scene brighter = *scene;
    brighter.materials.back().emission *= 1.0001f;
    EXPECT_NE(refusalOf(std::make_shared<const scene::Scene>(brighter), rough(), kept).find("another scene"),
              std::string::npos);
    Options other = rough();
    other.seed = 2;
    EXPECT_NE(refusalOf(scene, other, kept).find("another --seed"), std::string::npos);
    other = rough();
    other.clusters = solve::TreeBuilder::hybrid;
    EXPECT_NE(refusalOf(scene, other, kept).find("another --clusters"), std::string::npos);
    NamedArrays altered = kept;
    ++altered.version;
    EXPECT_NE(refusalOf(scene, rough(), altered).find("another version"), std::string::npos);
    altered = kept;
    altered.kind = "fluxwalk picture";
    EXPECT_NE(refusalOf(scene, rough(), altered).find("no checkpoint"), std::string::npos);
    for (std::size_t i = 0; i < kept.arrays.size(); ++i) {
        altered = kept;
        altered.arrays.erase(altered.arrays.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_NE(refusalOf(scene, rough(), altered).find(kept.arrays[i].name + ": is missing"),
                  std::string::npos);
        altered = kept;
        std::visit(
            [](auto& values) {
                values.insert(values.end(), {0, 0, 0, 0, 0, 0});
            },
            altered.arrays[i].values);
        EXPECT_NE(refusalOf(scene, rough(), altered), "") << kept.arrays[i].name;
    }
}

// Arrays whose digest agrees and that hold anything: refused, or values that could be.
TEST(Checkpoint, alteredArraysNeverDoHarm) {
    const ScenePtr scene = builtIn("squares-parallel");
    const NamedArrays kept = checkpointOf(scene, rough());
    std::mt19937_64 random(3);
    std::size_t refused = 0;
    std::size_t passed = 0;
    for (int round = 0; round < 1000; ++round) {
        NamedArrays altered = kept;
        base::NamedArray& array = altered.arrays[random() % altered.arrays.size()];
        std::visit(
            [&](auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                if (values.empty()) {
                    return;
                }
                const std::uint64_t bits = round % 4 == 0 ? ~0ULL : random() >> (random() % 60);
                std::memcpy(&values[random() % values.size()], &bits, sizeof(T));
            },
            array.values);
        Solver solver(scene, rough(), 1);
        try {
            solver.restore(altered, "file.fwc");
        } catch (const base::FileError& e) {
            ++refused;
            ASSERT_TRUE(std::string(e.what()).starts_with("file.fwc: ")) << e.what();
            continue;
        }
        // What passes can be worked with: every index is good.
        if (++passed % 16 != 0) {
            continue;
        }
        solve::Callbacks stop;
        stop.shouldStop = [] { return true; };
        solver.solve(stop);
    }
    EXPECT_GT(refused, 250u);
    EXPECT_GT(passed, 100u);
}

}  // namespace fluxwalk
