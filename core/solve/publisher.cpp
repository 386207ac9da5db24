#include "core/solve/publisher.h"

namespace fluxwalk::solve {

std::shared_ptr<const Snapshot> Publisher::make(const Detail& detail, bool isFinished) {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->sequence = ++count_;
    snapshot->meshes = display_.refresh();
    snapshot->statistics = problem_.statistics;
    snapshot->finished = isFinished;
    if (detail.elements || detail.residuals) {
        const std::vector<float> residuals =
            detail.residuals ? computeResiduals(problem_) : std::vector<float>{};
        const std::vector<const display::CellTable*> tables = display_.tables();
        for (std::size_t i = 0; i < snapshot->meshes.size(); ++i) {
            snapshot->elements.push_back(std::make_shared<const MeshElements>(
                describeElements(problem_, *snapshot->meshes[i], *tables[i], residuals)));
        }
    }
    if (detail.clusters) {
        if (clusters_ == nullptr) {
            clusters_ = std::make_shared<const std::vector<ClusterBox>>(listClusters(problem_));
        }
        snapshot->clusters = clusters_;
    }
    return snapshot;
}

}  // namespace fluxwalk::solve
