#include <algorithm>
#include <array>
#include <cmath>

#include <benchmark/benchmark.h>

#include "core/rays/ray_scene.h"
#include "core/scene/builders.h"
#include "core/surface/region.h"
#include "tests/support/random_boxes.h"
#include "tests/support/random_scenes.h"

// The builders of trees side by side: time, quality, and rays through each tree against Embree's own.
namespace fluxwalk::rays {
namespace {

/// Patches of a scene as cluster trees get them.
struct Patches {
    std::vector<base::Box> boxes;
    std::vector<base::NormalCone> normals;
    std::vector<double> areas;

    Patches() = default;
    explicit Patches(const scene::Scene& scene) {
        for (const scene::Object& object : scene.objects) {
            for (std::uint32_t p = 0; p < object.surface->patchCount(); ++p) {
                const surface::Region whole = surface::wholePatch(object.surface->domain(p));
                const surface::RegionBounds bounds = object.surface->bounds(p, whole);
                boxes.push_back(bounds.box);
                normals.push_back(bounds.normals);
                areas.push_back(object.surface->area(p, whole));
            }
        }
    }
};

/// Edge of quads that are as long as their number lets them be without filling the cube [-1, 1]^3.
double edgeInCloud(std::size_t quads) {
    return 1.0 / std::cbrt(static_cast<double>(quads));
}

scene::Scene makeCloud() {
    return test::randomScene(1, 1, 100000, 0, edgeInCloud(100000));
}

Patches cloudPatches(std::size_t count) {
    Patches patches;
    base::RandomStream random(1);
    for (std::size_t i = 0; i < count; ++i) {
        const scene::Quad quad = test::randomQuad(random, 1.0, edgeInCloud(count));
        base::Box box;
        for (const base::Vec3d& corner : quad) {
            box.extend(corner);
        }
        const base::Vec3d across = glm::cross(quad[1] - quad[0], quad[3] - quad[0]);
        patches.boxes.push_back(box);
        patches.normals.push_back({glm::normalize(across), 0.0});
        patches.areas.push_back(glm::length(across));
    }
    return patches;
}

// Spread of normals in the inner nodes, weighed by the surface of their boxes: 0 where all normals of a node
// are one, 1 where they cancel.
double meanSpread(const SpatialTree& tree, const Patches& patches) {
    const auto nodes = tree.nodes();
    std::vector<base::Vec3d> normal(nodes.size());
    std::vector<double> area(nodes.size());
    double spread = 0.0;
    double surface = 0.0;
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const SpatialTree::Node& node = nodes[i];
        if (node.isLeaf()) {
            area[i] = patches.areas[node.item];
            normal[i] = area[i] * patches.normals[node.item].axis;
            continue;
        }
        area[i] = area[i + 1] + area[node.right];
        normal[i] = normal[i + 1] + normal[node.right];
        const base::Vec3d d(node.upper - node.lower);
        const double box = d.x * d.y + d.y * d.z + d.z * d.x;
        spread += box * (1.0 - glm::length(normal[i]) / area[i]);
        surface += box;
    }
    return spread / surface;
}

std::size_t depthOf(const SpatialTree& tree) {
    std::vector<std::size_t> depth(tree.nodes().size(), 1);
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (!tree.nodes()[i].isLeaf()) {
            depth[i + 1] = depth[tree.nodes()[i].right] = depth[i] + 1;
        }
    }
    return *std::max_element(depth.begin(), depth.end());
}

template <class Make>
void build(benchmark::State& state, TreeBuilder builder, bool withNormals, const Make& make) {
    const Patches patches = make();
    const base::Executor executor;
    TreeItems items{patches.boxes};
    if (withNormals) {
        items.normals = patches.normals;
        items.areas = patches.areas;
    }
    SpatialTree tree;
    for (auto _ : state) {
        tree = buildTree(builder, items, executor);
        benchmark::DoNotOptimize(tree);
    }
    state.counters["items"] = static_cast<double>(patches.boxes.size());
    state.counters["cost"] = test::surfaceCost(tree);
    state.counters["spread"] = meanSpread(tree, patches);
    state.counters["depth"] = static_cast<double>(depthOf(tree));
    state.counters["grids"] = static_cast<double>(tree.grids().size());
}

/// Segments between points of the scene's patches, as visibility asks for them, 64 from each point.
std::vector<Ray> makeRays(const scene::Scene& scene, const RayScene& rays, std::size_t count) {
    std::vector<std::pair<const surface::Surface*, std::uint32_t>> patches;
    for (const scene::Object& object : scene.objects) {
        for (std::uint32_t p = 0; p < object.surface->patchCount(); ++p) {
            patches.emplace_back(object.surface.get(), p);
        }
    }
    base::RandomStream random(3);
    const auto point = [&] {
        const auto& [surface, patch] =
            patches[static_cast<std::size_t>(random.next() * static_cast<double>(patches.size()))];
        const surface::Region whole = surface::wholePatch(surface->domain(patch));
        return surface->evaluate(patch, surface::mapToRegion(whole, random.next2()).uv);
    };
    std::vector<Ray> made;
    while (made.size() < count) {
        const surface::SurfacePoint from = point();
        for (int i = 0; i < 64; ++i) {
            const surface::SurfacePoint to = point();
            const base::Vec3d across = to.position - from.position;
            const auto towards = [&across](const base::Vec3d& n, double sign) {
                return sign * glm::dot(n, across) >= 0.0 ? n : -n;
            };
            made.push_back(rays.segment(from.position, towards(from.normal, 1.0), to.position,
                                        towards(to.normal, -1.0)));
        }
    }
    return made;
}

void shoot(benchmark::State& state, RayEngine engine, TreeBuilder builder, scene::Scene (*make)()) {
    const scene::Scene scene = make();
    const RayScene rays(scene, base::Executor(), engine, builder);
    const std::vector<Ray> all = makeRays(scene, rays, 1 << 16);
    std::array<std::uint8_t, 64> blocked{};
    std::size_t at = 0;
    double hits = 0.0;
    for (auto _ : state) {
        rays.occluded(std::span(all).subspan(at, blocked.size()), blocked);
        hits += static_cast<double>(std::count(blocked.begin(), blocked.end(), 1));
        at = (at + blocked.size()) % all.size();
    }
    const double count = static_cast<double>(state.iterations()) * static_cast<double>(blocked.size());
    state.counters["blocked"] = hits / count;
    state.counters["rays"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
}

Patches galleryPatches() {
    return Patches(scene::buildGallery());
}

template <std::size_t count>
Patches cloud() {
    return cloudPatches(count);
}

#define BUILD(name, make)                                                                     \
    BENCHMARK_CAPTURE(build, sah_##name, TreeBuilder::sah, false, make)->UseRealTime();       \
    BENCHMARK_CAPTURE(build, sahNormals_##name, TreeBuilder::sah, true, make)->UseRealTime(); \
    BENCHMARK_CAPTURE(build, hybrid_##name, TreeBuilder::hybrid, false, make)->UseRealTime(); \
    BENCHMARK_CAPTURE(build, embree_##name, TreeBuilder::embree, false, make)->UseRealTime()

BUILD(gallery, galleryPatches);
BUILD(cloud10k, cloud<10000>);
BUILD(cloud100k, cloud<100000>);
BUILD(cloud1M, cloud<1000000>);

#define RAYS(name, make)                                                                     \
    BENCHMARK_CAPTURE(shoot, bareEmbree_##name, RayEngine::embree, TreeBuilder::sah, make);  \
    BENCHMARK_CAPTURE(shoot, sah_##name, RayEngine::clusters, TreeBuilder::sah, make);       \
    BENCHMARK_CAPTURE(shoot, hybrid_##name, RayEngine::clusters, TreeBuilder::hybrid, make); \
    BENCHMARK_CAPTURE(shoot, embree_##name, RayEngine::clusters, TreeBuilder::embree, make)

RAYS(gallery, scene::buildGallery);
RAYS(cloud100k, makeCloud);

}  // namespace
}  // namespace fluxwalk::rays
