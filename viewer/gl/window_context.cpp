#include "viewer/gl/window_context.h"

#include <algorithm>

#include <GLFW/glfw3.h>

namespace fluxwalk::gl {
namespace {

[[noreturn]] void fail(const char* what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    std::string message = std::string("window: ") + what;
    if (reason != nullptr) {
        message += std::string(" (") + reason + ")";
    }
    throw ContextUnavailable(message);
}

/// The monitor that shows most of a rectangle; null where there is none at all.
GLFWmonitor* monitorOf(int x, int y, PixelSize size) {
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    long mostArea = 0;
    for (int i = 0; i < count; ++i) {
        int left = 0;
        int top = 0;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        if (mode == nullptr) {
            continue;
        }
        const long width = std::min(x + size.width, left + mode->width) - std::max(x, left);
        const long height = std::min(y + size.height, top + mode->height) - std::max(y, top);
        const long area = std::max(0L, width) * std::max(0L, height);
        if (area > mostArea) {
            best = monitors[i];
            mostArea = area;
        }
    }
    return best;
}

}  // namespace

WindowContext::WindowContext(const std::string& title, PixelSize size, bool visible) {
    if (glfwInit() != GLFW_TRUE) {
        fail("no display can be opened");
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    // Scenes are drawn into framebuffer objects; the window itself only receives the finished picture.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
    window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    try {
        if (window_ == nullptr) {
            fail("OpenGL 3.3 core is refused");
        }
        makeCurrent();
        load(&glfwGetProcAddress);
    } catch (...) {
        glfwTerminate();
        throw;
    }
    glfwSwapInterval(1);
}

WindowContext::~WindowContext() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void WindowContext::makeCurrent() {
    glfwMakeContextCurrent(window_);
}

PixelSize WindowContext::framebufferSize() const {
    PixelSize size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return size;
}

float WindowContext::contentScale() const {
    float x = 1.0f;
    float y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return x > 0.0f ? x : 1.0f;
}

bool WindowContext::isFullScreen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

void WindowContext::setFullScreen(bool full) {
    if (full == isFullScreen()) {
        return;
    }
    if (!full) {
        glfwSetWindowMonitor(window_, nullptr, place_.x, place_.y, place_.size.width, place_.size.height,
                             GLFW_DONT_CARE);
        return;
    }
    glfwGetWindowPos(window_, &place_.x, &place_.y);
    glfwGetWindowSize(window_, &place_.size.width, &place_.size.height);
    GLFWmonitor* const monitor = monitorOf(place_.x, place_.y, place_.size);
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode != nullptr) {
        glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
}

void WindowContext::swapBuffers() {
    glfwSwapBuffers(window_);
}

}  // namespace fluxwalk::gl
