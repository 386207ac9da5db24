#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/scene/builders.h"
#include "viewer/session/solver_session.h"

// The display's light, gathered by the session's thread while the solver rests.

namespace fluxwalk::session {
namespace {

using namespace std::chrono_literals;

template <class Condition>
void waitFor(const Condition& condition) {
    while (!condition()) {
        std::this_thread::sleep_for(1ms);
    }
}

std::size_t countVertices(const solve::Snapshot& snapshot) {
    std::size_t count = 0;
    for (const auto& mesh : snapshot.meshes) {
        count += mesh->positions.size();
    }
    return count;
}

bool showsSame(const solve::Snapshot& a, const solve::Snapshot& b) {
    return std::equal(a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(),
                      [](const auto& x, const auto& y) {
                          return x->positions == y->positions && x->irradiance == y->irradiance &&
                                 x->triangles == y->triangles;
                      });
}

struct Bench {
    std::shared_ptr<const scene::Scene> scene =
        std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    image::Look look{scene->cameras.front(), 1.0};
    solve::Options options = [] {
        solve::Options rough;
        rough.error = 0.4;
        return rough;
    }();

    Solving solving() const {
        SolverSource source;
        source.make = [scene = scene](const solve::Options& o) {
            return std::make_unique<solve::Solver>(scene, o, 2);
        };
        return solveWith(source);
    }
};

bool isAllGathered(const SolverSession& session) {
    const GatherProgress gathered = session.status().gathered;
    return gathered.leaves > 0 && gathered.done == gathered.leaves && session.latest()->finished;
}

TEST(GatherSession, ShowsMoreAndMoreAndThenAll) {
    const Bench bench;
    SolverSession session(bench.solving(), bench.options, {});
    session.wait();
    const auto solved = session.latest();
    session.setGathering(bench.look);
    std::size_t done = 0;
    bool wasSeenDone = false;
    waitFor([&] {
        const GatherProgress gathered = session.status().gathered;
        EXPECT_GE(gathered.done, done);
        done = gathered.done;
        wasSeenDone = wasSeenDone || (gathered.leaves > 0 && gathered.seenPending == 0);
        // Once all that is seen is there, it stays.
        EXPECT_TRUE(!wasSeenDone || gathered.seenPending == 0);
        return isAllGathered(session);
    });
    const auto gathered = session.latest();
    EXPECT_GT(countVertices(*gathered), 2 * countVertices(*solved));
    EXPECT_EQ(gathered->sequence, solved->sequence);
    EXPECT_EQ(session.status().phase, Phase::finished);

    // What the viewer does not ask for any more goes at once, and nothing is gathered twice.
    session.setGathering(std::nullopt);
    EXPECT_EQ(session.latest(), solved);
    EXPECT_EQ(session.status().gathered.leaves, 0u);
    session.setGathering(bench.look);
    waitFor([&] { return isAllGathered(session); });
    EXPECT_TRUE(showsSame(*session.latest(), *gathered));
}

TEST(GatherSession, IsTheSameFromElsewhere) {
    const Bench bench;
    std::vector<std::shared_ptr<const solve::Snapshot>> all;
    for (const double turn : {0.0, 1.0}) {
        SolverSession session(bench.solving(), bench.options, {});
        image::Look look = bench.look;
        look.camera.forward = glm::normalize(look.camera.forward + base::Vec3d(turn, 0.2 * turn, 0.0));
        session.setGathering(look);
        waitFor([&] { return isAllGathered(session); });
        all.push_back(session.latest());
    }
    EXPECT_TRUE(showsSame(*all[0], *all[1]));
}

TEST(GatherSession, GathersInAPauseAndBeginsAnewForNewLight) {
    const Bench bench;
    solve::Options options = bench.options;
    SolverSession session(bench.solving(), options, {});
    session.wait();
    session.setGathering(bench.look);
    waitFor([&] { return isAllGathered(session); });
    const auto before = session.latest();
    // Half the light: the solver goes on, its own display is shown, then what is gathered of it.
    scene::setFactor(options.lighting, scene::listLightSources(*bench.scene).front(), base::Rgb(0.5f));
    session.setOptions(options);
    session.wait();
    waitFor([&] { return isAllGathered(session); });
    const auto after = session.latest();
    EXPECT_GT(after->sequence, before->sequence);
    double bright = 0.0;
    double dim = 0.0;
    const auto sumOf = [](const solve::Snapshot& snapshot) {
        double sum = 0.0;
        double count = 0.0;
        for (const auto& mesh : snapshot.meshes) {
            for (const base::Rgb& e : mesh->irradiance) {
                sum += static_cast<double>(base::channelMean(e));
                count += 1.0;
            }
        }
        return sum / count;
    };
    bright = sumOf(*before);
    dim = sumOf(*after);
    EXPECT_NEAR(dim / bright, 0.5, 0.05);

    // An option that changes nothing in the light: what is gathered stays.
    options.displayAngle = 8.0;
    session.setOptions(options);
    session.wait();
    waitFor([&] { return isAllGathered(session); });
    EXPECT_TRUE(showsSame(*session.latest(), *after));

    options.error = 0.001;
    session.setOptions(options);
    waitFor([&] { return session.latest()->sequence > after->sequence + 1; });
    session.setPaused(true);
    waitFor([&] { return session.status().phase == Phase::paused; });
    waitFor([&] { return session.status().gathered.done > 0; });
    EXPECT_EQ(session.status().phase, Phase::paused);
}

TEST(GatherSession, TellsOfElementsOfTheFinerMesh) {
    const Bench bench;
    SolverSession session(bench.solving(), bench.options, {});
    session.wait();
    session.setGathering(bench.look);
    waitFor([&] { return isAllGathered(session); });
    const auto plain = session.latest();
    session.setDetail({.elements = true});
    waitFor([&] { return !session.latest()->elements.empty(); });
    const auto told = session.latest();
    EXPECT_TRUE(showsSame(*told, *plain));
    ASSERT_EQ(told->elements.size(), told->meshes.size());
    for (std::size_t m = 0; m < told->meshes.size(); ++m) {
        EXPECT_EQ(told->elements[m]->elementOf.size(), told->meshes[m]->triangles.size() / 3);
    }
    // Residuals are of the elements: they are shown on the mesh that has one value for each.
    session.setDetail({.elements = true, .residuals = true});
    waitFor([&] {
        return !session.latest()->elements.empty() && !session.latest()->elements[0]->residual.empty();
    });
    EXPECT_LT(countVertices(*session.latest()), countVertices(*plain));
}

TEST(GatherSession, EndsAtAnyMoment) {
    const Bench bench;
    for (int i = 0; i < 6; ++i) {
        SolverSession session(bench.solving(), bench.options, {});
        session.setGathering(bench.look);
        if (i > 2) {
            session.wait();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(40 * i));
    }
}

}  // namespace
}  // namespace fluxwalk::session
