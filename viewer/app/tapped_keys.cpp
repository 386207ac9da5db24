#include "viewer/app/tapped_keys.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

namespace fluxwalk::app {

TappedKeys::TappedKeys(GLFWwindow* window) : window_(window) {
    // A sticky key is told as pressed once, even if it was released meanwhile.
    glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE);
}

void TappedKeys::follow() {
    ImGuiIO& io = ImGui::GetIO();
    bool(&isDown)[512] = io.KeysDown;
    static_assert(GLFW_KEY_LAST < 512);
    for (const int key : shown_) {
        isDown[key] = false;
    }
    shown_.clear();
    for (int key = GLFW_KEY_SPACE; key <= GLFW_KEY_LAST; ++key) {
        // One that was held in the last frame is only told of its release.
        const bool wasDown = io.KeysDownDuration[key] >= 0.0f;
        if (glfwGetKey(window_, key) == GLFW_PRESS && !isDown[key] && !wasDown) {
            isDown[key] = true;
            shown_.push_back(key);
        }
    }
}

}  // namespace fluxwalk::app
