#include <benchmark/benchmark.h>

#include "core/scene/builders.h"
#include "core/transport/form_factor.h"
#include "core/transport/shaft.h"
#include "core/transport/visibility.h"
#include "tests/transport/polygon_pairs.h"

// The parts of which a coefficient is made, each alone on one thread.
namespace fluxwalk::transport {
namespace {

using test::Built;
using test::Placement;

void pairFactor(benchmark::State& state, Placement placement) {
    base::RandomStream random(1);
    std::vector<test::Polygon> polygons;
    for (int i = 0; i < 128; ++i) {
        test::PolygonPair pair = test::randomPair(placement, random);
        polygons.push_back(std::move(pair.a));
        polygons.push_back(std::move(pair.b));
    }
    const Built built(test::sceneOf(polygons));
    std::vector<ElementPoints> points;
    for (std::uint32_t i = 0; i < polygons.size(); ++i) {
        points.push_back(makeElementPoints(built.tree, built.tree.patchNode(i, 0, false)));
    }
    std::size_t i = 0;
    double evaluations = 0.0;
    for (auto _ : state) {
        const PairFactor f = computePairFactor(points[i], points[i + 1]);
        evaluations += f.evaluations;
        benchmark::DoNotOptimize(f);
        i = (i + 2) % points.size();
    }
    state.counters["evaluations"] = evaluations / static_cast<double>(state.iterations());
}
BENCHMARK_CAPTURE(pairFactor, far, Placement::far);
BENCHMARK_CAPTURE(pairFactor, middle, Placement::middle);
BENCHMARK_CAPTURE(pairFactor, near, Placement::near);
BENCHMARK_CAPTURE(pairFactor, sharedEdge, Placement::sharedEdge);
BENCHMARK_CAPTURE(pairFactor, horizon, Placement::horizon);

/// Random pairs of leaves that exchange light, in a scene that is quartered everywhere.
struct Pairs {
    std::unique_ptr<Built> built;
    std::vector<std::array<NodeId, 2>> nodes;

    Pairs(scene::Scene scene, unsigned level) : built(std::make_unique<Built>(std::move(scene))) {
        built->split(level);
        std::vector<NodeId> leaves;
        for (const NodeId id : built->tree.patches()) {
            const std::vector<NodeId> below = built->leavesOf(id);
            leaves.insert(leaves.end(), below.begin(), below.end());
        }
        base::RandomStream random(2);
        const auto pick = [&] {
            return leaves[static_cast<std::size_t>(random.next() * static_cast<double>(leaves.size()))];
        };
        while (nodes.size() < 1024) {
            const NodeId a = pick();
            const NodeId b = pick();
            if (computePairFactor(makeElementPoints(built->tree, a), makeElementPoints(built->tree, b))
                    .coupling > 0.0) {
                nodes.push_back({a, b});
            }
        }
    }
};

Pairs cornellPairs() {
    return {scene::buildCornellBox(base::Rgb(100.0f)), 3};
}

Pairs curvedPairs() {
    return {test::randomScene(5, 1, 6, 6), 2};
}

template <class Make>
void elementPoints(benchmark::State& state, const Make& make) {
    const Pairs pairs = make();
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            makeElementPoints(pairs.built->tree, pairs.nodes[i++ % pairs.nodes.size()][0]));
    }
}
BENCHMARK_CAPTURE(elementPoints, planar, cornellPairs);
BENCHMARK_CAPTURE(elementPoints, mostlyCurved, curvedPairs);

template <class Make>
void shaft(benchmark::State& state, const Make& make) {
    const Pairs pairs = make();
    const double tolerance = 0.5 * pairs.built->rays.lift();
    std::size_t i = 0;
    std::size_t certain = 0;
    for (auto _ : state) {
        const auto& [a, b] = pairs.nodes[i++ % pairs.nodes.size()];
        certain += inspectShaft(pairs.built->tree, a, b, tolerance) != ShaftContent::unknown ? 1u : 0u;
    }
    state.counters["certain"] = static_cast<double>(certain) / static_cast<double>(state.iterations());
}
BENCHMARK_CAPTURE(shaft, cornell, cornellPairs);
BENCHMARK_CAPTURE(shaft, rooms, [] { return Pairs(scene::buildTwoRooms(), 2); });

template <class Make>
void visibility(benchmark::State& state, const Make& make) {
    const Pairs pairs = make();
    std::size_t i = 0;
    double rays = 0.0;
    for (auto _ : state) {
        const auto& [a, b] = pairs.nodes[i++ % pairs.nodes.size()];
        rays += sampleVisibility(pairs.built->tree, pairs.built->rays, a, b).rays;
    }
    state.counters["rays"] = rays / static_cast<double>(state.iterations());
    state.counters["perRay"] =
        benchmark::Counter(rays, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(visibility, cornell, cornellPairs);
BENCHMARK_CAPTURE(visibility, mostlyCurved, curvedPairs);

// Rays between two elements each, 64 a pair.
void occlusion(benchmark::State& state, bool bundled) {
    const Pairs pairs = cornellPairs();
    base::RandomStream random(3);
    std::vector<rays::Ray> all;
    for (const auto& ends : pairs.nodes) {
        for (int i = 0; i < 64; ++i) {
            std::array<surface::SurfacePoint, 2> p;
            for (std::size_t end = 0; end < 2; ++end) {
                const hierarchy::ElementName name = pairs.built->tree.name(ends[end]);
                p[end] = pairs.built->tree.surfaceOf(ends[end]).evaluate(
                    name.patch, surface::mapToRegion(pairs.built->tree.region(ends[end]), random.next2()).uv);
                p[end].normal = name.back ? -p[end].normal : p[end].normal;
            }
            all.push_back(pairs.built->rays.segment(p[0].position, p[0].normal, p[1].position, p[1].normal));
        }
    }
    std::array<std::uint8_t, 64> blocked{};
    std::size_t at = 0;
    for (auto _ : state) {
        const std::span<const rays::Ray> bundle(all.data() + at, 64);
        if (bundled) {
            pairs.built->rays.occluded(bundle, blocked);
        } else {
            for (std::size_t i = 0; i < bundle.size(); ++i) {
                blocked[i] = pairs.built->rays.isOccluded(bundle[i]) ? 1 : 0;
            }
        }
        benchmark::DoNotOptimize(blocked);
        at = (at + 64) % all.size();
    }
    state.counters["perRay"] = benchmark::Counter(64.0 * static_cast<double>(state.iterations()),
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(occlusion, single, false);
BENCHMARK_CAPTURE(occlusion, bundled, true);

}  // namespace
}  // namespace fluxwalk::transport
