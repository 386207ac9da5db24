#pragma once

#include <memory>
#include <optional>

#include "viewer/gl/pixel_size.h"
#include "viewer/session/solver_session.h"
#include "viewer/ui/inspection.h"

namespace fluxwalk::app {

/// Follows the cursor, or a point that was pinned, and asks the solver about it.
class Inspector {
  public:
    /// What one frame knows.
    struct Frame {
        scene::Camera camera;
        gl::PixelSize size;          ///< of the window in the cursor's pixels
        base::Vec2d cursor{0.0};     ///< from the upper left
        bool isOverPanel = false;    ///< then the last point stays
        bool isClicked = false;      ///< pins what is under the cursor
        std::uint64_t solution = 0;  ///< number of the snapshot that is shown
    };

    /// Asks where something changed since the last answer.
    void update(session::SolverSession& session, const Frame& frame);
    void unpin() { pinned_.reset(); }
    bool isPinned() const { return pinned_.has_value(); }

    /// The newest answer; null where nothing is met or known yet.
    const image::Inspection* inspection() const;

  private:
    struct Question {
        rays::Ray ray;
        std::uint64_t solution = 0;
    };

    std::optional<rays::Ray> pinned_;
    std::optional<Question> asked_;
    std::shared_ptr<const session::Finding> finding_;
};

}  // namespace fluxwalk::app
