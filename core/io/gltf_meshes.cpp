#include "core/io/gltf_meshes.h"

#include <array>
#include <cmath>

#include "core/io/gltf_accessors.h"

namespace fluxwalk::io {

namespace {

using base::Vec3;
using base::Vec3d;
using Triangle = std::array<std::uint32_t, 3>;

/// Farther away from the origin, float leaves no digits for what is near (and squares overflow).
constexpr double kFarthest = 1e9;

const tinygltf::Primitive& primitiveOf(const GltfModel& model, const PlacedNode& node, int primitive) {
    const int mesh = model.data.nodes[static_cast<std::size_t>(node.index)].mesh;
    const tinygltf::Mesh& from = model.at(model.data.meshes, mesh, node.place);
    return model.at(from.primitives, primitive, node.place);
}

std::string placeOf(const GltfModel& model, const PlacedNode& node, int primitive) {
    return "/meshes/" + std::to_string(model.data.nodes[static_cast<std::size_t>(node.index)].mesh) +
           "/primitives/" + std::to_string(primitive);
}

std::vector<Triangle> formTriangles(const GltfModel& model, int mode, const std::vector<std::uint32_t>& c,
                                    const std::string& place) {
    std::vector<Triangle> triangles;
    if (c.size() < 3 || (mode == TINYGLTF_MODE_TRIANGLES && c.size() % 3 != 0)) {
        model.fail(place, std::to_string(c.size()) + " corners do not make triangles");
    }
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(c.size() / 3);
        for (std::size_t i = 0; i < c.size(); i += 3) {
            triangles.push_back({c[i], c[i + 1], c[i + 2]});
        }
        return triangles;
    }
    triangles.reserve(c.size() - 2);
    for (std::size_t i = 0; i + 2 < c.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            triangles.push_back({c[i + 1], c[i + 2], c[0]});
        } else {
            // Every other triangle of a strip runs the other way round.
            triangles.push_back({c[i], c[i + 1 + i % 2], c[i + 2 - i % 2]});
        }
    }
    return triangles;
}

Vec3d readPoint(const AccessorReader& reader, std::size_t i) {
    return {reader.component(i, 0), reader.component(i, 1), reader.component(i, 2)};
}

// Renumbers the corners to the vertices in use, and returns those in ascending order: primitives may share
// one large vertex buffer.
std::vector<std::uint32_t> keepUsed(std::vector<Triangle>& triangles) {
    std::uint32_t least = triangles[0][0];
    std::uint32_t most = least;
    for (const Triangle& t : triangles) {
        for (const std::uint32_t i : t) {
            least = std::min(least, i);
            most = std::max(most, i);
        }
    }
    constexpr std::uint32_t kUnused = 0xffffffffu;
    std::vector<std::uint32_t> renumbered(std::size_t{most} - least + 1, kUnused);
    for (const Triangle& t : triangles) {
        for (const std::uint32_t i : t) {
            renumbered[i - least] = 0;
        }
    }
    std::vector<std::uint32_t> used;
    for (std::size_t i = 0; i < renumbered.size(); ++i) {
        if (renumbered[i] != kUnused) {
            renumbered[i] = static_cast<std::uint32_t>(used.size());
            used.push_back(least + static_cast<std::uint32_t>(i));
        }
    }
    for (Triangle& t : triangles) {
        for (std::uint32_t& i : t) {
            i = renumbered[i - least];
        }
    }
    return used;
}

void readTexcoords(GltfModel& model, const tinygltf::Primitive& primitive, unsigned set,
                   std::size_t vertexCount, const std::vector<std::uint32_t>& used, const std::string& place,
                   std::vector<base::Vec2>& texcoords) {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) {
        model.warnings.add("a textured primitive has no " + name, place);
        return;
    }
    const AccessorReader reader(model, attribute->second);
    if (reader.components() != 2 || reader.size() != vertexCount) {
        model.fail(reader.place(), name + " must have two components for each of the " +
                                       std::to_string(vertexCount) + " vertices");
    }
    texcoords.reserve(used.size());
    for (const std::uint32_t i : used) {
        const base::Vec2d uv(reader.component(i, 0), reader.component(i, 1));
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            model.fail(reader.place(), "element " + std::to_string(i) + " is not finite");
        }
        texcoords.emplace_back(uv);
    }
}

void readTransformed(const GltfModel& model, const AccessorReader& reader, const PlacedNode& node,
                     const std::vector<std::uint32_t>& used, std::vector<Vec3>& positions) {
    positions.reserve(used.size());
    for (const std::uint32_t i : used) {
        const Vec3d local = readPoint(reader, i);
        const Vec3d world(node.worldFromNode * glm::dvec4(local, 1.0));
        const double largest = std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)});
        // Also catches NaN, which compares with nothing and which max may hide.
        if (!(largest <= kFarthest && std::isfinite(world.x + world.y + world.z))) {
            model.fail(reader.place(), "element " + std::to_string(i) +
                                           " is not finite, or is placed beyond 1e9 m by " + node.place);
        }
        positions.emplace_back(world);
    }
}

AccessorReader positionsOf(const GltfModel& model, const tinygltf::Primitive& primitive,
                           const std::string& place) {
    const auto attribute = primitive.attributes.find("POSITION");
    if (attribute == primitive.attributes.end()) {
        model.fail(place, "has no POSITION");
    }
    AccessorReader positions(model, attribute->second);
    if (positions.components() != 3) {
        model.fail(positions.place(), "POSITION must have three components");
    }
    return positions;
}

}  // namespace

std::vector<std::uint32_t> readCorners(const GltfModel& model, const tinygltf::Primitive& primitive,
                                       std::size_t vertexCount) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices < 0) {
        corners.resize(vertexCount);
        for (std::size_t i = 0; i < vertexCount; ++i) {
            corners[i] = static_cast<std::uint32_t>(i);
        }
        return corners;
    }
    const AccessorReader indices(model, primitive.indices);
    if (!indices.isInteger()) {
        model.fail(indices.place(), "indices must be unsigned integer scalars");
    }
    corners.reserve(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::uint32_t index = indices.index(i);
        if (index >= vertexCount) {
            model.fail(indices.place(), "element " + std::to_string(i) + " is " + std::to_string(index) +
                                            ", but there are " + std::to_string(vertexCount) + " vertices");
        }
        corners.push_back(index);
    }
    return corners;
}

std::optional<surface::TriangleSoup> readPrimitive(GltfModel& model, const PlacedNode& node, int primitive,
                                                   const scene::Material& material,
                                                   std::uint64_t& trianglesLeft) {
    const tinygltf::Primitive& from = primitiveOf(model, node, primitive);
    const std::string place = placeOf(model, node, primitive);
    if (from.mode != TINYGLTF_MODE_TRIANGLES && from.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        from.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
        model.warnings.add("points and lines have no surface; left out", place);
        return std::nullopt;
    }
    if (!from.targets.empty()) {
        model.warnings.add("morph targets are not supported; the base shape is used", place);
    }
    if (from.attributes.count("COLOR_0") != 0) {
        model.warnings.add("vertex colours are not supported; ignored", place);
    }
    const AccessorReader positions = positionsOf(model, from, place);
    surface::TriangleSoup soup;
    soup.triangles = formTriangles(model, from.mode, readCorners(model, from, positions.size()), place);
    if (soup.triangles.size() > trianglesLeft) {
        model.fail(place, "the scene has more than " + std::to_string(kMaxTriangles) + " triangles");
    }
    trianglesLeft -= soup.triangles.size();
    const std::vector<std::uint32_t> used = keepUsed(soup.triangles);
    readTransformed(model, positions, node, used, soup.positions);
    for (unsigned set = 0; set < 2; ++set) {
        const auto uses = [set](const scene::TextureRef& texture) {
            return texture.isSet() && texture.texcoordSet == set;
        };
        if (uses(material.reflectanceTexture) || uses(material.emissionTexture) ||
            uses(material.normalTexture) || uses(material.bumpTexture)) {
            readTexcoords(model, from, set, positions.size(), used, place, soup.texcoords[set]);
        }
    }
    if (glm::determinant(glm::dmat3(node.worldFromNode)) < 0.0) {
        // A mirrored node keeps its front side (glTF 2.0, section 3.7.4).
        for (Triangle& t : soup.triangles) {
            std::swap(t[1], t[2]);
        }
    }
    return soup;
}

base::Box localBounds(const GltfModel& model, const PlacedNode& node, int primitive) {
    const AccessorReader positions =
        positionsOf(model, primitiveOf(model, node, primitive), placeOf(model, node, primitive));
    base::Box box;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3d p = readPoint(positions, i);
        if (!std::isfinite(p.x + p.y + p.z)) {
            model.fail(positions.place(), "element " + std::to_string(i) + " is not finite");
        }
        box.extend(p);
    }
    return box;
}

}  // namespace fluxwalk::io
