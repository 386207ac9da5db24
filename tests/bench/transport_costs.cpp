#include "tests/bench/transport_costs.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <functional>
#include <limits>
#include <numeric>

#include "core/base/random.h"
#include "core/transport/form_factor.h"
#include "core/transport/shaft.h"
#include "core/transport/visibility.h"

namespace fluxwalk::bench {

namespace {

using hierarchy::Link;
using solve::Problem;

constexpr std::size_t kSample = 20000;
constexpr std::size_t kGrain = 64;
constexpr std::size_t kBundle = 16;
constexpr int kRounds = 3;

// Links between two different elements, evenly from all waves; `isTested` keeps those that needed rays.
std::vector<Link> sampleLinks(const Problem& problem, bool isTested) {
    std::vector<Link> all;
    for (const Link& link : problem.links.links) {
        if (link.a != link.b && problem.hierarchy.kind(link.b) == hierarchy::NodeKind::element &&
            !(isTested && link.isOpen())) {
            all.push_back(link);
        }
    }
    std::vector<Link> some;
    const std::size_t step = std::max<std::size_t>(1, all.size() / kSample);
    for (std::size_t i = 0; i < all.size(); i += step) {
        some.push_back(all[i]);
    }
    return some;
}

// Nanoseconds of CPU time for each of `count` calls of work(i), which returns what it counted; by that count.
// The fastest of some rounds.
double measure(const base::Executor& executor, std::size_t count,
               const std::function<std::uint64_t(std::size_t)>& work) {
    double best = std::numeric_limits<double>::infinity();
    std::vector<std::uint64_t> counted(count, 0);
    for (int round = 0; round < kRounds; ++round) {
        const std::clock_t start = std::clock();
        executor.forRange(count, kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                counted[i] = work(i);
            }
        });
        best = std::min(best, 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    const auto total = std::accumulate(counted.begin(), counted.end(), std::uint64_t{0});
    return total > 0 ? best / static_cast<double>(total) : 0.0;
}

struct Point {
    base::Vec3d position;
    base::Vec3d normal;
};

Point randomPoint(const hierarchy::Hierarchy& h, base::NodeId id, base::RandomStream& random) {
    const hierarchy::ElementName name = h.name(id);
    const base::Vec2d uv = surface::mapToRegion(h.region(id), random.next2()).uv;
    const surface::SurfacePoint p = h.surfaceOf(id).evaluate(name.patch, uv);
    return {p.position, name.back ? -p.normal : p.normal};
}

using Bundle = std::array<rays::Ray, kBundle>;

std::vector<Bundle> makeBundles(const Problem& problem, const std::vector<Link>& links) {
    std::vector<Bundle> bundles(links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
        base::RandomStream random(i);
        for (rays::Ray& ray : bundles[i]) {
            const Point a = randomPoint(problem.hierarchy, links[i].a, random);
            const Point b = randomPoint(problem.hierarchy, links[i].b, random);
            ray = problem.rays.segment(a.position, a.normal, b.position, b.normal);
        }
    }
    return bundles;
}

}  // namespace

TransportCosts measureTransportCosts(const Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const std::vector<Link> links = sampleLinks(problem, false);
    const std::vector<Link> tested = sampleLinks(problem, true);
    const std::vector<Bundle> bundles = makeBundles(problem, tested);
    TransportCosts costs;
    costs.links = links.size();
    costs.testedLinks = tested.size();
    const auto factor = [&](std::size_t i) {
        return transport::computePairFactor(transport::makeElementPoints(h, links[i].a),
                                            transport::makeElementPoints(h, links[i].b))
            .evaluations;
    };
    std::uint64_t evaluations = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
        evaluations += factor(i);
    }
    costs.perEvaluation = measure(problem.executor, links.size(), factor);
    costs.perFactor = costs.perEvaluation * static_cast<double>(evaluations) /
                      static_cast<double>(std::max<std::size_t>(1, links.size()));
    costs.perCertificate = measure(problem.executor, tested.size(), [&](std::size_t i) {
        transport::inspectShaft(h, tested[i].a, tested[i].b, 0.5 * problem.rays.lift());
        return 1;
    });
    costs.perRay = measure(problem.executor, tested.size(), [&](std::size_t i) {
        return transport::sampleVisibility(h, problem.rays, tested[i].a, tested[i].b).rays;
    });
    costs.perBundledRay = measure(problem.executor, bundles.size(), [&](std::size_t i) {
        std::array<std::uint8_t, kBundle> blocked{};
        problem.rays.occluded(bundles[i], blocked);
        return kBundle;
    });
    costs.perSingleRay = measure(problem.executor, bundles.size(), [&](std::size_t i) {
        for (const rays::Ray& ray : bundles[i]) {
            problem.rays.isOccluded(ray);
        }
        return kBundle;
    });
    return costs;
}

RefineShares estimateShares(const TransportCosts& costs, const solve::Counters& counters, double cpuSeconds) {
    const double perCount = 1e-9 / cpuSeconds;
    const auto evaluations = static_cast<double>(counters.kernelEvaluations);
    const auto rays = static_cast<double>(counters.rays);
    return {evaluations * costs.perEvaluation * perCount, rays * costs.perRay * perCount,
            rays * costs.perBundledRay * perCount};
}

}  // namespace fluxwalk::bench
