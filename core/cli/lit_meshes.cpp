#include "core/cli/lit_meshes.h"

#include "core/base/photometry.h"
#include "core/cli/interrupt.h"
#include "core/cli/progress.h"

namespace fluxwalk::cli {

namespace {

/// Between looks at Ctrl-C.
constexpr std::chrono::milliseconds kSlice{100};

/// Gathers with progress until Ctrl-C.
class Gathering {
  public:
    Gathering(const Solved& solved, const OutputArguments& output)
        : gather_(solved.solver->problem()),
          displayAngle_(solved.solver->options().displayAngle * base::kPi / 180.0),
          progress_(stderr, chooseStyle(stderr, output.quiet)) {}

    void all() {
        while (!gather_.isDone() && !Interrupt::isRequested()) {
            gather_.work(std::nullopt, image::DisplayGather::Clock::now() + kSlice);
            report(gather_.doneCount(), gather_.leafCount());
        }
    }

    void seenFrom(const image::Look& look) {
        do {
            gather_.workOnSeen(look, image::DisplayGather::Clock::now() + kSlice);
            report(gather_.seenCount() - gather_.seenPending(), gather_.seenCount());
        } while (gather_.seenPending() > 0 && !Interrupt::isRequested());
    }

    scene::LitMeshes meshes() { return gather_.meshes(displayAngle_); }
    std::vector<const display::CellTable*> tables() const { return gather_.tables(); }

  private:
    void report(std::size_t done, std::size_t all) {
        progress_.update(static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(1, all)),
                         "gathering light for display");
    }

    const Interrupt interrupt_;
    image::DisplayGather gather_;
    double displayAngle_;
    Progress progress_;
};

bool isGathered(const Solved& solved) {
    return solved.solver->options().display == solve::DisplayLight::gathered;
}

}  // namespace

scene::LitMeshes makeLitMeshes(const Solved& solved, const OutputArguments& output) {
    if (!isGathered(solved)) {
        return solved.solver->litMeshes();
    }
    Gathering gathering(solved, output);
    gathering.all();
    return gathering.meshes();
}

solve::Snapshot showSolved(const Solved& solved, const solve::Detail& detail, const OutputArguments& output,
                           std::span<const image::Look> looks) {
    solve::Snapshot snapshot = *solved.solver->show(detail);
    // What is coloured by its residual or by errors shows no light, and only these meshes have them.
    if (!isGathered(solved) || detail.residuals || detail.errors) {
        return snapshot;
    }
    Gathering gathering(solved, output);
    for (const image::Look& look : looks) {
        gathering.seenFrom(look);
    }
    scene::LitMeshes meshes = gathering.meshes();
    solve::showOn(snapshot, std::move(meshes), solved.solver->problem(), gathering.tables());
    return snapshot;
}

}  // namespace fluxwalk::cli
