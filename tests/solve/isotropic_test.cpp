#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/image/sensors.h"
#include "core/reference/random_sensors.h"
#include "core/scene/builders.h"
#include "core/solve/audit.h"
#include "core/solve/cluster_exchange.h"
#include "core/solve/options_table.h"
#include "core/solve/solver.h"
#include "tests/solve/linked_cloud.h"

// Clusters as isotropic volumes: what the model keeps, and what it costs.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using hierarchy::Link;
using hierarchy::NodeKind;
using solve::ClusterModel;
using test::Problem;

solve::Options withModel(ClusterModel model) {
    solve::Options options = test::withClusterLinks();
    options.clusterModel = model;
    return options;
}

void expectSameBits(const Problem& one, const Problem& other) {
    ASSERT_EQ(one.links.links.size(), other.links.links.size());
    for (std::size_t i = 0; i < one.links.links.size(); ++i) {
        const Link& a = one.links.links[i];
        const Link& b = other.links.links[i];
        ASSERT_TRUE(a.a == b.a && a.b == b.b);
        ASSERT_EQ(a.coupling, b.coupling);
        ASSERT_EQ(a.visibilityBits, b.visibilityBits);
    }
    for (std::uint32_t i = 0; i < one.hierarchy.nodeCount(); ++i) {
        ASSERT_EQ(one.hierarchy.light(NodeId{i}).radiosity, other.hierarchy.light(NodeId{i}).radiosity);
    }
}

// Mean and root mean square of what sensors all over read beside what they should, as parts of the mean.
struct Errors {
    double mean = 0.0;
    double rms = 0.0;
};

struct Solution {
    std::vector<Rgb> sensors;
    std::uint64_t links = 0;
    std::uint64_t rays = 0;
};

Solution solveCloud(ClusterModel model, std::uint64_t linkLimit, double error) {
    solve::Options options = withModel(model);
    options.linkLimit = linkLimit;
    options.error = error;
    options.errorOf = solve::ErrorOf::gathered;
    solve::Solver solver(std::make_shared<const scene::Scene>(test::buildCloud(300, 2)), options, 2);
    solver.solve({});
    const std::vector<reference::ObjectSide> room{{0, false}};
    const auto sensors = reference::randomSensors(*solver.problem().scene, room, 400, 5);
    return {image::measure(solver, sensors), solver.statistics().counters.links,
            solver.statistics().counters.rays};
}

Errors compare(const Solution& solution, const Solution& truth) {
    double all = 0.0;
    Errors errors;
    for (std::size_t i = 0; i < truth.sensors.size(); ++i) {
        const auto d = static_cast<double>(base::channelMean(solution.sensors[i] - truth.sensors[i]));
        all += static_cast<double>(base::channelMean(truth.sensors[i]));
        errors.mean += d;
        errors.rms += d * d;
    }
    const auto count = static_cast<double>(truth.sensors.size());
    errors.mean /= all;
    errors.rms = std::sqrt(errors.rms / count) * count / all;
    return errors;
}

}  // namespace

TEST(Isotropic, isNotTheDefault) {
    EXPECT_EQ(solve::Options{}.clusterModel, ClusterModel::oriented);
    const solve::OptionInfo* option = solve::findOption("cluster-model");
    ASSERT_NE(option, nullptr);
    solve::Options options;
    option->set(options, solve::parseOption(*option, "isotropic"));
    EXPECT_EQ(options.clusterModel, ClusterModel::isotropic);
    expectSameBits(*test::makeLinkedCloud(test::withClusterLinks()),
                   *test::makeLinkedCloud(withModel(ClusterModel::oriented)));
}

TEST(Isotropic, isTheSameForAnyNumberOfThreads) {
    expectSameBits(*test::makeLinkedCloud(withModel(ClusterModel::isotropic), 1),
                   *test::makeLinkedCloud(withModel(ClusterModel::isotropic), 8));
}

// What arrives through all links of clusters is what they carry, and every end shows its mean.
TEST(Isotropic, allThatIsSentArrivesEvenly) {
    const auto problem = test::makeLinkedCloud(withModel(ClusterModel::isotropic));
    const hierarchy::Hierarchy& h = problem->hierarchy;
    solve::ClusterExchange exchange(*problem, problem->rowScale);
    std::vector<Rgb> out(h.patches().size());
    exchange.gather(0, out.size(), out);
    double arriving = 0.0;
    for (std::size_t k = 0; k < out.size(); ++k) {
        arriving += static_cast<double>(h.shape(h.patches()[k]).ownArea()) * static_cast<double>(out[k].g);
    }
    double sent = 0.0;
    for (std::size_t i = 0; i < problem->links.clusterLinks; ++i) {
        const Link& link = problem->links.links[i];
        for (const NodeId end : {link.a, link.b}) {
            const NodeId source = end == link.a ? link.b : link.a;
            if (h.kind(end) == NodeKind::cluster) {
                sent += static_cast<double>(link.transfer()) *
                        std::max(0.0, static_cast<double>(exchange.shownBy(i, source).g));
            }
            if (h.kind(source) == NodeKind::cluster) {
                const float mean = h.light(source).radiosity.g;
                EXPECT_NEAR(exchange.shownBy(i, source).g, mean, 1e-5f * mean);
            }
        }
    }
    EXPECT_NEAR(arriving, sent, 1e-5 * sent);
    const solve::ClusterExchange uniform(*problem, problem->rowScale, true);
    for (std::size_t i = 0; i < problem->links.clusterLinks; i += 7) {
        EXPECT_NEAR(uniform.shownBy(i, problem->links.links[i].a).g, 1.0f, 1e-5f);
    }
}

// Sweeps see blocks of patches as they are renewed: radiosities of clusters must follow.
TEST(Isotropic, transportIsItsOwnAdjoint) {
    const auto problem = test::makeLinkedCloud(withModel(ClusterModel::isotropic));
    EXPECT_NEAR(test::adjointRatio(*problem), 1.0, 1e-5);
}

// All glow and reflect alike in a closed room: everything gets 1 / (1 - .5) = 2. Fog takes light from pairs
// of nodes and gives it to none; here it is as thick as the surfaces that get light themselves.
TEST(Isotropic, closedFurnaceIsNearlyUniform) {
    for (const ClusterModel model : {ClusterModel::oriented, ClusterModel::isotropic}) {
        const auto problem = test::makeLinkedCloud(withModel(model));
        hierarchy::Hierarchy& h = problem->hierarchy;
        test::setReflectance(*problem, .5f);
        for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
            h.light(NodeId{i}).emission = Rgb(1.0f);
        }
        test::converge(*problem, 1e-6);
        double power = 0.0;
        double area = 0.0;
        for (const NodeId id : test::leavesOf(h)) {
            const auto part = static_cast<double>(h.shape(id).exposedArea());
            power += part * static_cast<double>(h.light(id).radiosity.g);
            area += part;
        }
        const double off = power / area / 2.0 - 1.0;
        EXPECT_LT(std::abs(off), .01);
        testing::Test::RecordProperty(model == ClusterModel::oriented ? "oriented" : "isotropic",
                                      std::to_string(off));
    }
}

// At equal numbers of links: fewer rays, more error.
TEST(Isotropic, isCheaperAndLessExact) {
    const Solution truth = solveCloud(ClusterModel::oriented, 0, .004);
    const Solution oriented = solveCloud(ClusterModel::oriented, 4000, 1e-4);
    const Solution isotropic = solveCloud(ClusterModel::isotropic, 4000, 1e-4);
    EXPECT_NEAR(static_cast<double>(isotropic.links), static_cast<double>(oriented.links), 100.0);
    EXPECT_LT(isotropic.rays, oriented.rays);
    const Errors fine = compare(oriented, truth);
    const Errors coarse = compare(isotropic, truth);
    EXPECT_GT(coarse.rms, 1.5 * fine.rms);
    EXPECT_LT(coarse.rms, .2);
    testing::Test::RecordProperty("oriented_rms", std::to_string(fine.rms));
    testing::Test::RecordProperty("isotropic_rms", std::to_string(coarse.rms));
    testing::Test::RecordProperty("oriented_mean", std::to_string(fine.mean));
    testing::Test::RecordProperty("isotropic_mean", std::to_string(coarse.mean));
    testing::Test::RecordProperty("rays",
                                  std::to_string(oriented.rays) + " " + std::to_string(isotropic.rays));
    testing::Test::RecordProperty("links",
                                  std::to_string(truth.links) + " " + std::to_string(oriented.links));
}

}  // namespace fluxwalk
