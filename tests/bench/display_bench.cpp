#include <benchmark/benchmark.h>

#include "core/display/interpolate.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/display/display_scenes.h"

// Building the display mesh of one object with about 30,000 leaves: it runs on every snapshot. And of whole
// scenes when the displayed roundness moves.
namespace fluxwalk::display {
namespace {

double slope(const Vec3d& p) {
    return 1.0 + 0.3 * p.x + 0.2 * p.y;
}

void buildMesh(benchmark::State& state, const surface::Surface& surface, const std::vector<Leaf>& leaves) {
    const PatchTopology topology(surface);
    std::size_t triangles = 0;
    for (auto _ : state) {
        const DisplayMeshes meshes = buildDisplayMeshes(topology, 0, 0, leaves, MeshOptions{});
        triangles = meshes.meshes[0]->triangles.size() / 3;
        benchmark::DoNotOptimize(triangles);
    }
    state.counters["leaves"] = static_cast<double>(leaves.size());
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["per leaf"] =
        benchmark::Counter(static_cast<double>(leaves.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

std::vector<Leaf> lampLeaves(const surface::Surface& surface) {
    const Irradiance lamp = lampIrradiance;
    return makeLeaves(surface, lamp, SplitByRange{surface, lamp, 0.00013, 12}, 2);
}

void adaptiveQuads(benchmark::State& state) {
    const auto floor = makeFloor(2, 4.0f);
    buildMesh(state, *floor, lampLeaves(*floor));
}
BENCHMARK(adaptiveQuads)->Unit(benchmark::kMillisecond);

void adaptiveTriangles(benchmark::State& state) {
    const auto floor = makeTriangleFloor(4.0f);
    buildMesh(state, *floor, lampLeaves(*floor));
}
BENCHMARK(adaptiveTriangles)->Unit(benchmark::kMillisecond);

void randomBox(benchmark::State& state) {
    const auto box = makeBox({1, 2, 3});
    buildMesh(state, *box, makeLeaves(*box, slope, SplitRandomly{3, 8, 0.62}, 1));
}
BENCHMARK(randomBox)->Unit(benchmark::kMillisecond);

void uniformSphere(benchmark::State& state) {
    const surface::Sphere sphere(Vec3d(0.0), 1.0);
    buildMesh(state, sphere, makeLeaves(sphere, slope, SplitUniformly{6}, 1));
}
BENCHMARK(uniformSphere)->Unit(benchmark::kMillisecond);

void onePatchPerLeaf(benchmark::State& state) {
    const auto floor = makeFloor(173, 4.0f);
    buildMesh(state, *floor, makeLeaves(*floor, slope, SplitUniformly{0}, 1));
}
BENCHMARK(onePatchPerLeaf)->Unit(benchmark::kMillisecond);

void topologyOfPatches(benchmark::State& state) {
    const auto floor = makeFloor(173, 4.0f);
    for (auto _ : state) {
        const PatchTopology topology(*floor);
        benchmark::DoNotOptimize(topology.cornerCount(0));
    }
    state.counters["patches"] = floor->patchCount();
}
BENCHMARK(topologyOfPatches)->Unit(benchmark::kMillisecond);

void showAtAnotherAngle(benchmark::State& state, const scene::Scene& scene) {
    solve::Options options;
    options.error = 0.3;
    solve::Solver solver(std::make_shared<scene::Scene>(scene), options, 0);
    solver.solve({});
    const auto angle = static_cast<double>(state.range(0));
    std::size_t triangles = 0;
    for (auto _ : state) {
        state.PauseTiming();
        options.displayAngle = 15.0;
        solver.setOptions(options);
        solver.solve({});
        solver.litMeshes();
        options.displayAngle = angle;
        solver.setOptions(options);
        solver.solve({});
        state.ResumeTiming();
        triangles = 0;
        for (const auto& mesh : solver.litMeshes()) {
            triangles += mesh->triangles.size() / 3;
        }
    }
    state.counters["triangles"] = static_cast<double>(triangles);
}

void galleryAtAnotherAngle(benchmark::State& state) {
    showAtAnotherAngle(state, scene::buildGallery());
}
// Processor time of all threads too: it hardly depends on who else is at work.
BENCHMARK(galleryAtAnotherAngle)
    ->DenseRange(1, 4, 3)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void cornellBoxAtAnotherAngle(benchmark::State& state) {
    showAtAnotherAngle(state, *scene::buildScene("cornell-box"));
}
BENCHMARK(cornellBoxAtAnotherAngle)->Arg(4)->Unit(benchmark::kMillisecond)->UseRealTime();

void lookUp(benchmark::State& state) {
    const auto floor = makeFloor(2, 4.0f);
    const PatchTopology topology(*floor);
    const DisplayMeshes meshes = buildDisplayMeshes(topology, 0, 0, lampLeaves(*floor), MeshOptions{});
    const DisplayLookup lookup(*floor, meshes);
    base::RandomStream random(1);
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            lookup.irradiance(static_cast<std::uint32_t>(4.0 * random.next()), false, random.next2()));
    }
}
BENCHMARK(lookUp);

}  // namespace
}  // namespace fluxwalk::display
