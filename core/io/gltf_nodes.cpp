#include "core/io/gltf_nodes.h"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace fluxwalk::io {

namespace {

std::string placeOf(const GltfModel& model, int node) {
    std::string place = "/nodes/" + std::to_string(node);
    const std::string& name = model.data.nodes[static_cast<std::size_t>(node)].name;
    return name.empty() ? place : place + " '" + name + "'";
}

base::Mat4d localTransform(const GltfModel& model, int index) {
    const tinygltf::Node& node = model.data.nodes[static_cast<std::size_t>(index)];
    base::Mat4d m(1.0);
    if (node.matrix.size() == 16) {
        for (std::size_t i = 0; i < node.matrix.size(); ++i) {
            m[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = node.matrix[i];
        }
        return m;
    }
    if (node.translation.size() == 3) {
        m = glm::translate(m, base::Vec3d(node.translation[0], node.translation[1], node.translation[2]));
    }
    if (node.rotation.size() == 4) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (!(length > 1e-6) || !std::isfinite(length)) {
            model.fail(placeOf(model, index), "the rotation is not a quaternion with a direction");
        }
        m *= glm::mat4_cast(q / length);
    }
    if (node.scale.size() == 3) {
        m = glm::scale(m, base::Vec3d(node.scale[0], node.scale[1], node.scale[2]));
    }
    return m;
}

// Where to start: nodes without a parent, of the scene where the file has one. Every node has one parent at
// most, so that the walk from here is finite unless it runs in a cycle without an entry.
std::vector<int> findRoots(const GltfModel& model) {
    const std::vector<tinygltf::Node>& nodes = model.data.nodes;
    std::vector<int> parent(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            int& slot = parent[static_cast<std::size_t>(child)];
            if (slot >= 0) {
                model.fail("/nodes/" + std::to_string(i) + "/children",
                           "node " + std::to_string(child) + " has two parents");
            }
            slot = static_cast<int>(i);
        }
    }
    std::vector<int> orphans;
    std::vector<std::uint8_t> reached(nodes.size(), 0);
    std::vector<int> stack;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (parent[i] < 0) {
            orphans.push_back(static_cast<int>(i));
            stack.push_back(static_cast<int>(i));
        }
    }
    while (!stack.empty()) {
        const auto i = static_cast<std::size_t>(stack.back());
        stack.pop_back();
        reached[i] = 1;
        stack.insert(stack.end(), nodes[i].children.begin(), nodes[i].children.end());
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (reached[i] == 0) {
            model.fail(placeOf(model, static_cast<int>(i)), "the node is part of a cycle");
        }
    }
    if (model.data.scenes.empty()) {
        return orphans;
    }
    const int scene = std::max(0, model.data.defaultScene);
    const std::string place = "/scenes/" + std::to_string(scene);
    const std::vector<int>& roots = model.at(model.data.scenes, scene, place).nodes;
    std::vector<std::uint8_t> seen(nodes.size(), 0);
    for (const int root : roots) {
        const auto i = static_cast<std::size_t>(root);
        if (parent[i] >= 0 || seen[i]++ != 0) {
            model.fail(place + "/nodes", "node " + std::to_string(root) + " is listed twice or has a parent");
        }
    }
    return roots;
}

}  // namespace

std::vector<PlacedNode> placeNodes(const GltfModel& model) {
    struct Pending {
        int node;
        base::Mat4d worldFromParent;
    };
    std::vector<Pending> stack;
    const std::vector<int> roots = findRoots(model);
    for (std::size_t i = roots.size(); i-- > 0;) {
        stack.push_back({roots[i], base::Mat4d(1.0)});
    }
    std::vector<PlacedNode> placed;
    while (!stack.empty()) {
        const Pending next = stack.back();
        stack.pop_back();
        const base::Mat4d world = next.worldFromParent * localTransform(model, next.node);
        placed.push_back({next.node, placeOf(model, next.node), world});
        const std::vector<int>& children = model.data.nodes[static_cast<std::size_t>(next.node)].children;
        for (std::size_t i = children.size(); i-- > 0;) {
            stack.push_back({children[i], world});
        }
    }
    return placed;
}

std::string nameOf(const GltfModel& model, const PlacedNode& node, const std::string& content) {
    const std::string& name = model.data.nodes[static_cast<std::size_t>(node.index)].name;
    if (!name.empty()) {
        return name;
    }
    return content.empty() ? "node " + std::to_string(node.index) : content;
}

}  // namespace fluxwalk::io
