#include "core/solve/publisher.h"

#include "core/solve/link_errors.h"

namespace fluxwalk::solve {

std::shared_ptr<const Snapshot> Publisher::make(const Detail& detail, bool isFinished) {
    display_.refresh();
    shownAngle_ = problem_.options.displayAngle;
    return describe(detail, isFinished);
}

std::shared_ptr<const Snapshot> Publisher::makePart(const Detail& detail, double seconds) {
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                               std::chrono::duration<double>(seconds));
    return display_.refreshUntil(until) ? nullptr : describe(detail, false);
}

std::shared_ptr<const Snapshot> Publisher::describe(const Detail& detail, bool isFinished) {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->sequence = ++count_;
    snapshot->meshes = display_.meshes();
    snapshot->statistics = problem_.statistics;
    snapshot->finished = isFinished;
    snapshot->lighting = problem_.hierarchy.lighting();
    if (detail.elements || detail.residuals || detail.errors) {
        const std::vector<float> residuals =
            detail.residuals ? computeResiduals(problem_) : std::vector<float>{};
        const std::vector<float> errors = detail.errors ? computeLinkErrors(problem_) : std::vector<float>{};
        const std::vector<const display::CellTable*> tables = display_.tables();
        snapshot->elements.resize(snapshot->meshes.size());
        problem_.executor.forRange(tables.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                snapshot->elements[i] = std::make_shared<const MeshElements>(
                    describeElements(problem_, *snapshot->meshes[i], *tables[i], residuals, errors));
            }
        });
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
