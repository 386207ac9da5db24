#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/display/leaf.h"
#include "core/display/patch_topology.h"
#include "core/scene/lit_mesh.h"
#include "core/surface/region.h"

/// From leaves of the solution to arrays for the GPU: balanced, without T-vertices, smooth within an object's
/// creases.
namespace fluxwalk::display {

struct MeshOptions {
    /// Vertex values are not averaged across edges whose faces' normals differ by more (radians).
    double creaseAngle = 0.5236;
    /// Curved cells are refined until their normals lie within this angle of a common axis (radians).
    double curvatureAngle = 0.0698;
    /// Rise over their chords of free curved edges, where other objects may meet this one: metres.
    double rimRise = 2e-4;
    /// Quads longer than wide are cut into strips until no triangle has a smaller angle (radians), but at
    /// poles; 0 for never.
    double leastAngle = 0.2705;
    /// Once a side of an object has so many cells for each patch, none is cut for its shape: thin wires would
    /// take hundreds of thousands.
    std::size_t mostCellsForShape = 1u << 10;
    /// Which sets of texture coordinates to fill; those of a surface that has none stay empty.
    std::array<bool, 2> texcoords{true, true};
};

/// What part of its patch a display leaf is: a path of splits and, for quads, of cuts in two below it
/// (Cell::cuts).
struct CellPlace {
    surface::Path path = surface::kRootPath;
    surface::Path cuts = surface::kRootPath;
};

/// Where each display leaf's triangles are in its mesh (DisplayLookup reads it). Display leaves are ordered
/// by patch and, within it, depth-first.
struct CellTable {
    std::vector<std::uint32_t> firstCell;      ///< of each patch, then the number of cells
    std::vector<CellPlace> places;             ///< of each cell
    std::vector<std::uint32_t> firstTriangle;  ///< of each cell, then the number of triangles
};

/// What a mesh's values are made of, apart from the leaves' irradiance.
struct MeshLayout;

/// The meshes of one object, front before back; a side without leaves has none.
struct DisplayMeshes {
    scene::LitMeshes meshes;
    std::vector<CellTable> tables;  ///< parallel to the meshes, as are the layouts
    std::vector<std::shared_ptr<const MeshLayout>> layouts;

    /// What the layouts take.
    std::uint64_t layoutBytes() const;
};

/// Memory that meshes are made in, to be used again for the next object: most of the time of first using it
/// is the system's. Of one thread.
class MeshWorkspace {
  public:
    MeshWorkspace();
    ~MeshWorkspace();
    MeshWorkspace(const MeshWorkspace&) = delete;
    MeshWorkspace& operator=(const MeshWorkspace&) = delete;

    struct Buffers;
    Buffers& buffers() { return *buffers_; }

  private:
    std::unique_ptr<Buffers> buffers_;
};

/// Triangulates the leaves of one object, given in any order; they must tile each patch and side that they
/// touch. `object` and `material` are copied into the result. The result does not depend on the leaves'
/// order. Not parallel; objects may be built at the same time.
DisplayMeshes buildDisplayMeshes(const PatchTopology& topology, std::uint32_t object, std::uint32_t material,
                                 std::span<const Leaf> leaves, const MeshOptions& options,
                                 MeshWorkspace& workspace);
/// In memory of its own.
DisplayMeshes buildDisplayMeshes(const PatchTopology& topology, std::uint32_t object, std::uint32_t material,
                                 std::span<const Leaf> leaves, const MeshOptions& options);

/// The same meshes for leaves that differ in nothing but their irradiance, to the same bits and in a part of
/// the time.
DisplayMeshes revalueDisplayMeshes(const DisplayMeshes& from, std::span<const Leaf> leaves);

}  // namespace fluxwalk::display
