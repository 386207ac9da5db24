#include "core/solve/coarsen.h"

#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// Check 26, raised again: links go back up and elements go.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using solve::Options;
using solve::Outcome;
using solve::Solver;
using test::Problem;

using LinkName = std::pair<std::uint64_t, std::uint64_t>;
using LinkValue = std::tuple<float, std::uint16_t, int, int, bool>;

std::map<LinkName, LinkValue> linksByName(const Problem& problem) {
    std::map<LinkName, LinkValue> links;
    for (const hierarchy::Link& l : problem.links.links) {
        const hierarchy::Hierarchy& h = problem.hierarchy;
        const bool isHidden = h.shape(l.a).exposed < 1.0f || h.shape(l.b).exposed < 1.0f;
        links[{h.key(l.a), h.key(l.b)}] = {l.coupling, l.visibilityBits, l.spreadA, l.spreadB, isHidden};
    }
    return links;
}

// Where a part of an element is inside another solid, finer elements know that part more exactly, and what
// their ancestors exchange differs a little; everything else is the same to the bit.
void expectSameLinks(const Problem& one, const Problem& other) {
    const auto a = linksByName(one);
    const auto b = linksByName(other);
    std::size_t unmatched = 0;
    std::size_t different = 0;
    for (const auto& [name, value] : a) {
        const auto found = b.find(name);
        unmatched += found == b.end() ? 1u : 0u;
        const bool isHidden = found != b.end() && (std::get<4>(value) || std::get<4>(found->second));
        different += !isHidden && found != b.end() && found->second != value ? 1u : 0u;
    }
    // At most one in a thousand, where a hidden part tips the scales.
    EXPECT_LE(unmatched, a.size() / 1000);
    EXPECT_EQ(different, 0u) << "of " << a.size();
}

std::unique_ptr<Problem> makeLitBox() {
    auto problem = test::makeProblem(*scene::buildScene("cornell-box-unit"));
    for (const NodeId id : problem->hierarchy.patches()) {
        hierarchy::Light& light = problem->hierarchy.light(id);
        light.irradiance = Rgb(.01f);
        light.radiosity = light.emission + light.reflectance * light.irradiance;
    }
    return problem;
}

constexpr double kThreshold = 1e-5;  // lux, where the mean is 1e-2

Options withThreshold(double threshold) {
    Options options;
    options.threshold = threshold;
    return options;
}

Solver makeSolver(double threshold) {
    return {std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box-unit")),
            withThreshold(threshold), 2};
}

}  // namespace

// Nothing is swept in between, so the light is that of the start: the links are those of a fresh refinement,
// and so are the elements.
TEST(Coarsen, frozenLightLeadsToTheFreshLinks) {
    const auto fresh = makeLitBox();
    test::refine(*fresh, kThreshold);
    const auto raised = makeLitBox();
    test::refine(*raised, kThreshold / 16.0);
    const std::size_t fine = raised->links.links.size();
    const std::size_t fineLeaves = raised->hierarchy.leafCount();
    solve::dropLinks(*raised);
    test::refine(*raised, kThreshold);
    EXPECT_EQ(raised->hierarchy.leafCount(), fineLeaves);
    expectSameLinks(*raised, *fresh);
    solve::pruneElements(*raised);
    EXPECT_GT(fine, 3 * fresh->links.links.size());
    EXPECT_EQ(raised->links.links.size(), fresh->links.links.size());
    EXPECT_EQ(raised->hierarchy.leafCount(), fresh->hierarchy.leafCount());
    EXPECT_EQ(raised->hierarchy.nodeCount(), fresh->hierarchy.nodeCount());
    // And down again.
    const auto fineAgain = makeLitBox();
    test::refine(*fineAgain, kThreshold / 16.0);
    test::refine(*raised, kThreshold / 16.0);
    expectSameLinks(*raised, *fineAgain);
    EXPECT_NEAR(static_cast<double>(raised->links.links.size()),
                static_cast<double>(fineAgain->links.links.size()), 20.0);
}

TEST(Coarsen, aRaisedThresholdTakesLinksBackAndALoweredOneBringsThemBack) {
    constexpr double kFine = kThreshold / 4.0;
    constexpr double kCoarse = 4.0 * kThreshold;
    Solver fresh = makeSolver(kCoarse);
    ASSERT_EQ(fresh.solve({}), Outcome::reachedError);
    Solver solver = makeSolver(kFine);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const solve::Statistics fine = solver.statistics();
    solver.setOptions(withThreshold(kCoarse));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const solve::Statistics coarse = solver.statistics();
    EXPECT_EQ(coarse.threshold, kCoarse);
    EXPECT_LT(coarse.counters.links, fine.counters.links / 3);
    EXPECT_LT(coarse.counters.nodes, fine.counters.nodes / 2);
    const auto links = static_cast<double>(fresh.statistics().counters.links);
    EXPECT_NEAR(static_cast<double>(coarse.counters.links) / links, 1.0, .15);
    EXPECT_NEAR(coarse.meanIrradiance / fresh.statistics().meanIrradiance, 1.0, .01);
    solver.setOptions(withThreshold(kFine));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const solve::Statistics again = solver.statistics();
    EXPECT_NEAR(static_cast<double>(again.counters.links) / static_cast<double>(fine.counters.links), 1.0,
                .02);
    EXPECT_NEAR(again.meanIrradiance / fine.meanIrradiance, 1.0, 1e-3);
}

// Small turns up cost nothing.
TEST(Coarsen, withinTheHysteresisLinksStay) {
    Solver solver = makeSolver(kThreshold);
    solver.solve({});
    const std::uint64_t links = solver.statistics().counters.links;
    solver.setOptions(withThreshold(1.9 * kThreshold));
    solver.solve({});
    EXPECT_EQ(solver.statistics().counters.links, links);
    EXPECT_EQ(solver.statistics().threshold, kThreshold);
    solver.setOptions(withThreshold(2.1 * kThreshold));
    solver.solve({});
    EXPECT_LT(solver.statistics().counters.links, links);
}

// As the viewer turns it: the level at work is left at once.
TEST(Coarsen, takesEffectWhileSolving) {
    Solver solver = makeSolver(kThreshold / 64.0);
    int asked = 0;
    int askedLater = 0;
    solve::Callbacks callbacks;
    callbacks.newOptions = [&]() -> std::optional<Options> {
        ++asked;
        const bool isAtWork = solver.statistics().history.size() == 3;
        if (!isAtWork || askedLater++ != 2) {
            return std::nullopt;
        }
        return withThreshold(8.0 * kThreshold);
    };
    EXPECT_EQ(solver.solve(callbacks), Outcome::reachedError);
    EXPECT_GT(askedLater, 3);
    EXPECT_EQ(solver.statistics().threshold, 8.0 * kThreshold);
    Solver fresh = makeSolver(8.0 * kThreshold);
    fresh.solve({});
    EXPECT_NEAR(static_cast<double>(solver.statistics().counters.links) /
                    static_cast<double>(fresh.statistics().counters.links),
                1.0, .15);
}

// A checkpoint in the midst of it goes on to the same bits.
TEST(Coarsen, goesOnFromACheckpoint) {
    const auto coarsen = [](Solver& solver, const solve::Callbacks& callbacks) {
        solver.setOptions(withThreshold(8.0 * kThreshold));
        solver.solve(callbacks);
    };
    Solver whole = makeSolver(kThreshold);
    whole.solve({});
    coarsen(whole, {});
    Solver stopped = makeSolver(kThreshold);
    stopped.solve({});
    std::optional<base::NamedArrays> kept;
    solve::Callbacks callbacks;
    int waves = 0;
    callbacks.resumable = [&](solve::Moment) {
        if (++waves == 3) {
            kept = stopped.checkpoint();
        }
    };
    coarsen(stopped, callbacks);
    ASSERT_TRUE(kept);
    ASSERT_GT(kept->find("pending/a")->rows(), 0u);
    Solver other = makeSolver(8.0 * kThreshold);
    other.restore(*kept, "kept");
    other.solve({});
    EXPECT_TRUE(linksByName(other.problem()) == linksByName(whole.problem()));
    EXPECT_EQ(other.statistics().counters.nodes, whole.statistics().counters.nodes);
    EXPECT_EQ(other.statistics().meanIrradiance, whole.statistics().meanIrradiance);
}

}  // namespace fluxwalk
