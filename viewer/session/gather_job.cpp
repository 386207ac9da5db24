#include "viewer/session/gather_job.h"

#include <algorithm>
#include <utility>

#include "core/base/photometry.h"

namespace fluxwalk::session {

namespace {

constexpr std::chrono::milliseconds kSlice{100};
/// Between snapshots, and at least so many times what making one takes.
constexpr std::chrono::milliseconds kInterval{250};
constexpr int kShare = 6;

bool showsNoLight(const solve::Snapshot& solved) {
    return std::any_of(solved.elements.begin(), solved.elements.end(), [](const auto& mesh) {
        return mesh != nullptr && (!mesh->residual.empty() || !mesh->error.empty());
    });
}

}  // namespace

GatherStep GatherJob::step(const solve::Solver& solver, const image::Look& look,
                           std::shared_ptr<const solve::Snapshot> solved) {
    if (std::exchange(isDoubtful_, false)) {
        const std::uint64_t digest = image::digestLight(solver.problem());
        if (digest != digest_) {
            gather_.reset();
            digest_ = digest;
        }
    }
    if (gather_ == nullptr) {
        gather_ = std::make_unique<image::DisplayGather>(solver.problem());
        shownOf_.reset();
        wasSeenPending_ = true;
    }
    const Clock::time_point start = Clock::now();
    gather_->work(look, start + kSlice);

    GatherStep step;
    step.progress = {gather_->leafCount(), gather_->doneCount(), gather_->seenPending()};
    const bool isNew = shownOf_ != solved || shownDone_ != gather_->doneCount();
    const bool isSeenDone = std::exchange(wasSeenPending_, gather_->seenPending() > 0) && !wasSeenPending_;
    if (isNew && (shownOf_ != solved || isSeenDone || gather_->isDone() || Clock::now() >= due_)) {
        const Clock::time_point begin = Clock::now();
        shown_ = showsNoLight(*solved) ? solved : show(solver, *solved);
        shownOf_ = std::move(solved);
        shownDone_ = gather_->doneCount();
        const Clock::time_point now = Clock::now();
        due_ = now + std::max<Clock::duration>(kInterval, kShare * (now - begin));
    }
    step.snapshot = shown_;
    step.isFinished = gather_->isDone();
    return step;
}

std::shared_ptr<const solve::Snapshot> GatherJob::show(const solve::Solver& solver,
                                                       const solve::Snapshot& solved) {
    auto snapshot = std::make_shared<solve::Snapshot>(solved);
    scene::LitMeshes meshes = gather_->meshes(solver.options().displayAngle * base::kPi / 180.0);
    solve::showOn(*snapshot, std::move(meshes), solver.problem(), gather_->tables());
    snapshot->finished = gather_->isDone();
    return snapshot;
}

}  // namespace fluxwalk::session
