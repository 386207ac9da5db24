#include "core/image/display_gather.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/display/gathered_mesh.h"
#include "core/image/sight.h"
#include "core/solve/display_leaves.h"
#include "core/solve/point_gather.h"

namespace fluxwalk::image {

namespace {

/// Parts of near leaves (SourcePoints) are found anew from here on.
constexpr std::size_t kMostPartBytes = std::size_t{128} << 20;

constexpr std::uint32_t kNoLeaf = 0xffffffffu;
/// High pictures have no more lines of sight than twice as many as they have across.
constexpr std::uint32_t kHighest = 2;
/// While the camera moves, finding that takes no more than about one part in this many of the time.
constexpr int kLookShare = 6;

bool isSame(const Look& a, const Look& b) {
    return a.camera.position == b.camera.position && a.camera.forward == b.camera.forward &&
           a.camera.up == b.camera.up && a.camera.verticalFov == b.camera.verticalFov && a.aspect == b.aspect;
}

}  // namespace

std::uint64_t digestLight(const solve::Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    std::uint64_t digest = base::mix(problem.links.links.size());
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const hierarchy::Light& light = h.light(NodeId{i});
        for (const Rgb& value : {light.irradiance, light.radiosity, light.emission}) {
            for (int c = 0; c < 3; ++c) {
                digest = base::combine(digest, std::bit_cast<std::uint32_t>(value[c]));
            }
        }
    }
    return digest;
}

DisplayGather::DisplayGather(const solve::Problem& problem, const DisplayGatherOptions& options)
    : problem_(problem), points_(problem.hierarchy) {
    listLeaves();
    for (unsigned i = 0; i < problem.executor.threadCount(); ++i) {
        gathers_.push_back(std::make_unique<LeafGather>(problem, points_, options.rays, options.sharpness));
    }
    order_.resize(leaves_.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
        order_[i] = i;
    }
}

DisplayGather::~DisplayGather() = default;

void DisplayGather::listLeaves() {
    const hierarchy::Hierarchy& h = problem_.hierarchy;
    objects_.resize(problem_.scene->objects.size());
    std::vector<std::vector<NodeId>> patchesOf(objects_.size());
    for (const NodeId id : h.patches()) {
        patchesOf[h.name(id).object].push_back(id);
    }
    leafOf_.assign(h.nodeCount(), kNoLeaf);
    for (std::uint32_t o = 0; o < objects_.size(); ++o) {
        objects_[o].first = leaves_.size();
        solve::forLeaves(h, patchesOf[o], [&](NodeId leaf) {
            leafOf_[base::index(leaf)] = static_cast<std::uint32_t>(leaves_.size());
            leaves_.push_back({leaf, o, nullptr});
        });
        objects_[o].count = leaves_.size() - objects_[o].first;
    }
    problem_.executor.forRange(objects_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t o = begin; o < end; ++o) {
            if (objects_[o].count > 0) {
                objects_[o].topology =
                    std::make_unique<display::PatchTopology>(*problem_.scene->objects[o].surface);
            }
        }
    });
}

// Finds what is seen by lines through the picture, and orders what is left.
void DisplayGather::arrange(const Look& look) {
    const std::uint32_t width = look.lines;
    const auto height =
        std::clamp(static_cast<std::uint32_t>(width / std::max(look.aspect, 1e-3)), 1u, kHighest * width);
    const Lens lens(look.camera, width, height);
    std::vector<std::uint32_t> met(static_cast<std::size_t>(width) * height, kNoLeaf);
    problem_.executor.forRange(height, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * width; i < end * width; ++i) {
            const base::Vec2d pixel(static_cast<double>(i % width) + 0.5,
                                    static_cast<double>(i / width) + 0.5);
            const rays::Ray ray{base::Vec3(lens.eye()), 0.0f, base::Vec3(lens.directionAt(pixel)),
                                std::numeric_limits<float>::max()};
            const auto hit = problem_.rays.closest(ray);
            if (!hit) {
                continue;
            }
            const std::uint32_t object = base::index(hit->object);
            const Vec3d at = Vec3d(ray.origin) + static_cast<double>(hit->t) * Vec3d(ray.direction);
            const base::Vec2d uv = problem_.scene->objects[object].surface->locate(hit->patch, at);
            if (const auto leaf = solve::findLeaf(problem_, object, hit->patch, hit->back, uv)) {
                met[i] = leafOf_[base::index(*leaf)];
            }
        }
    });
    std::vector<std::uint32_t> pixels(leaves_.size(), 0);
    for (const std::uint32_t leaf : met) {
        if (leaf != kNoLeaf) {
            ++pixels[leaf];
        }
    }
    std::vector<double> distance(leaves_.size(), 0.0);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        distance[i] = glm::distance(Vec3d(problem_.hierarchy.shape(leaves_[i].node).center), lens.eye());
    }
    const auto rest = order_.begin() + static_cast<std::ptrdiff_t>(done_);
    std::sort(rest, order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return pixels[a] != pixels[b]       ? pixels[a] > pixels[b]
               : distance[a] != distance[b] ? distance[a] < distance[b]
                                            : a < b;
    });
    const auto unseen =
        std::find_if(rest, order_.end(), [&](std::uint32_t leaf) { return pixels[leaf] == 0; });
    seenEnd_ = static_cast<std::size_t>(unseen - order_.begin());
    seen_ = leaves_.size() - static_cast<std::size_t>(std::count(pixels.begin(), pixels.end(), 0u));
    look_ = look;
}

std::size_t DisplayGather::seenPending() const {
    return seenEnd_ > done_ ? seenEnd_ - done_ : 0;
}

void DisplayGather::work(const std::optional<Look>& look, Clock::time_point until) {
    if (look && !(look_ && isSame(*look, *look_)) && Clock::now() >= lookDue_) {
        const Clock::time_point start = Clock::now();
        arrange(*look);
        const Clock::time_point now = Clock::now();
        lookDue_ = now + kLookShare * (now - start);
    }
    gatherTo(order_.size(), until);
}

void DisplayGather::workOnSeen(const Look& look, Clock::time_point until) {
    if (!(look_ && isSame(look, *look_))) {
        arrange(look);
    }
    gatherTo(std::max(done_, seenEnd_), until);
}

// The leaves of `order_` up to a place.
void DisplayGather::gatherTo(std::size_t last, Clock::time_point until) {
    const std::size_t first = done_;
    while (done_ < last && Clock::now() < until) {
        std::atomic<std::size_t> next = done_;
        problem_.executor.forRange(gathers_.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t thread = begin; thread < end; ++thread) {
                while (Clock::now() < until && points_.partBytes() < kMostPartBytes) {
                    const std::size_t place = next++;
                    if (place >= last) {
                        return;
                    }
                    LeafEntry& leaf = leaves_[order_[place]];
                    leaf.light = std::make_unique<const display::LeafLight>(
                        gathers_[thread]->gather(*objects_[leaf.object].topology, leaf.node));
                }
            }
        });
        done_ = std::min(next.load(), last);
        if (points_.partBytes() >= kMostPartBytes) {
            points_.forgetParts();
        }
    }
    for (std::size_t place = first; place < done_; ++place) {
        objects_[leaves_[order_[place]].object].isOld = true;
    }
}

void DisplayGather::build(Object& object, std::uint32_t index, const display::MeshOptions& options) const {
    std::vector<display::Leaf> leaves;
    std::vector<const display::LeafLight*> lights;
    for (std::size_t i = object.first; i < object.first + object.count; ++i) {
        leaves.push_back(solve::displayLeaf(problem_.hierarchy, leaves_[i].node));
        lights.push_back(leaves_[i].light.get());
    }
    object.meshes = display::buildGatheredMeshes(
        *object.topology, index, problem_.scene->objects[index].material, leaves, lights, options);
    object.isOld = false;
}

scene::LitMeshes DisplayGather::meshes(double displayAngle) {
    display::MeshOptions options;
    options.curvatureAngle = displayAngle;
    std::vector<std::uint32_t> old;
    for (std::uint32_t o = 0; o < objects_.size(); ++o) {
        if (objects_[o].count > 0 && (objects_[o].isOld || displayAngle != displayAngle_)) {
            old.push_back(o);
        }
    }
    displayAngle_ = displayAngle;
    // The largest first, so that threads end together.
    std::stable_sort(old.begin(), old.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return objects_[a].count > objects_[b].count; });
    problem_.executor.forRange(old.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            build(objects_[old[i]], old[i], options);
        }
    });
    scene::LitMeshes all;
    for (const Object& object : objects_) {
        all.insert(all.end(), object.meshes.meshes.begin(), object.meshes.meshes.end());
    }
    return all;
}

std::vector<const display::CellTable*> DisplayGather::tables() const {
    std::vector<const display::CellTable*> all;
    for (const Object& object : objects_) {
        for (const display::CellTable& table : object.meshes.tables) {
            all.push_back(&table);
        }
    }
    return all;
}

std::uint64_t DisplayGather::pointCount() const {
    std::uint64_t count = 0;
    for (const auto& gather : gathers_) {
        count += gather->pointCount();
    }
    return count;
}

std::uint64_t DisplayGather::bytes() const {
    std::uint64_t bytes = leaves_.size() * sizeof(LeafEntry) + leafOf_.size() * sizeof(std::uint32_t) +
                          order_.size() * sizeof(std::uint32_t);
    for (const LeafEntry& leaf : leaves_) {
        if (leaf.light) {
            bytes += sizeof(display::LeafLight) +
                     leaf.light->samples.capacity() * sizeof(display::LightSample) +
                     leaf.light->splits.capacity() * sizeof(surface::Path);
        }
    }
    return bytes;
}

}  // namespace fluxwalk::image
