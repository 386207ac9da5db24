#include <string>

#include <benchmark/benchmark.h>

#include "core/hierarchy/reach.h"
#include "core/rays/ray_scene.h"
#include "core/reference/path_tracer.h"
#include "core/reference/random_sensors.h"
#include "core/scene/builders.h"

// Rays a second of the path tracer, shading and all, beside those of bare Embree on the same scene: bundles
// of 64 rays from its surfaces, of which half are asked for the nearest hit and half whether they reach a
// lamp. A bundle leaves from one point, as a path's first rays do, or from as many points, as all later ones
// do. One thread each.
namespace fluxwalk {
namespace {

struct Bed {
    Bed(const std::string& name, bool isScattered)
        : scene(*scene::buildScene(name)), rays(scene, executor), shaded(scene, rays) {
        const hierarchy::ReachedSides reached = hierarchy::findReachedSides(scene, rays, executor, 1);
        std::vector<reference::ObjectSide> sides;
        for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
            for (const bool back : {false, true}) {
                if (reached.isReached(i, back)) {
                    sides.push_back({i, back});
                }
            }
        }
        sensors = reference::randomSensors(scene, sides, 256, reference::kBenchmarkSeed);
        base::RandomStream random(5);
        for (std::size_t bundle = 0; bundle < sensors.size(); ++bundle) {
            for (std::size_t i = 0; i < kBundle; ++i) {
                const scene::Sensor& sensor =
                    sensors[isScattered ? (bundle + 67 * i) % sensors.size() : bundle];
                onward.push_back(rays.halfLine(sensor.position, sensor.normal,
                                               reference::cosineDirection(sensor.normal, random.next2())));
                const reference::SidePoint lamp = shaded.sampleEmitter(random);
                shadow.push_back(rays.segment(sensor.position, sensor.normal, lamp.position, lamp.normal));
            }
        }
    }

    static constexpr std::size_t kBundle = 64;
    base::Executor executor{1};
    scene::Scene scene;
    rays::RayScene rays;
    reference::ShadedScene shaded;
    std::vector<scene::Sensor> sensors;
    std::vector<rays::Ray> onward;
    std::vector<rays::Ray> shadow;
};

void bareRays(benchmark::State& state, const std::string& name, bool isScattered) {
    const Bed bed(name, isScattered);
    std::vector<std::optional<rays::Hit>> hits(Bed::kBundle);
    std::vector<std::uint8_t> blocked(Bed::kBundle);
    std::int64_t cast = 0;
    for (auto _ : state) {
        for (std::size_t first = 0; first < bed.onward.size(); first += Bed::kBundle) {
            bed.rays.closest(std::span(bed.onward).subspan(first, Bed::kBundle), hits);
            bed.rays.occluded(std::span(bed.shadow).subspan(first, Bed::kBundle), blocked);
            benchmark::DoNotOptimize(hits.data());
            benchmark::DoNotOptimize(blocked.data());
        }
        cast += static_cast<std::int64_t>(2 * bed.onward.size());
    }
    state.SetItemsProcessed(cast);
}

void pathTracer(benchmark::State& state, const std::string& name) {
    const Bed bed(name, false);
    reference::IrradianceTracer tracer(bed.scene, bed.rays, bed.executor, bed.sensors, 1);
    for (auto _ : state) {
        tracer.add(Bed::kBundle);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(tracer.rays()));
}

BENCHMARK_CAPTURE(bareRays, cornellBox, "cornell-box", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bareRays, cornellBoxScattered, "cornell-box", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pathTracer, cornellBox, "cornell-box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bareRays, gallery, "gallery", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bareRays, galleryScattered, "gallery", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pathTracer, gallery, "gallery")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bareRays, building10000, "building:10000", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bareRays, building10000Scattered, "building:10000", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pathTracer, building10000, "building:10000")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fluxwalk
