#pragma once

#include <chrono>
#include <memory>

#include "core/base/parallel.h"
#include "core/hierarchy/hierarchy.h"
#include "core/hierarchy/links.h"
#include "core/rays/ray_scene.h"
#include "core/solve/known_pairs.h"
#include "core/solve/options.h"
#include "core/solve/pending_pairs.h"
#include "core/solve/statistics.h"

/// What a solve works on; shared by the stages of this layer and by gathering at points.
namespace fluxwalk::solve {

using base::NodeId;
using base::Rgb;
using base::Vec3d;

/// Without cluster links all pairs of patches are linked: more patches than this would fill the memory.
inline constexpr std::size_t kMaxPairedPatches = 8000;

struct Problem {
    Problem(std::shared_ptr<const scene::Scene> what, const Options& chosen, unsigned threads)
        : scene(std::move(what)),
          options(chosen),
          executor(threads),
          rays(*scene, executor, chosen.rays, chosen.clusters),
          hierarchy(*scene, rays, executor, chosen.seed, chosen.clusters) {}

    std::shared_ptr<const scene::Scene> scene;
    Options options;
    base::Executor executor;
    rays::RayScene rays;
    hierarchy::Hierarchy hierarchy;
    hierarchy::LinkStore links;
    /// Pairs that refinement still has to split; empty where it is not at work.
    std::vector<Decision> pending;
    /// Elements' pairs that coarser links are made of without computing them again; kept where somebody may
    /// turn options while it solves.
    KnownPairs known;
    bool keepsKnown = false;
    Statistics statistics;
    /// Factor of each node on all its transfers, from row scaling; empty while it is off.
    std::vector<float> rowScale;

    /// Whether links may end at clusters.
    bool takesClusterLinks() const {
        return options.clusterLinks == ClusterLinks::automatic ? hierarchy.patches().size() > kManyPatches
                                                               : options.clusterLinks == ClusterLinks::on;
    }
    /// Links, and what may become one.
    std::size_t linkCount() const { return links.links.size() + pending.size(); }
    /// Smallest area in m2 that is still split.
    double minArea() const { return options.minArea > 0.0 ? options.minArea : 1e-7 * hierarchy.totalArea(); }
};

/// Adds its own life time to a stage's seconds.
class StageTimer {
  public:
    explicit StageTimer(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
    ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_;
};

}  // namespace fluxwalk::solve
