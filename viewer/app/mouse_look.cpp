#include "viewer/app/mouse_look.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

namespace fluxwalk::app {
namespace {

/// A tenth of a degree for each unit of mouse movement.
constexpr double kRadiansPerUnit = 0.0017453;

}  // namespace

void MouseLook::setCaptured(bool captured) {
    isCaptured_ = captured;
}

void MouseLook::setCursorHidden(bool hidden) {
    if (hidden == isHidden_) {
        return;
    }
    isHidden_ = hidden;
    // A disabled cursor moves without end and comes back where it was.
    glfwSetInputMode(window_, GLFW_CURSOR, hidden ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags =
        hidden ? io.ConfigFlags | ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange
               : io.ConfigFlags & ~(ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange);
    glfwGetCursorPos(window_, &last_.x, &last_.y);
}

base::Vec2d MouseLook::update(bool overPanel) {
    const bool isButtonDown = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
    if (isButtonDown && !wasButtonDown_ && !overPanel) {
        isDragging_ = true;
    }
    if (!isButtonDown) {
        isDragging_ = false;
    }
    wasButtonDown_ = isButtonDown;
    setCursorHidden(isCaptured_ || isDragging_);
    if (!isHidden_) {
        return base::Vec2d(0.0);
    }
    base::Vec2d now(0.0);
    glfwGetCursorPos(window_, &now.x, &now.y);
    const base::Vec2d moved = now - last_;
    last_ = now;
    return {moved.x * kRadiansPerUnit, -moved.y * kRadiansPerUnit};
}

}  // namespace fluxwalk::app
