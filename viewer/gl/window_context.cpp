#include "viewer/gl/window_context.h"

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

void WindowContext::swapBuffers() {
    glfwSwapBuffers(window_);
}

}  // namespace fluxwalk::gl
