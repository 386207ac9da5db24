#include "core/cli/lit_meshes.h"

#include "core/base/photometry.h"
#include "core/cli/interrupt.h"
#include "core/cli/progress.h"
#include "core/image/display_gather.h"

namespace fluxwalk::cli {

namespace {

/// Between looks at Ctrl-C.
constexpr std::chrono::milliseconds kSlice{100};

void gatherAll(image::DisplayGather& gather, const OutputArguments& output) {
    const Interrupt interrupt;
    Progress progress(stderr, chooseStyle(stderr, output.quiet));
    while (!gather.isDone() && !Interrupt::isRequested()) {
        gather.work(std::nullopt, image::DisplayGather::Clock::now() + kSlice);
        progress.update(static_cast<double>(gather.doneCount()) / static_cast<double>(gather.leafCount()),
                        "gathering light for display");
    }
}

double displayAngle(const Solved& solved) {
    return solved.solver->options().displayAngle * base::kPi / 180.0;
}

bool isGathered(const Solved& solved) {
    return solved.solver->options().display == solve::DisplayLight::gathered;
}

}  // namespace

scene::LitMeshes makeLitMeshes(const Solved& solved, const OutputArguments& output) {
    if (!isGathered(solved)) {
        return solved.solver->litMeshes();
    }
    image::DisplayGather gather(solved.solver->problem());
    gatherAll(gather, output);
    return gather.meshes(displayAngle(solved));
}

solve::Snapshot showSolved(const Solved& solved, const solve::Detail& detail, const OutputArguments& output) {
    solve::Snapshot snapshot = *solved.solver->show(detail);
    if (isGathered(solved)) {
        snapshot.meshes = makeLitMeshes(solved, output);
    }
    return snapshot;
}

}  // namespace fluxwalk::cli
