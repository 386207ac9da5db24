#pragma once

#include "core/base/vec.h"

struct GLFWwindow;

namespace fluxwalk::app {

/// Looking around with the mouse: while the right button is held, or with the cursor captured by the window.
class MouseLook {
  public:
    explicit MouseLook(GLFWwindow* window) : window_(window) {}

    bool isCaptured() const { return isCaptured_; }
    void setCaptured(bool captured);

    /// Turn to the right and upwards in radians since the last call. `overPanel`: a drag must not begin now.
    base::Vec2d update(bool overPanel);

  private:
    void setCursorHidden(bool hidden);

    GLFWwindow* window_;
    bool isCaptured_ = false;
    bool isDragging_ = false;
    bool isHidden_ = false;
    bool wasButtonDown_ = false;
    base::Vec2d last_{0.0};
};

}  // namespace fluxwalk::app
