#include "viewer/app/inspector.h"

#include "viewer/app/sight.h"

namespace fluxwalk::app {
namespace {

bool isSame(const rays::Ray& a, const rays::Ray& b) {
    return a.origin == b.origin && a.direction == b.direction;
}

}  // namespace

void Inspector::update(session::SolverSession& session, const Frame& frame) {
    finding_ = session.finding();
    if (frame.size.width <= 0 || frame.size.height <= 0) {
        return;
    }
    const rays::Ray seen = rayThrough(frame.camera, frame.size, frame.cursor);
    if (frame.isClicked) {
        pinned_ = seen;
    }
    rays::Ray wanted = pinned_.value_or(seen);
    if (!pinned_ && frame.isOverPanel) {
        if (!asked_) {
            return;
        }
        wanted = asked_->ray;
    }
    const bool isNew = !asked_ || !isSame(asked_->ray, wanted) || asked_->solution != frame.solution;
    // One question at a time: one that is replaced while it waits would never be answered.
    const bool isAnswered = !asked_ || (finding_ && isSame(finding_->ray, asked_->ray));
    if (isNew && isAnswered) {
        asked_ = {wanted, frame.solution};
        session.ask(wanted);
    }
}

const image::Inspection* Inspector::inspection() const {
    return finding_ && finding_->inspection ? &*finding_->inspection : nullptr;
}

}  // namespace fluxwalk::app
