#include "core/hierarchy/hierarchy.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/hierarchy/blueprint.h"
#include "core/hierarchy/exposure.h"

namespace fluxwalk::hierarchy {

namespace {

/// Narrow gaps in front of an element are at most this part of its width across: half a cell, which is a
/// quarter of its parent's.
constexpr double kGapOfWidth = 0.125;

// Of a rectangle its shorter side.
double widthOf(const Shape& shape) {
    const auto area = static_cast<double>(shape.area);
    return std::min(std::sqrt(area),
                    area / std::max(1e-300, std::sqrt(2.0) * static_cast<double>(shape.radius)));
}

// Whether another patch's box reaches into the inside of this box (shrunk, so that walls that meet at an edge
// do not count), or comes close to its flat sides.
bool touchesOther(const rays::SpatialTree& tree, std::span<const rays::PatchRef> items, const base::Box& box,
                  double margin, std::uint32_t object, std::uint32_t patch) {
    const double gap = kGapOfWidth * box.diagonal() / std::sqrt(2.0);
    base::Box inner = box;
    for (int i = 0; i < 3; ++i) {
        // Flat boxes grow along their thin axis and shrink along the others.
        const double size = box.upper[i] - box.lower[i];
        const double shrink = size > 8.0 * margin ? 2.0 * margin : -std::max(margin, gap);
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

}  // namespace

float Light::range() const {
    return residual + base::channelMean(glm::abs(slopeS)) + base::channelMean(glm::abs(slopeT));
}

std::size_t Hierarchy::bytesPerNode() {
    return sizeof(NodeId) * 2 + sizeof(NodeKind) + sizeof(std::uint32_t) * 2 + sizeof(surface::Path) +
           sizeof(Shape) + sizeof(Light) + 1;
}

Hierarchy::Hierarchy(const scene::Scene& scene, const rays::RayScene& rays, const base::Executor& executor,
                     std::uint64_t seed, rays::TreeBuilder builder)
    : scene_(&scene),
      rays_(&rays),
      textures_(scene),
      reached_(findReachedSides(scene, rays, executor, seed)),
      seed_(seed) {
    shaft_ = rays.patchTree();
    if (!shaft_) {
        shaft_ = std::make_shared<rays::PatchTree>(scene, builder, executor);
    }
    const Blueprint plan = drawBlueprint(scene, reached_, *shaft_, builder, executor);
    resize(plan.nodes.size());
    patchNodes_.assign(shaft_->items.size(), {NodeId::none, NodeId::none});
    // Top down, so that children are one block behind each other. The blueprint's indices become the node
    // ids.
    for (std::uint32_t i = 0; i < plan.nodes.size(); ++i) {
        const Blueprint::Node& from = plan.nodes[i];
        const NodeId id{i};
        kind_[i] = from.kind;
        parent_[i] = from.parent;
        firstChild_[i] = from.firstChild;
        if (from.kind == NodeKind::element) {
            object_[i] = shaft_->items[from.item].object;
            patchSide_[i] = shaft_->items[from.item].patch * 2 + (from.back ? 1 : 0);
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
    orderPatches();
    leafCount_ = patches_.size();
    shapePatches(executor);
    shapeClusters();
    markClusters();
    tabulatePatches();
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
            const base::Box& box = shaft_->boxes[shaft_->firstItem[at.object] + at.patch];
            mayHide_[index(id)] =
                touchesOther(shaft_->tree, shaft_->items, box, margin, at.object, at.patch) ? 1 : 0;
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
    shape.split = surface::splitAt(surface, at.patch, surface::pathLevel(at.path));
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
    const scene::Object& object = scene_->objects[at.object];
    const scene::RegionMaterial material =
        scene::regionMaterial(*scene_, textures_, object, at.patch, region);
    Light& light = light_[index(id)];
    light.reflectance = material.reflectance;
    const bool isEmitter =
        material.emission != Rgb(0.0f) && (!at.back || scene_->materials[object.material].doubleSided);
    light.emission = isEmitter ? material.emission * lighting_.ofMaterial(object.material) : Rgb(0.0f);
    light.radiosity = light.emission + light.reflectance * light.irradiance;
    if (mayHide_[index(id)] != 0) {
        const auto mayEmit = [this](base::ObjectId other) {
            return scene_->materials[scene_->objects[base::index(other)].material].isEmissive();
        };
        // Strips are about as wide as their parent, quarters half as wide.
        const bool isStrip =
            at.path != surface::kRootPath && shape_[index(parent(id))].split != surface::Split::quarters;
        const double width = widthOf(shape);
        const double widthOfParent =
            isStrip ? std::max(width, widthOf(shape_[index(parent(id))])) : 2.0 * width;
        const Exposure exposure = findExposure(*rays_, reached_, surface, at.patch, at.back, region,
                                               {0.25 * width, 0.25 * widthOfParent}, mayEmit, isEmitter);
        shape.exposedCells = exposure.cells;
        shape.exposedPlaces = exposure.places;
        shape.placesOfParent = exposure.placesOfParent;
        shape.isCovered = exposure.isCovered;
        shape.exposed = static_cast<float>(exposure.places) / Shape::kPlaces;
    }
}

// Makes the exposed area of all ancestors the sum of their children's, so that push and pull stay adjoint.
void Hierarchy::refreshExposure(NodeId id) {
    for (; id != NodeId::none && kind(id) == NodeKind::element; id = parent(id)) {
        double area = 0.0;
        for (unsigned c = 0; c < 4; ++c) {
            area += static_cast<double>(shape(child(id, c)).areaInParent());
        }
        Shape& shape = shape_[index(id)];
        shape.exposed = shape.area > 0.0f ? static_cast<float>(area / static_cast<double>(shape.area)) : 0.0f;
    }
}

void Hierarchy::orderPatches() {
    patchRange_.resize(nodeCount());
    std::vector<NodeId> stack;
    if (root_ != NodeId::none) {
        stack.push_back(root_);
    }
    while (!stack.empty()) {
        const NodeId id = stack.back();
        stack.pop_back();
        patchRange_[index(id)][0] = static_cast<std::uint32_t>(patches_.size());
        if (kind(id) == NodeKind::cluster) {
            stack.push_back(child(id, 1));
            stack.push_back(child(id, 0));
        } else if (kind(id) == NodeKind::element) {
            patches_.push_back(id);
        }
    }
    // Children follow their parents, and the second child's patches those of the first.
    for (std::size_t i = nodeCount(); i-- > 0;) {
        const NodeId id{static_cast<std::uint32_t>(i)};
        auto& [begin, end] = patchRange_[i];
        end = kind(id) == NodeKind::cluster   ? patchRange_[index(child(id, 1))][1]
              : kind(id) == NodeKind::element ? begin + 1
                                              : begin;
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
    return patchNodes_[shaft_->firstItem[object] + patch][back ? 1 : 0];
}

bool Hierarchy::canSplit(NodeId id, double minArea) const {
    const std::size_t i = index(id);
    if (kind_[i] == NodeKind::cluster) {
        return true;
    }
    return kind_[i] == NodeKind::element &&
           (firstChild_[i] != NodeId::none ||
            (static_cast<double>(shape_[i].area) > minArea &&
             surface::pathLevel(path_[i]) < surface::deepestLevel(surfaceOf(id), patchSide_[i] / 2)));
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
            const std::array<surface::Region, 4> parts =
                surface::childRegions(surface, patch, region(parent), shape_[p].split);
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
                const surface::Region& part = parts[c];
                if (mayHide_[p] != 0) {
                    const bool touches =
                        touchesOther(shaft_->tree, shaft_->items, surface.bounds(patch, part).box, margin,
                                     object_[i], patch);
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
