#pragma once

#include <string>

#include "viewer/gl/context.h"
#include "viewer/gl/pixel_size.h"

struct GLFWwindow;

namespace fluxwalk::gl {

/// A window with its context, through GLFW. One at a time, on the main thread.
class WindowContext final : public Context {
  public:
    /// `size` in screen coordinates. Throws ContextUnavailable without a display or OpenGL 3.3.
    WindowContext(const std::string& title, PixelSize size, bool visible);
    ~WindowContext() override;

    std::string_view kind() const override { return "window"; }
    void makeCurrent() override;

    GLFWwindow* window() const { return window_; }
    PixelSize framebufferSize() const;
    /// Pixels per unit of a standard display (1 at 96 dpi).
    float contentScale() const;
    void swapBuffers();

    bool isFullScreen() const;
    /// Fills the monitor that shows most of the window, or gives the window its place back.
    void setFullScreen(bool full);

  private:
    GLFWwindow* window_ = nullptr;
    /// Of the window before it filled the screen, in screen coordinates.
    struct Place {
        int x = 0;
        int y = 0;
        PixelSize size;
    } place_;
};

}  // namespace fluxwalk::gl
