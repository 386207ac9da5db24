#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/hierarchy/patch_table.h"
#include "core/hierarchy/reach.h"
#include "core/rays/patch_tree.h"
#include "core/scene/lighting.h"
#include "core/scene/texture.h"
#include "core/surface/region.h"

/// One tree over everything that exchanges light: clusters above patches, elements below, light sources
/// without area beside.
namespace fluxwalk::hierarchy {

using base::NodeId;
using base::Rgb;
using base::Vec3;
using base::Vec3d;

enum class NodeKind : std::uint8_t { cluster, element, light, sky };

/// Where an element sits on its object. Names, not indices: equal in every run.
struct ElementName {
    std::uint32_t object = 0;
    std::uint32_t patch = 0;
    bool back = false;
    surface::Path path = surface::kRootPath;
};

/// What transport asks of a node's shape.
struct Shape {
    Vec3 center{};  ///< of the bounding sphere
    float radius = 0.0f;
    Vec3 axis{0, 0, 1};      ///< of the cone of normals, towards the side that takes part
    float halfAngle = 0.0f;  ///< radians
    float area = 0.0f;       ///< true area in m2 (clusters: sum)
    /// Part of the area outside other solids and not in a gap that is narrow at this element's scale
    /// (exposure.h), as 4 x 4 cells of the element's region: bit 4 j + i is the cell with s in
    /// [i/4, (i+1)/4).
    std::uint16_t exposedCells = 0xffff;
    /// Of all places where the cells were looked at, those that are exposed: their part of the area.
    static constexpr std::uint8_t kPlaces = 80;
    std::uint8_t exposedPlaces = kPlaces;
    /// Those of them that are exposed at the parent's scale too: they share in what the parent exchanges.
    std::uint8_t placesOfParent = kPlaces;
    /// Part of the area that receives and sends: from the places (leaves) or the children (area means).
    float exposed = 1.0f;
    std::uint8_t cornerCount = 0;                     ///< elements: 3 or 4
    surface::Split split = surface::Split::quarters;  ///< how an element is cut into its children
    bool isPlanar = true;
    bool isCovered = false;  ///< some cells lie in such a gap: dark, but not inside a solid
    /// Elements: corners on the surface, counter-clockwise seen from the side that takes part.
    std::array<Vec3, 4> corners{};

    float exposedArea() const { return area * exposed; }
    /// Area of the exposed cells, on which light is sampled (clusters: the exposed area). Somewhat more
    /// than the exposed area, as rays find what is hidden in them; unlike that, refinement does not change
    /// it.
    float sampledArea() const {
        return cornerCount == 0 ? exposedArea()
                                : area * static_cast<float>(std::popcount(exposedCells)) / 16.0f;
    }
    /// As `exposedArea`, but by an element's own places alone: refinement does not change it.
    float ownArea() const {
        return cornerCount == 0 ? exposedArea() : area * static_cast<float>(exposedPlaces) / kPlaces;
    }
    /// Of the exposed area, the part that the parent's links reach.
    float partOfParent() const {
        return exposedPlaces > 0 ? static_cast<float>(placesOfParent) / static_cast<float>(exposedPlaces)
                                 : 0.0f;
    }
    /// Area by which an element counts in its parent: push and pull weigh with it.
    float areaInParent() const { return exposedArea() * partOfParent(); }
};

/// Axis-parallel box.
struct Extent {
    Vec3 lower{};
    Vec3 upper{};
};

/// Light of a node. Elements and clusters: means over the exposed area. Light sources: `radiosity` is
/// intensity (cd), illuminance of a directional light (lux) or the sky's illuminance on a free horizontal
/// plane (lux).
struct Light {
    Rgb radiosity{0.0f};   ///< lm/m2
    Rgb irradiance{0.0f};  ///< mean over the exposed area, lux
    Rgb reflectance{0.0f};
    Rgb emission{0.0f};  ///< lm/m2
    /// Radiosity over an element: mean + slopeS local.x + slopeT local.y (local_frame.h).
    Rgb slopeS{0.0f};
    Rgb slopeT{0.0f};
    /// Largest deviation of the channel mean from that, lm/m2; clusters, whose slopes are 0: from the mean.
    float residual = 0.0f;

    /// Half the range of the channel-mean radiosity, at most, lm/m2.
    float range() const;
};

class Hierarchy {
  public:
    /// Builds patches of the reached sides and, by `builder`, the cluster tree above them. Shares the tree of
    /// `rays` for shafts where that has one.
    Hierarchy(const scene::Scene& scene, const rays::RayScene& rays, const base::Executor& executor,
              std::uint64_t seed, rays::TreeBuilder builder = rays::TreeBuilder::sah);

    std::size_t nodeCount() const { return parent_.size(); }
    std::size_t leafCount() const { return leafCount_; }
    /// Bytes held for each node.
    static std::size_t bytesPerNode();

    NodeId root() const { return root_; }
    NodeKind kind(NodeId id) const { return kind_[index(id)]; }
    NodeId parent(NodeId id) const { return parent_[index(id)]; }
    bool isLeaf(NodeId id) const { return firstChild_[index(id)] == NodeId::none; }
    /// Children are one block: 2 of a cluster, 4 of an element.
    NodeId child(NodeId id, unsigned i) const { return NodeId{index(firstChild_[index(id)]) + i}; }
    unsigned childCount(NodeId id) const { return kind(id) == NodeKind::cluster ? 2 : 4; }

    ElementName name(NodeId id) const;
    /// Hash of the name (clusters: place in the tree): the key of everything random about this node.
    std::uint64_t key(NodeId id) const;
    surface::Region region(NodeId id) const;
    const surface::Surface& surfaceOf(NodeId id) const;
    /// Index into Scene::lights.
    std::uint32_t lightIndex(NodeId id) const { return object_[index(id)]; }

    const Shape& shape(NodeId id) const { return shape_[index(id)]; }
    const Light& light(NodeId id) const { return light_[index(id)]; }
    Light& light(NodeId id) { return light_[index(id)]; }

    /// Nodes at the top of the elements (one for each patch and reached side), in depth-first order of the
    /// clusters.
    std::span<const NodeId> patches() const { return patches_; }
    /// Those below a cluster, or the patch itself: neighbours in patches().
    std::span<const NodeId> patchesBelow(NodeId id) const {
        const auto [begin, end] = patchRange_[index(id)];
        return {patches_.data() + begin, end - begin};
    }
    /// Index into patches() of the first of them.
    std::uint32_t firstPatchBelow(NodeId id) const { return patchRange_[index(id)][0]; }
    const PatchTable& patchTable() const { return patchTable_; }
    /// Sampled area in m2 of the first `count` patches.
    double sampledAreaBefore(std::size_t count) const { return areaBefore_[count]; }
    /// Box about a cluster or patch.
    const Extent& extent(NodeId id) const { return extent_[index(id)]; }
    /// Whether walks of light joined all that is below an element or cluster (ReachedSides::rooms): otherwise
    /// closed walls may lie between them.
    bool isInOneRoom(NodeId id) const { return kind(id) != NodeKind::cluster || room_[index(id)] != kNoRoom; }
    /// Whether a cluster has both patches that emit and others: light is not shared among such unlike ones.
    bool isPartlyEmitting(NodeId id) const { return emitting_[base::index(id)] == 3; }
    /// Light sources without area, and the sky.
    std::span<const NodeId> sources() const { return sources_; }
    /// Patch node of a patch and side, or NodeId::none where light does not reach it.
    NodeId patchNode(std::uint32_t object, std::uint32_t patch, bool back) const;

    /// Whether a leaf may be split: an element larger than `minArea` (m2) above the depth limit.
    bool canSplit(NodeId id, double minArea) const;
    /// Cuts leaves in four (Shape::split). Children take over their parent's irradiance. Ids must be distinct
    /// leaves; the order fixes the new ids.
    void split(std::span<const NodeId> leaves, const base::Executor& executor);
    /// Takes back the splitting of elements where neither the children nor anything below them is needed
    /// (`isNeeded` by node). Patches, clusters and sources stay where they are. Returns the new place of
    /// each node, NodeId::none where it is gone.
    std::vector<NodeId> prune(const std::vector<std::uint8_t>& isNeeded);
    /// Means and deviations of the clusters' light, from their patches.
    void pullClusters();
    /// Turns the lights: emission of all nodes, and their radiosity as far as it is emission. What they
    /// reflect is that of before until it is gathered anew.
    void relight(const scene::Lighting& lighting, const base::Executor& executor);
    /// The lights as they are turned; as the scene says where they never were.
    const scene::Lighting& lighting() const { return lighting_; }

    const ReachedSides& reached() const { return reached_; }
    const scene::Scene& scene() const { return *scene_; }
    const scene::TextureSet& textures() const { return textures_; }
    /// Boxes of all patches of all objects, reached or not, for shafts; `item` indexes shaftItems().
    const rays::SpatialTree& shaftTree() const { return shaft_->tree; }
    std::span<const rays::PatchRef> shaftItems() const { return shaft_->items; }
    /// Total area of the reached sides in m2, hidden parts left out.
    double totalArea() const { return totalArea_; }

  private:
    void resize(std::size_t count);
    void shapeElement(NodeId id, const surface::Region& region);
    Rgb emissionOf(NodeId id, const surface::Region& region) const;
    void refreshExposure(NodeId id);
    void shapePatches(const base::Executor& executor);
    void shapeClusters();
    void markClusters();
    void orderPatches();
    void tabulatePatches();
    void sumAreas();

    const scene::Scene* scene_;
    const rays::RayScene* rays_;
    scene::TextureSet textures_;
    scene::Lighting lighting_;
    ReachedSides reached_;
    std::uint64_t seed_;
    std::shared_ptr<const rays::PatchTree> shaft_;

    std::vector<NodeId> parent_;
    std::vector<NodeId> firstChild_;
    std::vector<NodeKind> kind_;
    std::vector<std::uint32_t> object_;
    std::vector<std::uint32_t> patchSide_;  ///< patch * 2 + back
    std::vector<surface::Path> path_;
    std::vector<Shape> shape_;
    std::vector<Light> light_;
    std::vector<std::uint8_t>
        mayHide_;  ///< other geometry touches this element: its exposure must be sampled

    std::vector<NodeId> patches_;
    std::vector<std::array<std::uint32_t, 2>> patchRange_;  ///< of clusters and patches, in patches_
    std::vector<double> areaBefore_;
    PatchTable patchTable_;
    std::vector<Extent> extent_;  ///< of clusters and patches
    static constexpr std::uint32_t kNoRoom = 0xffffffffu;
    std::vector<std::uint8_t> emitting_;  ///< of clusters and patches: 1 emitting, 2 others, 3 both
    std::vector<std::uint32_t> room_;     ///< of clusters and patches; kNoRoom: of several
    std::vector<NodeId> sources_;
    std::vector<std::array<NodeId, 2>> patchNodes_;  ///< by shaft item: front, back
    NodeId root_ = NodeId::none;
    std::size_t leafCount_ = 0;
    double totalArea_ = 0.0;
};

}  // namespace fluxwalk::hierarchy
