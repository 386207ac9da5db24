#include "core/solve/checkpoint_nodes.h"

#include <array>
#include <cmath>

#include "core/base/hash.h"

namespace fluxwalk::solve {

namespace {

using base::ArrayReader;
using base::NamedArrays;
using hierarchy::Hierarchy;
using hierarchy::Light;
using hierarchy::NodeKind;

/// Reflectance and emission follow from the scene.
struct LightArray {
    const char* name;
    const char* unit;
    Rgb Light::*value;
};
constexpr std::array kLight = {
    LightArray{"nodes/radiosity", "lm/m2", &Light::radiosity},
    LightArray{"nodes/irradiance", "lux", &Light::irradiance},
    LightArray{"nodes/slope-s", "lm/m2", &Light::slopeS},
    LightArray{"nodes/slope-t", "lm/m2", &Light::slopeT},
};
constexpr const char* kResidual = "nodes/residual";
constexpr const char* kParent = "nodes/parent";

// Shapes and what they do with light, to the bit: they follow from the scene, but another compiler or machine
// may round otherwise.
std::uint64_t digestNodes(const Hierarchy& h) {
    base::Hasher hash;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        const hierarchy::Shape& shape = h.shape(id);
        hash.add(shape.center);
        hash.add(shape.radius);
        hash.add(shape.axis);
        hash.add(shape.halfAngle);
        hash.add(shape.area);
        hash.add(shape.exposed);
        hash.add(std::uint64_t{shape.exposedCells});
        for (const base::Vec3& corner : shape.corners) {
            hash.add(corner);
        }
        hash.add(h.light(id).reflectance);
        hash.add(h.light(id).emission);
    }
    return hash.value();
}

/// Names of all nodes, column by column.
struct Names {
    std::vector<std::uint8_t> kind;
    std::vector<std::uint32_t> object;
    std::vector<std::uint32_t> patch;
    std::vector<std::uint8_t> back;
    std::vector<std::uint64_t> path;
    std::vector<std::uint32_t> parent;
};

Names namesOf(const Hierarchy& h) {
    Names names;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        const hierarchy::ElementName name = h.name(id);
        names.kind.push_back(static_cast<std::uint8_t>(h.kind(id)));
        names.object.push_back(name.object);
        names.patch.push_back(name.patch);
        names.back.push_back(name.back ? 1 : 0);
        names.path.push_back(name.path);
        names.parent.push_back(base::index(h.parent(id)));
    }
    return names;
}

template <class T>
void compare(const ArrayReader& reader, const char* name, const std::vector<T>& values) {
    if (reader.values<T>(name, 1, values.size()) != values) {
        reader.fail(name, "does not agree with the nodes of this scene");
    }
}

// Children stand in blocks of four behind each other, in the order in which their parents were split. What is
// split in one call depends neither on its neighbours nor on their order, so it is enough that a parent is
// there before its children.
void replaySplits(Problem& problem, const ArrayReader& reader, const std::vector<std::uint32_t>& parents) {
    Hierarchy& h = problem.hierarchy;
    const std::size_t built = h.nodeCount();
    if (parents.size() < built || (parents.size() - built) % 4 != 0 ||
        parents.size() >= base::index(NodeId::none)) {
        reader.fail(kParent, "has an impossible length");
    }
    std::vector<std::uint8_t> isSplit(parents.size(), 0);
    std::vector<NodeId> leaves;
    for (std::size_t i = built; i < parents.size(); i += 4) {
        const std::uint32_t parent = parents[i];
        if (parent >= i || isSplit[parent] != 0 || parents[i + 1] != parent || parents[i + 2] != parent ||
            parents[i + 3] != parent) {
            reader.fail(kParent, "does not make a tree");
        }
        if (parent >= h.nodeCount()) {
            h.split(leaves, problem.executor);
            leaves.clear();
        }
        const NodeId id{parent};
        if (h.kind(id) != NodeKind::element || !h.isLeaf(id) || !h.canSplit(id, 0.0)) {
            reader.fail(kParent, "splits what cannot be split");
        }
        isSplit[parent] = 1;
        leaves.push_back(id);
    }
    h.split(leaves, problem.executor);
}

}  // namespace

void saveNodes(NamedArrays& arrays, const Hierarchy& h) {
    Names names = namesOf(h);
    arrays.arrays.push_back({"scene/nodes-digest", std::vector<std::uint64_t>{digestNodes(h)}});
    arrays.arrays.push_back({"nodes/kind", std::move(names.kind)});
    arrays.arrays.push_back({"nodes/object", std::move(names.object)});
    arrays.arrays.push_back({"nodes/patch", std::move(names.patch)});
    arrays.arrays.push_back({"nodes/back", std::move(names.back)});
    arrays.arrays.push_back({"nodes/path", std::move(names.path)});
    arrays.arrays.push_back({kParent, std::move(names.parent)});
    for (const LightArray& light : kLight) {
        std::vector<float> values;
        values.reserve(3 * h.nodeCount());
        for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
            const Rgb& rgb = h.light(NodeId{i}).*light.value;
            values.insert(values.end(), {rgb.r, rgb.g, rgb.b});
        }
        arrays.arrays.push_back({light.name, std::move(values), 3, light.unit});
    }
    std::vector<float> residual;
    residual.reserve(h.nodeCount());
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        residual.push_back(h.light(NodeId{i}).residual);
    }
    arrays.arrays.push_back({kResidual, std::move(residual), 1, "lm/m2"});
}

void restoreNodes(Problem& problem, const ArrayReader& reader) {
    Hierarchy& h = problem.hierarchy;
    replaySplits(problem, reader, reader.values<std::uint32_t>(kParent));
    const Names names = namesOf(h);
    compare(reader, "nodes/kind", names.kind);
    compare(reader, "nodes/object", names.object);
    compare(reader, "nodes/patch", names.patch);
    compare(reader, "nodes/back", names.back);
    compare(reader, "nodes/path", names.path);
    compare(reader, kParent, names.parent);
    if (reader.value<std::uint64_t>("scene/nodes-digest") != digestNodes(h)) {
        reader.fail("scene/nodes-digest",
                    "differs: this program or machine computes shapes otherwise than the one that saved it");
    }
    for (const LightArray& light : kLight) {
        const std::vector<float>& values = reader.values<float>(light.name, 3, h.nodeCount());
        for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
            Rgb& rgb = h.light(NodeId{i}).*light.value;
            for (std::uint32_t c = 0; c < 3; ++c) {
                rgb[static_cast<int>(c)] = values[std::size_t{3} * i + c];
                if (!std::isfinite(rgb[static_cast<int>(c)])) {
                    reader.fail(light.name, "is not finite");
                }
            }
        }
    }
    const std::vector<float>& residual = reader.values<float>(kResidual, 1, h.nodeCount());
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        if (!std::isfinite(residual[i])) {
            reader.fail(kResidual, "is not finite");
        }
        h.light(NodeId{i}).residual = residual[i];
    }
}

}  // namespace fluxwalk::solve
