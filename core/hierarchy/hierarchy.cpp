#include "core/hierarchy/hierarchy.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/hierarchy/exposure.h"

namespace fluxwalk::hierarchy {

namespace {

bool isLuminaire(const scene::Scene& scene, std::uint32_t object) {
    return scene.materials[scene.objects[object].material].isEmissive();
}

// Whether another patch's box reaches into the inside of this box (shrunk, so that walls that meet at an edge
// do not count).
bool touchesOther(const rays::SpatialTree& tree, std::span<const Hierarchy::PatchRef> items,
                  const base::Box& box, double margin, std::uint32_t object, std::uint32_t patch) {
    base::Box inner = box;
    for (int i = 0; i < 3; ++i) {
        // Flat boxes grow along their thin axis and shrink along the others.
        const double size = box.upper[i] - box.lower[i];
        const double shrink = size > 8.0 * margin ? 2.0 * margin : -margin;
        inner.lower[i] += shrink;
        inner.upper[i] -= shrink;
    }
    const Vec3 lower(inner.lower);
    const Vec3 upper(inner.upper);
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const std::uint32_t at = stack.back();
        stack.pop_back();
        const rays::SpatialTree::Node& node = tree.nodes()[at];
        if (node.lower.x > upper.x || node.lower.y > upper.y || node.lower.z > upper.z ||
            node.upper.x < lower.x || node.upper.y < lower.y || node.upper.z < lower.z) {
            continue;
        }
        if (!node.isLeaf()) {
            stack.push_back(node.right);
            stack.push_back(at + 1);
        } else if (items[node.item].object != object || items[node.item].patch != patch) {
            return true;
        }
    }
    return false;
}

/// The tree before its nodes exist: patches under clusters, luminaires and sources in subtrees of their own.
struct Blueprint {
    struct Node {
        NodeKind kind = NodeKind::cluster;
        bool back = false;
        std::uint32_t item = 0;  ///< shaft item of an element, index of a light
        NodeId parent = NodeId::none;
        NodeId firstChild = NodeId::none;
    };
    std::vector<Node> nodes;
};

/// Loose binary tree that a blueprint is laid out from.
struct Sketch {
    struct Node {
        Blueprint::Node what;
        std::array<std::uint32_t, 2> children{};
    };
    std::vector<Node> nodes;

    std::uint32_t addLeaf(NodeKind kind, std::uint32_t item, bool back) {
        nodes.push_back({{kind, back, item, NodeId::none, NodeId::none}, {}});
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }
    std::uint32_t addPair(std::uint32_t a, std::uint32_t b) {
        nodes.push_back({{}, {a, b}});
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }
    std::uint32_t addChain(const std::vector<std::uint32_t>& parts) {
        std::uint32_t top = parts.front();
        for (std::size_t i = 1; i < parts.size(); ++i) {
            top = addPair(top, parts[i]);
        }
        return top;
    }

    // Copies a spatial tree's topology; a patch reached on both sides becomes a pair.
    std::uint32_t addTree(const rays::SpatialTree& tree, std::span<const std::uint32_t> items,
                          std::span<const std::array<bool, 2>> sides) {
        std::vector<std::uint32_t> made(tree.nodes().size());
        for (std::size_t i = tree.nodes().size(); i-- > 0;) {
            const rays::SpatialTree::Node& node = tree.nodes()[i];
            if (!node.isLeaf()) {
                made[i] = addPair(made[i + 1], made[node.right]);
                continue;
            }
            std::vector<std::uint32_t> parts;
            for (const bool back : {false, true}) {
                if (sides[node.item][back ? 1 : 0]) {
                    parts.push_back(addLeaf(NodeKind::element, items[node.item], back));
                }
            }
            made[i] = addChain(parts);
        }
        return made.front();
    }

    Blueprint layOut(std::uint32_t root) const {
        Blueprint plan;
        std::vector<std::uint32_t> from{root};
        plan.nodes.push_back(nodes[root].what);
        // Breadth first: the children of one node are two neighbours.
        for (std::size_t i = 0; i < from.size(); ++i) {
            if (plan.nodes[i].kind != NodeKind::cluster) {
                continue;
            }
            plan.nodes[i].firstChild = NodeId{static_cast<std::uint32_t>(from.size())};
            for (const std::uint32_t child : nodes[from[i]].children) {
                from.push_back(child);
                plan.nodes.push_back(nodes[child].what);
                plan.nodes.back().parent = NodeId{static_cast<std::uint32_t>(i)};
            }
        }
        return plan;
    }
};

Blueprint drawBlueprint(const Hierarchy& h, std::span<const base::Box> boxes,
                        const base::Executor& executor) {
    const scene::Scene& scene = h.scene();
    Sketch sketch;
    std::vector<std::uint32_t> parts;
    for (const bool luminaires : {true, false}) {
        std::vector<base::Box> chosen;
        std::vector<std::uint32_t> items;
        std::vector<std::array<bool, 2>> sides;
        for (std::uint32_t item = 0; item < h.shaftItems().size(); ++item) {
            const std::uint32_t object = h.shaftItems()[item].object;
            const std::uint32_t patch = h.shaftItems()[item].patch;
            const std::array<bool, 2> reached{h.reached().isReached(object, patch, false),
                                              h.reached().isReached(object, patch, true)};
            if ((reached[0] || reached[1]) && isLuminaire(scene, object) == luminaires) {
                chosen.push_back(boxes[item]);
                items.push_back(item);
                sides.push_back(reached);
            }
        }
        if (!chosen.empty()) {
            parts.push_back(sketch.addTree(rays::SpatialTree(chosen, executor), items, sides));
        }
    }
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        parts.push_back(sketch.addLeaf(NodeKind::light, i, false));
    }
    if (scene.sky != Rgb(0.0f)) {
        parts.push_back(sketch.addLeaf(NodeKind::sky, 0, false));
    }
    return parts.empty() ? Blueprint{} : sketch.layOut(sketch.addChain(parts));
}

}  // namespace

float Light::range() const {
    return residual + base::channelMean(glm::abs(slopeS)) + base::channelMean(glm::abs(slopeT));
}

std::size_t Hierarchy::bytesPerNode() {
    return sizeof(NodeId) * 2 + sizeof(NodeKind) + sizeof(std::uint32_t) * 2 + sizeof(surface::Path) +
           sizeof(Shape) + sizeof(Light) + 1;
}

Hierarchy::Hierarchy(const scene::Scene& scene, const rays::RayScene& rays, const base::Executor& executor,
                     std::uint64_t seed)
    : scene_(&scene),
      rays_(&rays),
      textures_(scene),
      reached_(findReachedSides(scene, rays, executor, seed)),
      seed_(seed) {
    collectItems(executor);
    const Blueprint plan = drawBlueprint(*this, shaftBoxes_, executor);
    resize(plan.nodes.size());
    patchNodes_.assign(shaftItems_.size(), {NodeId::none, NodeId::none});
    // Top down, so that children are one block behind each other. The blueprint's indices become the node
    // ids.
    for (std::uint32_t i = 0; i < plan.nodes.size(); ++i) {
        const Blueprint::Node& from = plan.nodes[i];
        const NodeId id{i};
        kind_[i] = from.kind;
        parent_[i] = from.parent;
        firstChild_[i] = from.firstChild;
        if (from.kind == NodeKind::element) {
            object_[i] = shaftItems_[from.item].object;
            patchSide_[i] = shaftItems_[from.item].patch * 2 + (from.back ? 1 : 0);
            patches_.push_back(id);
            patchNodes_[from.item][from.back ? 1 : 0] = id;
        } else if (from.kind == NodeKind::cluster) {
            object_[i] = i;  // the name of a cluster is its place in the tree, which the scene fixes
        } else {
            object_[i] = from.item;
            sources_.push_back(id);
            light_[i].radiosity = from.kind == NodeKind::sky ? scene.sky : scene.lights[from.item].intensity;
            light_[i].emission = light_[i].radiosity;
        }
    }
    root_ = plan.nodes.empty() ? NodeId::none : NodeId{0};
    leafCount_ = patches_.size();
    shapePatches(executor);
    shapeClusters();
}

void Hierarchy::collectItems(const base::Executor& executor) {
    for (std::uint32_t o = 0; o < scene_->objects.size(); ++o) {
        firstShaftItem_.push_back(static_cast<std::uint32_t>(shaftItems_.size()));
        for (std::uint32_t p = 0; p < scene_->objects[o].surface->patchCount(); ++p) {
            shaftItems_.push_back({o, p});
        }
    }
    shaftBoxes_.resize(shaftItems_.size());
    executor.forRange(shaftItems_.size(), 1024, [this](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const surface::Surface& surface = *scene_->objects[shaftItems_[i].object].surface;
            const std::uint32_t patch = shaftItems_[i].patch;
            shaftBoxes_[i] = surface.bounds(patch, surface::wholePatch(surface.domain(patch))).box;
        }
    });
    shaftTree_ = rays::SpatialTree(shaftBoxes_, executor);
}

void Hierarchy::resize(std::size_t count) {
    parent_.resize(count, NodeId::none);
    firstChild_.resize(count, NodeId::none);
    kind_.resize(count, NodeKind::element);
    object_.resize(count, 0);
    patchSide_.resize(count, 0);
    path_.resize(count, surface::kRootPath);
    shape_.resize(count);
    light_.resize(count);
    mayHide_.resize(count, 0);
}

void Hierarchy::shapePatches(const base::Executor& executor) {
    const double margin = rays_->lift() * 4.0;
    executor.forRange(patches_.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NodeId id = patches_[i];
            const ElementName at = name(id);
            const base::Box& box = shaftBoxes_[firstShaftItem_[at.object] + at.patch];
            mayHide_[index(id)] =
                touchesOther(shaftTree_, shaftItems_, box, margin, at.object, at.patch) ? 1 : 0;
            shapeElement(id, region(id));
        }
    });
    for (const NodeId id : patches_) {
        totalArea_ += static_cast<double>(shape(id).exposedArea());
    }
}

void Hierarchy::shapeElement(NodeId id, const surface::Region& region) {
    const ElementName at = name(id);
    const surface::Surface& surface = surfaceOf(id);
    Shape& shape = shape_[index(id)];
    const surface::RegionBounds bounds = surface.bounds(at.patch, region);
    shape.cornerCount = static_cast<std::uint8_t>(region.cornerCount);
    shape.isPlanar = surface.isPlanar(at.patch);
    shape.axis = Vec3(at.back ? -bounds.normals.axis : bounds.normals.axis);
    shape.halfAngle = static_cast<float>(bounds.normals.halfAngle);
    shape.area = static_cast<float>(surface.area(at.patch, region));
    Vec3d center(0.0);
    std::array<Vec3d, 4> corners{};
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        corners[i] = surface.evaluate(at.patch, region.corners[i]).position;
        center += corners[i] / static_cast<double>(region.cornerCount);
    }
    // Counter-clockwise from the side that takes part: the back's order is reversed.
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        shape.corners[i] = Vec3(corners[at.back ? region.cornerCount - 1 - i : i]);
    }
    double radius = 0.0;
    if (shape.isPlanar) {
        for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
            radius = std::max(radius, glm::distance(center, corners[i]));
        }
    } else {
        center = bounds.box.center();
        radius = 0.5 * bounds.box.diagonal();
    }
    shape.center = Vec3(center);
    shape.radius = static_cast<float>(radius);
    if (mayHide_[index(id)] != 0) {
        shape.exposedCells = findExposedCells(*rays_, reached_, surface, at.patch, at.back, region);
        shape.exposed = exposedFraction(shape.exposedCells);
    }
    const scene::Object& object = scene_->objects[at.object];
    const scene::RegionMaterial material =
        scene::regionMaterial(*scene_, textures_, object, at.patch, region);
    Light& light = light_[index(id)];
    light.reflectance = material.reflectance;
    light.emission =
        at.back && !scene_->materials[object.material].doubleSided ? Rgb(0.0f) : material.emission;
    light.radiosity = light.emission + light.reflectance * light.irradiance;
}

// Makes the exposed area of all ancestors the sum of their children's, so that push and pull stay adjoint.
void Hierarchy::refreshExposure(NodeId id) {
    for (; id != NodeId::none && kind(id) == NodeKind::element; id = parent(id)) {
        double area = 0.0;
        for (unsigned c = 0; c < 4; ++c) {
            area += static_cast<double>(shape(child(id, c)).exposedArea());
        }
        Shape& shape = shape_[index(id)];
        shape.exposed = shape.area > 0.0f ? static_cast<float>(area / static_cast<double>(shape.area)) : 0.0f;
    }
}

void Hierarchy::shapeClusters() {
    // Children follow their parents, so one pass from the back sees children first.
    for (std::size_t i = nodeCount(); i-- > 0;) {
        if (kind_[i] != NodeKind::cluster) {
            continue;
        }
        const Shape& a = shape_[index(firstChild_[i])];
        const Shape& b = shape_[index(firstChild_[i]) + 1];
        Shape& shape = shape_[i];
        shape.area = a.area + b.area;
        if (a.area == 0.0f || b.area == 0.0f) {
            shape = a.area == 0.0f ? b : a;
            shape.cornerCount = 0;
            continue;
        }
        const base::NormalCone cone =
            base::NormalCone::merge({Vec3d(a.axis), static_cast<double>(a.halfAngle)},
                                    {Vec3d(b.axis), static_cast<double>(b.halfAngle)});
        shape.axis = Vec3(cone.axis);
        shape.halfAngle = static_cast<float>(cone.halfAngle);
        // Smallest sphere about both spheres.
        const Vec3 between = b.center - a.center;
        const float distance = glm::length(between);
        if (distance + b.radius <= a.radius) {
            shape.center = a.center;
            shape.radius = a.radius;
        } else if (distance + a.radius <= b.radius) {
            shape.center = b.center;
            shape.radius = b.radius;
        } else {
            shape.radius = 0.5f * (distance + a.radius + b.radius);
            shape.center = a.center + between * ((shape.radius - a.radius) / distance);
        }
        shape.isPlanar = false;
    }
}

ElementName Hierarchy::name(NodeId id) const {
    const std::size_t i = index(id);
    return {object_[i], patchSide_[i] / 2, (patchSide_[i] & 1u) != 0, path_[i]};
}

std::uint64_t Hierarchy::key(NodeId id) const {
    const std::size_t i = index(id);
    const std::uint64_t kind = kind_[i] == NodeKind::element ? 0 : 1 + static_cast<std::uint64_t>(kind_[i]);
    return base::combine(base::combine(base::combine(seed_ + kind, object_[i]), patchSide_[i]), path_[i]);
}

surface::Region Hierarchy::region(NodeId id) const {
    const std::size_t i = index(id);
    return surface::regionOf(surfaceOf(id), patchSide_[i] / 2, path_[i]);
}

const surface::Surface& Hierarchy::surfaceOf(NodeId id) const {
    return *scene_->objects[object_[index(id)]].surface;
}

NodeId Hierarchy::patchNode(std::uint32_t object, std::uint32_t patch, bool back) const {
    return patchNodes_[firstShaftItem_[object] + patch][back ? 1 : 0];
}

bool Hierarchy::canSplit(NodeId id, double minArea) const {
    const std::size_t i = index(id);
    if (kind_[i] == NodeKind::cluster) {
        return true;
    }
    return kind_[i] == NodeKind::element &&
           (firstChild_[i] != NodeId::none || (static_cast<double>(shape_[i].area) > minArea &&
                                               surface::pathLevel(path_[i]) < surface::kMaxLevel));
}

void Hierarchy::split(std::span<const NodeId> leaves, const base::Executor& executor) {
    const std::size_t first = nodeCount();
    resize(first + 4 * leaves.size());
    leafCount_ += 3 * leaves.size();
    const double margin = rays_->lift() * 4.0;
    executor.forRange(leaves.size(), 32, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const NodeId parent = leaves[k];
            const std::size_t p = index(parent);
            FLUXWALK_CHECK(kind_[p] == NodeKind::element && firstChild_[p] == NodeId::none);
            const surface::Surface& surface = surfaceOf(parent);
            const std::uint32_t patch = patchSide_[p] / 2;
            const surface::Region whole = region(parent);
            firstChild_[p] = NodeId{static_cast<std::uint32_t>(first + 4 * k)};
            float sum = 0.0f;
            for (unsigned c = 0; c < 4; ++c) {
                const std::size_t i = first + 4 * k + c;
                const NodeId id{static_cast<std::uint32_t>(i)};
                parent_[i] = parent;
                object_[i] = object_[p];
                patchSide_[i] = patchSide_[p];
                path_[i] = surface::childPath(path_[p], c);
                light_[i].irradiance = light_[p].irradiance;
                light_[i].residual = 0.25f * light_[p].residual;
                const surface::Region part = surface::childRegion(surface, patch, whole, c);
                if (mayHide_[p] != 0) {
                    const bool touches = touchesOther(
                        shaftTree_, shaftItems_, surface.bounds(patch, part).box, margin, object_[i], patch);
                    // What touches nothing is all outside or all inside, as its middle is.
                    mayHide_[i] = touches || shape_[p].exposedCells != 0xffff ? 1 : 0;
                }
                shapeElement(id, part);
                sum += shape_[i].area;
            }
            // Areas by quadrature differ by rounding: children take exactly their parent's area
            // (ALGORITHMS 1.5, convention A).
            const float scale = sum > 0.0f ? shape_[p].area / sum : 1.0f;
            for (unsigned c = 0; c < 4; ++c) {
                shape_[first + 4 * k + c].area *= scale;
            }
        }
    });
    for (const NodeId parent : leaves) {
        if (mayHide_[index(parent)] != 0) {
            refreshExposure(parent);
        }
    }
}

}  // namespace fluxwalk::hierarchy
