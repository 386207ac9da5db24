#include <map>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/hierarchy/local_frame.h"
#include "core/scene/builders.h"
#include "core/solve/assess_link.h"
#include "core/solve/cluster_exchange.h"
#include "core/transport/cluster_factor.h"
#include "core/transport/cluster_points.h"
#include "core/transport/element_sampler.h"
#include "tests/support/hard_scenes.h"
#include "tests/support/solving.h"

// Errors of accepted cluster links, found by many rays, against what the oracle says of them.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Vec3d;
using hierarchy::Link;
using hierarchy::NodeKind;
using test::Problem;

struct Point {
    transport::SurfaceSample sample;
    NodeId node = NodeId::none;  ///< patch of a cluster, or the element
};

class EndPoints {
  public:
    EndPoints(const Problem& problem, NodeId id) : h_(problem.hierarchy), id_(id) {}

    Point at(const base::Vec2d& u) const {
        if (h_.kind(id_) == NodeKind::cluster) {
            const transport::ClusterSampler::Place place = transport::ClusterSampler(h_, id_).at(u.x, u.y);
            return {place.point, h_.patches()[place.patch]};
        }
        const transport::ElementSampler sampler(h_, id_);
        Point p{sampler.inExposed(u), id_};
        p.sample.measure /= sampler.meanMeasure();
        return p;
    }

  private:
    const hierarchy::Hierarchy& h_;
    NodeId id_;
};

// Sum over the receiver's area of |what arrives through a link less what should|, in lm. Two independent
// estimates tell the reference's own noise, which is taken off in squares: nothing is left where there is
// only noise, nothing is taken where there is none.
double measureError(const Problem& problem, const solve::ClusterExchange& exchange, std::size_t index,
                    bool isAtA) {
    constexpr int kPoints = 64;
    constexpr int kRays = 64;
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const Link& link = problem.links.links[index];
    const NodeId receiver = isAtA ? link.a : link.b;
    const NodeId source = isAtA ? link.b : link.a;
    const bool isCluster = h.kind(receiver) == NodeKind::cluster;
    const auto power =
        static_cast<double>(link.transfer() * base::channelMean(exchange.shownBy(index, source)));
    const auto area = static_cast<double>(h.shape(receiver).exposedArea());
    const auto sourceArea = static_cast<double>(h.shape(source).exposedArea());
    const transport::Ball ball = transport::findBall(h, receiver, source);
    const double shares = isCluster ? static_cast<double>(transport::sumShares(h, receiver, ball)) : 0.0;
    const bool isBack = !isCluster && h.name(receiver).back;
    const base::Vec2 inRegion = (isAtA ? link.gradientA : link.gradientB).decode();
    const base::Vec2 gradient =
        isBack ? hierarchy::mirrorGradient(h.shape(receiver).cornerCount, inRegion) : inRegion;
    const EndPoints onReceiver(problem, receiver);
    const EndPoints onSource(problem, source);
    base::RandomStream random(base::combine(h.key(receiver), h.key(source)));
    double sizes = 0.0;
    double noise = 0.0;
    for (int i = 0; i < kPoints; ++i) {
        const base::Vec2d u = random.next2();
        const Point x = onReceiver.at({(i + u.x) / kPoints, u.y});
        // Over an element what arrives is linear.
        double arrives =
            power / area * (1.0 + static_cast<double>(glm::dot(gradient, base::Vec2(x.sample.local))));
        if (isCluster) {
            arrives = shares > 0.0 ? power / shares *
                                         static_cast<double>(transport::computeShare(
                                             h.patchTable(), h.firstPatchBelow(x.node), ball))
                                   : power / area;
        }
        std::array<double, 2> deviation{-arrives, -arrives};
        for (int k = 0; k < 2 * kRays; ++k) {
            const base::Vec2d v = random.next2();
            const Point y = onSource.at({(k / 2 + v.x) / kRays, v.y});
            const Vec3d d = y.sample.position - x.sample.position;
            const double cosines =
                std::max(0.0, glm::dot(d, x.sample.normal)) * std::max(0.0, -glm::dot(d, y.sample.normal));
            if (cosines > 0.0 &&
                !problem.rays.isOccluded(problem.rays.segment(x.sample.position, x.sample.normal,
                                                              y.sample.position, y.sample.normal))) {
                const double r2 = glm::dot(d, d);
                deviation[static_cast<std::size_t>(k % 2)] +=
                    y.sample.measure * cosines / (base::kPi * r2 * r2) * sourceArea / kRays *
                    static_cast<double>(base::channelMean(h.light(y.node).radiosity));
            }
        }
        sizes += .5 * x.sample.measure * std::abs(deviation[0] + deviation[1]) / kPoints;
        noise += .5 * x.sample.measure * std::abs(deviation[0] - deviation[1]) / kPoints;
    }
    return area * std::sqrt(std::max(0.0, sizes * sizes - noise * noise));
}

struct Tally {
    int links = 0;
    int beyond = 0;
    double actual = 0.0;
    double predicted = 0.0;
};

// By kind of pair and what its rays said.
std::map<std::string, Tally> tally(const Problem& problem, std::size_t most) {
    const solve::ClusterExchange exchange(problem, problem.rowScale);
    std::map<std::string, Tally> tallies;
    const std::size_t count = problem.links.clusterLinks;
    const std::size_t step = std::max<std::size_t>(1, count / most);
    for (std::size_t i = 0; i < count; i += step) {
        const Link& link = problem.links.links[i];
        const auto isCluster = [&](NodeId id) { return problem.hierarchy.kind(id) == NodeKind::cluster; };
        const double predicted =
            static_cast<double>(solve::assessLink(problem, link).error) * problem.hierarchy.totalArea();
        const double actual =
            std::max(measureError(problem, exchange, i, true), measureError(problem, exchange, i, false));
        const std::string seen = link.visibility() <= 0.0f  ? "blocked"
                                 : link.visibility() < 1.0f ? "mixed"
                                                            : "seen";
        const std::string name =
            (isCluster(link.a) && isCluster(link.b) ? "clusters " : "cluster and element ") + seen;
        Tally& t = tallies[name];
        ++t.links;
        t.beyond += actual > predicted ? 1 : 0;
        t.actual += actual;
        t.predicted += predicted;
    }
    return tallies;
}

void expectWithinPrediction(const Problem& problem) {
    int links = 0;
    int beyond = 0;
    for (const auto& [name, t] : tally(problem, 2000)) {
        links += t.links;
        beyond += t.beyond;
        EXPECT_LT(t.actual, t.predicted) << name;
    }
    EXPECT_GT(links, 150);
    EXPECT_LE(beyond, .01 * links);
}

std::unique_ptr<Problem> solveTo(scene::Scene scene, double threshold) {
    auto problem = test::makeProblem(std::move(scene), test::withClusterLinks());
    for (double t = 64.0 * threshold; t > .9 * threshold; t /= 4.0) {
        test::refine(*problem, t);
        test::converge(*problem, 1e-3);
    }
    return problem;
}

}  // namespace

TEST(ClusterOracle, boundsTheErrorsInACloud) {
    expectWithinPrediction(*solveTo(test::buildCloud(1000, 6), 1e-4));
}

TEST(ClusterOracle, boundsTheErrorsInTwoRooms) {
    expectWithinPrediction(*solveTo(scene::buildTwoRooms(), 5e-3));
}

}  // namespace fluxwalk
