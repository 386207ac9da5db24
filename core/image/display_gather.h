#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "core/display/display_mesh.h"
#include "core/image/leaf_gather.h"
#include "core/scene/scene.h"

/// Display meshes with gathered light, made while they are looked at: what a camera sees comes first.
namespace fluxwalk::image {

/// Who looks: a camera and the ratio of its picture's width to its height.
struct Look {
    scene::Camera camera;
    double aspect = 16.0 / 9.0;
    /// Lines of sight across the picture, by which is found what is seen.
    std::uint32_t lines = 224;
};

struct DisplayGatherOptions {
    GatherRays rays{128, 128, 256};
    Sharpness sharpness;
};

/// Digest of what light is gathered from: the light of all nodes and the number of links.
std::uint64_t digestLight(const solve::Problem& problem);

/// Gathers all over the leaves of one solution. What comes out once all is gathered does not depend on the
/// number of threads or on who looked on the way.
class DisplayGather {
  public:
    using Clock = std::chrono::steady_clock;

    /// Keeps a reference to the problem, which must not change until this is gone.
    explicit DisplayGather(const solve::Problem& problem, const DisplayGatherOptions& options = {});
    ~DisplayGather();
    DisplayGather(const DisplayGather&) = delete;
    DisplayGather& operator=(const DisplayGather&) = delete;

    /// Gathers at leaves until the time has come or none is left, those first that are seen most of, then
    /// others near the camera.
    void work(const std::optional<Look>& look, Clock::time_point until);
    /// The same for no more than what is seen, so that what comes out is a function of the look alone, or of
    /// several that follow each other; until seenPending() is 0.
    void workOnSeen(const Look& look, Clock::time_point until);
    bool isDone() const { return done_ == leaves_.size(); }

    std::size_t leafCount() const { return leaves_.size(); }
    std::size_t doneCount() const { return done_; }
    /// Leaves that the last look saw, and how many of them are still to come.
    std::size_t seenCount() const { return seen_; }
    std::size_t seenPending() const;
    /// Points at which light was gathered.
    std::uint64_t pointCount() const;
    /// What the light of the leaves takes.
    std::uint64_t bytes() const;

    /// The meshes with what is gathered so far, in the order of the objects; makes those of objects anew that
    /// have more than the last time. `displayAngle` in radians (display::MeshOptions::curvatureAngle).
    scene::LitMeshes meshes(double displayAngle);
    /// Where the cells of these meshes are; until the next meshes().
    std::vector<const display::CellTable*> tables() const;
    /// Of one object; for reading values at points.
    const display::DisplayMeshes& meshesOf(std::uint32_t object) const { return objects_[object].meshes; }

  private:
    /// Leaves of one object, in a row.
    struct Object {
        std::unique_ptr<display::PatchTopology> topology;
        std::size_t first = 0;
        std::size_t count = 0;
        display::DisplayMeshes meshes;
        bool isOld = true;
    };
    struct LeafEntry {
        NodeId node = NodeId::none;
        std::uint32_t object = 0;
        std::unique_ptr<const display::LeafLight> light;
    };

    void listLeaves();
    void arrange(const Look& look);
    void gatherTo(std::size_t last, Clock::time_point until);
    void build(Object& object, std::uint32_t index, const display::MeshOptions& options) const;

    const solve::Problem& problem_;
    std::vector<Object> objects_;
    std::vector<LeafEntry> leaves_;
    std::vector<std::uint32_t> leafOf_;  ///< by node
    SourcePoints points_;
    std::vector<std::unique_ptr<LeafGather>> gathers_;  ///< one for each thread
    /// Leaves in the order in which they come, from `done_` on.
    std::vector<std::uint32_t> order_;
    std::size_t done_ = 0;
    std::size_t seen_ = 0;
    std::size_t seenEnd_ = 0;  ///< place in `order_` behind the last that was seen
    std::optional<Look> look_;
    Clock::time_point lookDue_{};  ///< from when on another look is taken over
    double displayAngle_ = -1.0;
};

}  // namespace fluxwalk::image
