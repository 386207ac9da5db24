#include "core/display/triangulate.h"

#include <algorithm>

namespace fluxwalk::display {

namespace {

/// Squared lengths of diagonals that differ by more than this factor tell which one to cut along.
constexpr float kSheared = 1.2f;

class Triangulator {
  public:
    Triangulator(const PatchTopology& topology, const MeshVertices& vertices, const MeshValues& values,
                 const std::array<bool, 2>& texcoords, scene::LitMesh& mesh,
                 std::vector<std::uint32_t>& valueOf)
        : surface_(topology.surface()),
          vertices_(vertices),
          values_(values),
          texcoords_(texcoords),
          mesh_(mesh),
          valueOf_(valueOf),
          emitted_(vertices.vertices.size(), kNone) {}

    std::vector<std::uint32_t> run(std::span<const Cell> cells) {
        reserve(cells.size());
        std::vector<std::uint32_t> firstTriangle;
        firstTriangle.reserve(cells.size() + 1);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            firstTriangle.push_back(triangleCount());
            const CellVertices& own = vertices_.cells[i];
            if (own.isFan) {
                addFan(own, cells[i].patch, i);
            } else if (cells[i].cornerCount == 4) {
                addPair(own, cells[i]);
            } else {
                addTriangleCell(own);
            }
        }
        firstTriangle.push_back(triangleCount());
        return firstTriangle;
    }

  private:
    std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(mesh_.triangles.size() / 3); }

    void reserve(std::size_t cellCount) {
        const std::size_t vertexCount = vertices_.vertices.size() + cellCount;
        mesh_.positions.reserve(vertexCount);
        mesh_.normals.reserve(vertexCount);
        mesh_.irradiance.reserve(vertexCount);
        valueOf_.reserve(vertexCount);
        for (std::size_t set = 0; set < 2; ++set) {
            if (texcoords_[set]) {
                mesh_.texcoords[set].reserve(vertexCount);
            }
        }
        mesh_.triangles.reserve(12 * cellCount + cellCount);
    }

    std::uint32_t emit(const Vec3d& position, const Vec3& normal, const Rgb& irradiance, std::size_t value,
                       std::uint32_t patch, const Vec2d& uv) {
        const auto number = static_cast<std::uint32_t>(mesh_.positions.size());
        mesh_.positions.emplace_back(position);
        mesh_.normals.push_back(mesh_.back ? -normal : normal);
        mesh_.irradiance.push_back(irradiance);
        valueOf_.push_back(static_cast<std::uint32_t>(value));
        for (unsigned set = 0; set < 2; ++set) {
            if (texcoords_[set]) {
                mesh_.texcoords[set].emplace_back(surface_.texcoord(patch, uv, set));
            }
        }
        return number;
    }

    bool sameTexcoords(std::uint32_t emitted, const Vertex& vertex) const {
        for (unsigned set = 0; set < 2; ++set) {
            if (texcoords_[set] && mesh_.texcoords[set][emitted] !=
                                       base::Vec2(surface_.texcoord(vertex.patch, vertex.uv, set))) {
                return false;
            }
        }
        return true;
    }

    std::uint32_t indexOf(std::uint32_t number) {
        if (emitted_[number] != kNone) {
            return emitted_[number];
        }
        const Vertex& vertex = vertices_.vertices[number];
        for (std::uint32_t v = vertices_.heads[vertex.point]; v != kNone; v = vertices_.vertices[v].next) {
            const Vertex& other = vertices_.vertices[v];
            if (emitted_[v] != kNone && other.value == vertex.value && other.normal == vertex.normal &&
                sameTexcoords(emitted_[v], vertex)) {
                return emitted_[number] = emitted_[v];
            }
        }
        return emitted_[number] = emit(vertices_.positions[vertex.point], vertex.normal,
                                       values_.values[vertex.value], vertex.value, vertex.patch, vertex.uv);
    }

    // At a pole an edge has no length, and what hangs on it no area.
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::vector<Vec3>& p = mesh_.positions;
        if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) {
            return;
        }
        mesh_.triangles.push_back(a);
        mesh_.triangles.push_back(mesh_.back ? c : b);
        mesh_.triangles.push_back(mesh_.back ? b : c);
    }

    void addFan(const CellVertices& own, std::uint32_t patch, std::size_t cell) {
        std::array<std::uint32_t, 8> ring{};
        unsigned count = 0;
        for (unsigned k = 0; k < 4; ++k) {
            ring[count++] = indexOf(own.corners[k]);
            if (own.middles[k] != kNone) {
                ring[count++] = indexOf(own.middles[k]);
            }
        }
        const Vec2d& uv = vertices_.centers[cell];
        const CenterPoint at = centerPoint(cell, patch, uv);
        const std::uint32_t center = emit(at.position, Vec3(at.normal), values_.centers[cell],
                                          values_.values.size() + cell, patch, uv);
        for (unsigned k = 0; k < count; ++k) {
            addTriangle(center, ring[k], ring[k + 1 == count ? 0 : k + 1]);
        }
    }

    CenterPoint centerPoint(std::size_t cell, std::uint32_t patch, const Vec2d& uv) const {
        if (!vertices_.centerPoints.empty()) {
            return vertices_.centerPoints[cell];
        }
        const surface::SurfacePoint at = surface_.evaluate(patch, uv);
        return {at.position, at.normal};
    }

    // Two triangles, cut from the middle of the leaf outwards, as its own fan is; but along the shorter
    // diagonal where they differ much.
    void addPair(const CellVertices& own, const Cell& cell) {
        std::array<std::uint32_t, 4> corner{};
        for (unsigned k = 0; k < 4; ++k) {
            corner[k] = indexOf(own.corners[k]);
        }
        const auto length2 = [&](unsigned a, unsigned b) {
            const Vec3 between = mesh_.positions[corner[b]] - mesh_.positions[corner[a]];
            return glm::dot(between, between);
        };
        const float rising = length2(0, 2);
        const float falling = length2(1, 3);
        const bool isRising = std::max(rising, falling) > kSheared * std::min(rising, falling)
                                  ? rising < falling
                                  : liesOnRisingDiagonal(cell);
        const unsigned first = isRising ? 0 : 1;
        addTriangle(corner[first], corner[first + 1], corner[first + 2]);
        addTriangle(corner[first], corner[first + 2], corner[(first + 3) % 4]);
    }

    // Whether a part of a leaf is in its quarters at corners 0 and 2.
    static bool liesOnRisingDiagonal(const Cell& cell) {
        std::array<unsigned, 2> half{};
        std::array<bool, 2> isKnown{};
        for (unsigned level = 0; level < surface::pathLevel(cell.cuts); ++level) {
            const unsigned step = surface::pathStep(cell.cuts, level);
            const auto axis = static_cast<unsigned>(axisOfStep(step));
            if (!isKnown[axis]) {
                half[axis] = step & 1u;
                isKnown[axis] = true;
            }
        }
        return half[0] == half[1];
    }

    void addTriangleCell(const CellVertices& own) {
        std::array<std::uint32_t, 3> corner{};
        std::array<std::uint32_t, 3> middle{};
        unsigned hanging = 0;
        // The one side that differs from the other two.
        unsigned single = 0;
        for (unsigned k = 0; k < 3; ++k) {
            corner[k] = indexOf(own.corners[k]);
            middle[k] = own.middles[k] == kNone ? kNone : indexOf(own.middles[k]);
            hanging += middle[k] == kNone ? 0u : 1u;
        }
        for (unsigned k = 0; k < 3; ++k) {
            if ((middle[k] != kNone) == (hanging == 1)) {
                single = k;
            }
        }
        const unsigned next = (single + 1) % 3;
        const unsigned last = (single + 2) % 3;
        switch (hanging) {
            case 0:
                addTriangle(corner[0], corner[1], corner[2]);
                break;
            case 1:
                addTriangle(corner[single], middle[single], corner[last]);
                addTriangle(middle[single], corner[next], corner[last]);
                break;
            case 2:
                addTriangle(middle[next], corner[last], middle[last]);
                addTrapezoid(corner[single], corner[next], middle[next], middle[last]);
                break;
            default:
                addTriangle(corner[0], middle[0], middle[2]);
                addTriangle(middle[0], corner[1], middle[1]);
                addTriangle(middle[2], middle[1], corner[2]);
                addTriangle(middle[0], middle[1], middle[2]);
                break;
        }
    }

    // Along the shorter diagonal.
    void addTrapezoid(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        const Vec3 ac = mesh_.positions[c] - mesh_.positions[a];
        const Vec3 bd = mesh_.positions[d] - mesh_.positions[b];
        if (glm::dot(ac, ac) <= glm::dot(bd, bd)) {
            addTriangle(a, b, c);
            addTriangle(a, c, d);
        } else {
            addTriangle(b, c, d);
            addTriangle(b, d, a);
        }
    }

    const surface::Surface& surface_;
    const MeshVertices& vertices_;
    const MeshValues& values_;
    std::array<bool, 2> texcoords_;
    scene::LitMesh& mesh_;
    std::vector<std::uint32_t>& valueOf_;
    std::vector<std::uint32_t> emitted_;
};

}  // namespace

std::vector<std::uint32_t> triangulate(const PatchTopology& topology, std::span<const Cell> cells,
                                       const MeshVertices& vertices, const MeshValues& values,
                                       const std::array<bool, 2>& texcoords, scene::LitMesh& mesh,
                                       std::vector<std::uint32_t>& valueOf) {
    return Triangulator(topology, vertices, values, texcoords, mesh, valueOf).run(cells);
}

}  // namespace fluxwalk::display
