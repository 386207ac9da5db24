#include "core/display/display_mesh.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/display/balance.h"
#include "core/display/carry_values.h"
#include "core/display/mesh_parts.h"
#include "core/display/post_refine.h"
#include "core/display/triangulate.h"

namespace fluxwalk::display {

struct MeshLayout {
    std::vector<Cell> cells;
    MeshVertices vertices;
    /// Of a mesh that was cut further for the eye.
    CarryPlan plan;
    std::size_t plannedValues = 0;
    /// Of each vertex of the mesh: index of its value, cells' middles behind.
    std::vector<std::uint32_t> valueOf;

    MeshValues values(std::span<const Leaf> leaves) const {
        MeshValues values = reconstructValues(cells, vertices, leaves);
        return plan.samples.empty() ? std::move(values)
                                    : carryValues({cells, vertices, values}, plan, plannedValues);
    }
};

struct MeshWorkspace::Buffers {
    RefineBuffers refine;
    MeshVertices fine;
    scene::LitMesh mesh;
};

MeshWorkspace::MeshWorkspace() : buffers_(std::make_unique<Buffers>()) {}
MeshWorkspace::~MeshWorkspace() = default;

namespace {

void buildSide(const PatchTopology& topology, std::span<const Leaf> leaves, const MeshOptions& options,
               MeshWorkspace::Buffers& buffers, DisplayMeshes& out) {
    checkTiling(leaves);
    std::vector<Cell> cells;
    cells.reserve(leaves.size() + leaves.size() / 4);
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        cells.push_back(makeCell(topology, leaves[i].patch, leaves[i].path, i));
    }
    PointTable points(leaves.size() + leaves.size() / 4);
    balance(topology, points, cells);
    auto layout = std::make_shared<MeshLayout>();
    layout->vertices = collectVertices(topology, points, cells, options.creaseAngle);
    const RefinedCells& refined = refineForDisplay(
        topology, cells, layout->vertices,
        {options.curvatureAngle, options.rimRise, options.leastAngle, options.mostCellsForShape},
        buffers.refine);
    layout->cells = std::move(cells);
    const bool isRefined = !refined.cells.empty();
    MeshVertices& fine = buffers.fine;
    if (isRefined) {
        collectVertices(topology, refined, options.creaseAngle, fine);
        layout->plan = planCarrying(refined.cells, fine);
        layout->plannedValues = fine.pointOfValue.size();
    }
    const MeshVertices& vertices = isRefined ? fine : layout->vertices;
    const std::vector<Cell>& shown = isRefined ? refined.cells : layout->cells;
    const std::array<bool, 2> texcoords{options.texcoords[0] && topology.hasTexcoords(0),
                                        options.texcoords[1] && topology.hasTexcoords(1)};
    std::vector<std::uint32_t> firstTriangle = triangulate(topology, shown, vertices, layout->values(leaves),
                                                           texcoords, buffers.mesh, layout->valueOf);
    layout->valueOf.shrink_to_fit();
    out.tables.push_back(makeTable(shown, topology.surface().patchCount(), std::move(firstTriangle)));
    out.layouts.push_back(std::move(layout));
}

void clear(scene::LitMesh& mesh) {
    mesh.positions.clear();
    mesh.normals.clear();
    mesh.irradiance.clear();
    mesh.triangles.clear();
    for (std::vector<base::Vec2>& set : mesh.texcoords) {
        set.clear();
    }
}

/// The leaves of one object's sides in their order.
class SortedLeaves {
  public:
    explicit SortedLeaves(std::span<const Leaf> leaves) : leaves_(leaves) {
        if (!std::is_sorted(leaves.begin(), leaves.end(), comesBefore)) {
            sorted_.assign(leaves.begin(), leaves.end());
            std::sort(sorted_.begin(), sorted_.end(), comesBefore);
            leaves_ = sorted_;
        }
        const auto firstBack =
            std::partition_point(leaves_.begin(), leaves_.end(), [](const Leaf& leaf) { return !leaf.back; });
        frontCount_ = static_cast<std::size_t>(firstBack - leaves_.begin());
    }
    SortedLeaves(const SortedLeaves&) = delete;
    SortedLeaves& operator=(const SortedLeaves&) = delete;

    std::span<const Leaf> side(bool back) const {
        return back ? leaves_.subspan(frontCount_) : leaves_.first(frontCount_);
    }

  private:
    std::vector<Leaf> sorted_;
    std::span<const Leaf> leaves_;
    std::size_t frontCount_ = 0;
};

}  // namespace

std::uint64_t DisplayMeshes::layoutBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& layout : layouts) {
        const MeshVertices& v = layout->vertices;
        bytes += layout->cells.size() * (sizeof(Cell) + sizeof(CellVertices) + sizeof(Vec2d)) +
                 v.vertices.size() * sizeof(Vertex) + v.positions.size() * sizeof(Vec3d) +
                 (v.heads.size() + v.pointOfValue.size() + layout->valueOf.size()) * sizeof(std::uint32_t) +
                 layout->plan.samples.size() * sizeof(CarryPlan::Sample);
    }
    return bytes;
}

DisplayMeshes buildDisplayMeshes(const PatchTopology& topology, std::uint32_t object, std::uint32_t material,
                                 std::span<const Leaf> leaves, const MeshOptions& options,
                                 MeshWorkspace& workspace) {
    const SortedLeaves sorted(leaves);
    DisplayMeshes out;
    scene::LitMesh& mesh = workspace.buffers().mesh;
    mesh.object = object;
    mesh.material = material;
    for (const bool back : {false, true}) {
        const std::span<const Leaf> side = sorted.side(back);
        if (side.empty()) {
            continue;
        }
        clear(mesh);
        mesh.back = back;
        buildSide(topology, side, options, workspace.buffers(), out);
        // Meshes stay for long: the copy is as large as it must be.
        out.meshes.push_back(std::make_shared<scene::LitMesh>(mesh));
    }
    return out;
}

DisplayMeshes buildDisplayMeshes(const PatchTopology& topology, std::uint32_t object, std::uint32_t material,
                                 std::span<const Leaf> leaves, const MeshOptions& options) {
    MeshWorkspace workspace;
    return buildDisplayMeshes(topology, object, material, leaves, options, workspace);
}

DisplayMeshes revalueDisplayMeshes(const DisplayMeshes& from, std::span<const Leaf> leaves) {
    const SortedLeaves sorted(leaves);
    DisplayMeshes out = from;
    for (std::size_t i = 0; i < out.meshes.size(); ++i) {
        const MeshLayout& layout = *out.layouts[i];
        const MeshValues values = layout.values(sorted.side(out.meshes[i]->back));
        auto mesh = std::make_shared<scene::LitMesh>(*out.meshes[i]);
        FLUXWALK_CHECK_EQ(mesh->irradiance.size(), layout.valueOf.size());
        for (std::size_t v = 0; v < layout.valueOf.size(); ++v) {
            const std::size_t value = layout.valueOf[v];
            mesh->irradiance[v] = value < values.values.size() ? values.values[value]
                                                               : values.centers[value - values.values.size()];
        }
        out.meshes[i] = std::move(mesh);
    }
    return out;
}

}  // namespace fluxwalk::display
