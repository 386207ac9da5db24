#pragma once

#include <vector>

struct GLFWwindow;

namespace fluxwalk::app {

/// Dear ImGui looks at the keys once a frame: one that was pressed and released between two slow frames would
/// be lost. Such keys are shown to it as held for one frame.
class TappedKeys {
  public:
    explicit TappedKeys(GLFWwindow* window);

    /// To be called after the window's events and before ImGui::NewFrame().
    void follow();

  private:
    GLFWwindow* window_;
    /// Keys shown as held in the last frame.
    std::vector<int> shown_;
};

}  // namespace fluxwalk::app
