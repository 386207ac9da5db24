#include <algorithm>
#include <cmath>

#include "core/base/normal_cone.h"
#include "core/base/photometry.h"
#include "core/hierarchy/hierarchy.h"

// What the hierarchy knows of its clusters, summed up from their patches.
namespace fluxwalk::hierarchy {

using base::index;

void Hierarchy::tabulatePatches() {
    for (const NodeId id : patches_) {
        const Shape& from = shape(id);
        for (int axis = 0; axis < 3; ++axis) {
            patchTable_.center[static_cast<std::size_t>(axis)].push_back(from.center[axis]);
            patchTable_.axis[static_cast<std::size_t>(axis)].push_back(from.axis[axis]);
        }
        patchTable_.spread.push_back(std::min(1.0f, from.halfAngle));
    }
    patchTable_.area.resize(patches_.size());
    sumAreas();
}

void Hierarchy::sumAreas() {
    areaBefore_.assign(patches_.size() + 1, 0.0);
    std::vector<double> ownBefore(patches_.size() + 1, 0.0);
    for (std::size_t i = 0; i < patches_.size(); ++i) {
        const Shape& patch = shape(patches_[i]);
        patchTable_.area[i] = patch.ownArea();
        areaBefore_[i + 1] = areaBefore_[i] + static_cast<double>(patch.sampledArea());
        ownBefore[i + 1] = ownBefore[i] + static_cast<double>(patch.ownArea());
    }
    for (std::size_t i = patchRange_.size(); i-- > 0;) {
        if (kind_[i] == NodeKind::cluster) {
            const auto [begin, end] = patchRange_[i];
            Shape& shape = shape_[i];
            shape.exposed = shape.area > 0.0f ? static_cast<float>((ownBefore[end] - ownBefore[begin]) /
                                                                   static_cast<double>(shape.area))
                                              : 0.0f;
        }
    }
}

void Hierarchy::pullClusters() {
    for (std::size_t i = patchRange_.size(); i-- > 0;) {
        if (kind_[i] != NodeKind::cluster) {
            continue;
        }
        Light& light = light_[i];
        light = {};
        float weight = 0.0f;
        for (unsigned c = 0; c < 2; ++c) {
            const std::size_t k = index(firstChild_[i]) + c;
            const float area = shape_[k].ownArea();
            light.radiosity += area * light_[k].radiosity;
            light.irradiance += area * light_[k].irradiance;
            weight += area;
        }
        if (weight <= 0.0f) {
            light = {};
            continue;
        }
        light.radiosity /= weight;
        light.irradiance /= weight;
        for (unsigned c = 0; c < 2; ++c) {
            const std::size_t k = index(firstChild_[i]) + c;
            if (shape_[k].ownArea() > 0.0f) {
                const float off = std::abs(base::channelMean(light_[k].radiosity - light.radiosity));
                light.residual = std::max(light.residual, off + light_[k].range());
            }
        }
    }
}

void Hierarchy::shapeClusters() {
    extent_.resize(patchRange_.size());
    for (const NodeId id : patches_) {
        const ElementName at = name(id);
        const base::Box& box = shaft_->boxes[shaft_->firstItem[at.object] + at.patch];
        extent_[index(id)] = {Vec3(box.lower), Vec3(box.upper)};
    }
    // Children follow their parents, so one pass from the back sees children first.
    for (std::size_t i = nodeCount(); i-- > 0;) {
        if (kind_[i] != NodeKind::cluster) {
            continue;
        }
        const Shape& a = shape_[index(firstChild_[i])];
        const Shape& b = shape_[index(firstChild_[i]) + 1];
        Shape& shape = shape_[i];
        const Extent& boxA = extent_[index(firstChild_[i])];
        const Extent& boxB = extent_[index(firstChild_[i]) + 1];
        extent_[i] = a.area == 0.0f ? boxB
                     : b.area == 0.0f
                         ? boxA
                         : Extent{glm::min(boxA.lower, boxB.lower), glm::max(boxA.upper, boxB.upper)};
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
        const float across = 0.5f * glm::length(extent_[i].upper - extent_[i].lower);
        if (across < shape.radius) {
            shape.center = 0.5f * (extent_[i].lower + extent_[i].upper);
            shape.radius = across;
        }
        shape.isPlanar = false;
    }
}

void Hierarchy::markClusters() {
    room_.assign(patchRange_.size(), kNoRoom);
    emitting_.assign(patchRange_.size(), 0);
    for (const NodeId id : patches_) {
        emitting_[index(id)] = light(id).emission == Rgb(0.0f) ? 2 : 1;
        room_[index(id)] =
            reached_.rooms[static_cast<std::size_t>(object_[index(id)]) * 2 + (patchSide_[index(id)] & 1u)];
    }
    // Children follow their parents.
    for (std::size_t i = patchRange_.size(); i-- > 0;) {
        if (kind_[i] == NodeKind::cluster) {
            const std::size_t child = index(firstChild_[i]);
            room_[i] = room_[child] == room_[child + 1] ? room_[child] : kNoRoom;
            emitting_[i] = emitting_[child] | emitting_[child + 1];
        }
    }
}

}  // namespace fluxwalk::hierarchy
