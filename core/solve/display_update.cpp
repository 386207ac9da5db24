#include "core/solve/display_update.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/display/interpolate.h"
#include "core/solve/display_leaves.h"

namespace fluxwalk::solve {

namespace {

/// Measured: the meshes themselves, with tables and what is held while they are made, drawn or written.
constexpr std::uint64_t kMaking = 4;

}  // namespace

DisplayUpdate::DisplayUpdate(Problem& problem) : problem_(problem) {
    const std::size_t objects = problem.scene->objects.size();
    patchesOf_.resize(objects);
    shown_.resize(objects);
    probed_.resize(objects);
    for (const NodeId id : problem.hierarchy.patches()) {
        patchesOf_[problem.hierarchy.name(id).object].push_back(id);
    }
    topologies_.resize(objects);
    isCurved_.assign(objects, 0);
    problem.executor.forRange(objects, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t o = begin; o < end; ++o) {
            const surface::Surface& surface = *problem.scene->objects[o].surface;
            for (std::uint32_t p = 0; p < surface.patchCount() && isCurved_[o] == 0; ++p) {
                isCurved_[o] = surface.isPlanar(p) ? 0 : 1;
            }
            if (!patchesOf_[o].empty()) {
                topologies_[o] = std::make_unique<display::PatchTopology>(surface);
            }
        }
    });
}

void DisplayUpdate::rebuildObject(std::size_t o, const display::MeshOptions& options, Workspace& work,
                                  Shown& shown) {
    const hierarchy::Hierarchy& h = problem_.hierarchy;
    std::vector<display::Leaf>& leaves = work.leaves;
    leaves.clear();
    // Flat objects are shown alike for any angle.
    std::uint64_t shapeDigest =
        isCurved_[o] != 0 ? base::mix(std::bit_cast<std::uint64_t>(options.curvatureAngle)) : 1;
    std::uint64_t digest = 1;
    forLeaves(h, patchesOf_[o], [&](NodeId id) {
        const display::Leaf leaf = displayLeaf(h, id);
        leaves.push_back(leaf);
        shapeDigest = base::mix(shapeDigest ^ leaf.path) + 2 * std::uint64_t{leaf.patch} +
                      (leaf.back ? 1 : 0) +
                      (static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(leaf.exposed)) << 32);
        const Rgb& e = leaf.irradiance;
        digest = base::mix(digest ^ (static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(e.r)) << 32 |
                                     std::bit_cast<std::uint32_t>(e.g))) +
                 std::bit_cast<std::uint32_t>(e.b);
    });
    digest = base::mix(digest ^ shapeDigest);
    if (leaves.empty() || digest == shown.digest) {
        return;
    }
    const bool isSameShape = shown.digest != 0 && shown.shape == shapeDigest;
    shown.digest = digest;
    shown.shape = shapeDigest;
    shown.meshes = isSameShape ? display::revalueDisplayMeshes(shown.meshes, leaves)
                               : display::buildDisplayMeshes(*topologies_[o], static_cast<std::uint32_t>(o),
                                                             problem_.scene->objects[o].material, leaves,
                                                             options, work.meshes);
}

bool DisplayUpdate::rebuild(double curvatureAngle, std::vector<Shown>& all, Clock::time_point until) {
    const StageTimer timer(problem_.statistics.times.display);
    shownNodes_ = problem_.hierarchy.nodeCount();
    display::MeshOptions options;
    options.curvatureAngle = curvatureAngle;
    // The largest first, so that threads end together; but in haste the smallest, so that many are seen.
    const bool isHasty = until != Clock::time_point::max();
    std::vector<std::size_t> sizes;
    std::vector<std::uint32_t> order;
    for (std::uint32_t o = 0; o < patchesOf_.size(); ++o) {
        std::size_t size = patchesOf_[o].size();
        for (const auto& mesh : shown_[o].meshes.meshes) {
            size += mesh->triangles.size();
        }
        sizes.push_back(size);
        order.push_back(o);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return isHasty ? sizes[a] < sizes[b] : sizes[a] > sizes[b];
    });
    std::atomic<std::size_t> next = 0;
    problem_.executor.forRange(problem_.executor.threadCount(), 1, [&](std::size_t, std::size_t) {
        Workspace work;
        while (next < order.size() && Clock::now() < until) {
            const std::size_t i = next++;
            if (i < order.size()) {
                const std::size_t o = order[i];
                rebuildObject(o, options, work, isCurved_[o] != 0 ? all[o] : shown_[o]);
            }
        }
    });
    return next >= order.size();
}

std::uint64_t DisplayUpdate::bytes() const {
    std::uint64_t bytes = 0;
    std::uint64_t layouts = 0;
    for (const Shown& object : shown_) {
        layouts += object.meshes.layoutBytes();
        for (const auto& mesh : object.meshes.meshes) {
            bytes += mesh->positions.size() * (3 * sizeof(base::Vec3)) +
                     (mesh->texcoords[0].size() + mesh->texcoords[1].size()) * sizeof(base::Vec2) +
                     mesh->triangles.size() * sizeof(std::uint32_t);
        }
    }
    return kMaking * bytes + layouts;
}

bool DisplayUpdate::refreshUntil(Clock::time_point until) {
    return rebuild(problem_.options.displayAngle * base::kPi / 180.0, shown_, until);
}

scene::LitMeshes DisplayUpdate::refresh() {
    refreshUntil(Clock::time_point::max());
    return meshes();
}

scene::LitMeshes DisplayUpdate::meshes() const {
    scene::LitMeshes all;
    for (const Shown& object : shown_) {
        all.insert(all.end(), object.meshes.meshes.begin(), object.meshes.meshes.end());
    }
    return all;
}

std::vector<const display::CellTable*> DisplayUpdate::tables() const {
    std::vector<const display::CellTable*> all;
    for (const Shown& object : shown_) {
        for (const display::CellTable& table : object.meshes.tables) {
            all.push_back(&table);
        }
    }
    return all;
}

std::vector<Rgb> DisplayUpdate::valuesAt(const std::vector<Probe>& probes) {
    // What is refined for the eye carries the same light.
    rebuild(base::kPi, probed_, Clock::time_point::max());
    std::vector<Rgb> values;
    values.reserve(probes.size());
    for (const Probe& p : probes) {
        const display::DisplayLookup lookup(*problem_.scene->objects[p.object].surface,
                                            probedOf(p.object)[p.object].meshes);
        values.push_back(lookup.irradiance(p.patch, p.back, p.uv).value_or(Rgb(0.0f)));
    }
    return values;
}

}  // namespace fluxwalk::solve
