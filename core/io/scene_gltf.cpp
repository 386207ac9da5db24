#include "core/io/scene_gltf.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/base/check.h"
#include "core/io/exact_extras.h"
#include "core/io/gltf_write_parts.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/subdivision_surface.h"

namespace fluxwalk::io {

namespace {

using base::Vec2;
using base::Vec2d;
using base::Vec3;
using base::Vec3d;
using nlohmann::json;

/// Stand-ins have so many edges along each side of a patch.
constexpr std::uint32_t kStandInEdges = 6;

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< none for polygons, which are flat
    std::array<std::vector<Vec2>, 2> texcoords;
    std::vector<std::uint32_t> triangles;

    std::uint32_t size() const { return static_cast<std::uint32_t>(positions.size()); }
};

std::array<bool, 2> usedTexcoords(const scene::Material& material) {
    std::array<bool, 2> used{};
    for (const scene::TextureRef* texture : {&material.reflectanceTexture, &material.emissionTexture,
                                             &material.normalTexture, &material.bumpTexture}) {
        if (texture->isSet()) {
            used[texture->texcoordSet] = true;
        }
    }
    return used;
}

// Adds the point of a patch; seen from a node that `nodeFromWorld` leads to.
void addPoint(Mesh& mesh, const surface::Surface& surface, std::uint32_t patch, const Vec2d& uv,
              const base::Mat4d& nodeFromWorld, const std::array<bool, 2>& texcoords) {
    const surface::SurfacePoint p = surface.evaluate(patch, uv);
    mesh.positions.emplace_back(nodeFromWorld * glm::dvec4(p.position, 1.0));
    // Normals go with the inverse transposed, and that of the inverse is the map itself.
    mesh.normals.emplace_back(
        glm::normalize(glm::transpose(glm::inverse(glm::dmat3(nodeFromWorld))) * p.normal));
    for (unsigned set = 0; set < 2; ++set) {
        if (texcoords[set]) {
            mesh.texcoords[set].emplace_back(surface.texcoord(patch, uv, set));
        }
    }
}

Mesh standInOf(const surface::Surface& surface, const base::Mat4d& nodeFromWorld,
               const std::array<bool, 2>& texcoords) {
    Mesh mesh;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        const bool isTriangle = surface.domain(patch) == surface::PatchDomain::triangle;
        std::uint32_t row = mesh.size();
        for (std::uint32_t j = 0; j <= kStandInEdges; ++j) {
            const std::uint32_t last = isTriangle ? kStandInEdges - j : kStandInEdges;
            for (std::uint32_t i = 0; i <= last; ++i) {
                addPoint(mesh, surface, patch, Vec2d(i, j) / static_cast<double>(kStandInEdges),
                         nodeFromWorld, texcoords);
            }
            const std::uint32_t next = row + last + 1;
            for (std::uint32_t i = 0; j < kStandInEdges && i < last; ++i) {
                mesh.triangles.insert(mesh.triangles.end(), {row + i, row + i + 1, next + i});
                if (!isTriangle || i + 1 < last) {
                    mesh.triangles.insert(mesh.triangles.end(), {row + i + 1, next + i + 1, next + i});
                }
            }
            row = next;
        }
    }
    return mesh;
}

// Each patch with corners of its own, as a fan: so that it is read as the same patch.
Mesh polygonsOf(const surface::PolygonMesh& polygons, const std::array<bool, 2>& texcoords) {
    constexpr std::array<Vec2d, 4> kQuad{Vec2d(0, 0), Vec2d(1, 0), Vec2d(1, 1), Vec2d(0, 1)};
    constexpr std::array<Vec2d, 3> kTriangle{Vec2d(0, 0), Vec2d(1, 0), Vec2d(0, 1)};
    Mesh mesh;
    for (std::uint32_t patch = 0; patch < polygons.patchCount(); ++patch) {
        const std::uint32_t first = mesh.size();
        const std::uint32_t count = polygons.cornerCount(patch);
        for (std::uint32_t k = 0; k < count; ++k) {
            addPoint(mesh, polygons, patch, count == 4 ? kQuad[k] : kTriangle[k], base::Mat4d(1.0),
                     texcoords);
            if (k >= 2) {
                mesh.triangles.insert(mesh.triangles.end(), {first, first + k - 1, first + k});
            }
        }
    }
    mesh.normals.clear();
    return mesh;
}

// Faces as fans, marked by FB_ngon_encoding: each begins in a vertex of its own.
Mesh meshOf(const surface::ControlCage& cage, const std::array<bool, 2>& texcoords) {
    Mesh mesh;
    std::size_t corner = 0;
    for (const std::uint32_t count : cage.faceSizes) {
        const std::uint32_t first = mesh.size();
        for (std::uint32_t k = 0; k < count; ++k, ++corner) {
            mesh.positions.emplace_back(cage.positions[cage.corners[corner]]);
            for (std::size_t set = 0; set < 2; ++set) {
                if (texcoords[set] && !cage.texcoords[set].empty()) {
                    mesh.texcoords[set].push_back(cage.texcoords[set][corner]);
                }
            }
            if (k >= 2) {
                mesh.triangles.insert(mesh.triangles.end(), {first, first + k - 1, first + k});
            }
        }
    }
    return mesh;
}

class SceneWriter {
  public:
    explicit SceneWriter(const scene::Scene& scene) : scene_(scene) {}

    std::vector<std::uint8_t> write() {
        glb_.root["asset"] = {{"version", "2.0"}, {"generator", "Fluxwalk"}};
        glb_.root["scene"] = 0;
        glb_.root["scenes"] = {{{"name", scene_.name}, {"nodes", json::array()}}};
        for (const scene::Material& material : scene_.materials) {
            glb_.append("materials", materialJson(material));
        }
        for (const scene::Object& object : scene_.objects) {
            addNode(objectNode(object));
        }
        for (const scene::Camera& camera : scene_.cameras) {
            addNode(cameraNode(glb_, camera));
        }
        return glb_.pack();
    }

  private:
    json materialJson(const scene::Material& material) {
        const Vec3& c = material.reflectance;
        json m = {{"name", material.name},
                  {"doubleSided", material.doubleSided},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {c.r, c.g, c.b, material.alpha}},
                    {"metallicFactor", 0.0},
                    {"roughnessFactor", 1.0}}}};
        if (material.reflectanceTexture.isSet()) {
            m["pbrMetallicRoughness"]["baseColorTexture"] = textures_.info(material.reflectanceTexture);
        }
        if (material.normalTexture.isSet()) {
            m["normalTexture"] = textures_.info(material.normalTexture);
            m["normalTexture"]["scale"] = material.normalScale;
        }
        if (material.bumpTexture.isSet()) {
            m["extras"]["fluxwalk_bump"] = textures_.info(material.bumpTexture)["index"];
            m["extras"]["fluxwalk_bump_height"] = material.bumpHeight;
        }
        addAlphaAndEmission(glb_, textures_, material, m);
        return m;
    }

    json objectNode(const scene::Object& object) {
        const std::array<bool, 2> texcoords = usedTexcoords(scene_.materials[object.material]);
        json node = {{"name", object.name}};
        if (const auto exact = describeExactNode(*object.surface)) {
            node["extras"] = exact->extras;
            place(node, exact->worldFromNode);
            node["mesh"] =
                addMesh(object, standInOf(*object.surface, glm::inverse(exact->worldFromNode), texcoords));
        } else if (const auto* limit =
                       dynamic_cast<const surface::SubdivisionSurface*>(object.surface.get())) {
            const surface::ControlCage& cage = limit->cage();
            FLUXWALK_CHECK(cage.creases.empty());
            const bool isLoop = cage.scheme == surface::SubdivisionScheme::loop;
            node["extras"] = {{"fluxwalk_subdivision", isLoop ? "loop" : "catmullClark"}};
            node["mesh"] = addMesh(object, meshOf(cage, texcoords), true);
        } else {
            const auto* polygons = dynamic_cast<const surface::PolygonMesh*>(object.surface.get());
            FLUXWALK_CHECK(polygons != nullptr);
            node["mesh"] = addMesh(object, polygonsOf(*polygons, texcoords));
        }
        return node;
    }

    static void place(json& node, const base::Mat4d& m) {
        if (glm::dmat3(m) == glm::dmat3(1.0)) {
            node["translation"] = {m[3].x, m[3].y, m[3].z};
            return;
        }
        json& matrix = node["matrix"];
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                // Minus zero becomes zero.
                matrix.push_back(m[column][row] + 0.0);
            }
        }
    }

    std::size_t addMesh(const scene::Object& object, const Mesh& mesh, bool areFans = false) {
        json attributes = {{"POSITION", glb_.addVectors(mesh.positions, true)}};
        if (!mesh.normals.empty()) {
            attributes["NORMAL"] = glb_.addVectors(mesh.normals);
        }
        for (std::size_t set = 0; set < 2; ++set) {
            if (!mesh.texcoords[set].empty()) {
                attributes["TEXCOORD_" + std::to_string(set)] = glb_.addVectors(mesh.texcoords[set]);
            }
        }
        json primitive = {{"attributes", attributes},
                          {"indices", glb_.addIndices(mesh.triangles)},
                          {"material", object.material}};
        if (areFans) {
            useExtension(glb_, "FB_ngon_encoding");
            primitive["extensions"]["FB_ngon_encoding"] = json::object();
        }
        return glb_.append("meshes", {{"name", object.name}, {"primitives", json::array({primitive})}});
    }

    void addNode(json node) {
        const std::size_t index = glb_.append("nodes", std::move(node));
        glb_.root["scenes"][0]["nodes"].push_back(index);
    }

    const scene::Scene& scene_;
    GlbBuilder glb_;
    TextureWriter textures_{glb_, scene_};
};

}  // namespace

std::vector<std::uint8_t> packSceneGltf(const scene::Scene& scene) {
    FLUXWALK_CHECK(scene.lights.empty() && scene.sky == base::Rgb(0.0f));
    return SceneWriter(scene).write();
}

}  // namespace fluxwalk::io
