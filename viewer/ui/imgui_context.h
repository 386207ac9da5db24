#pragma once

struct GLFWwindow;
struct ImGuiContext;

namespace fluxwalk::ui {

/// Dear ImGui with the theme and the font at a display's scale. One at a time; lives within the window if it
/// is attached to one.
class ImguiContext {
  public:
    /// Without a window (pictures, tests): the caller sets io.DisplaySize and the input.
    explicit ImguiContext(float scale);
    /// Fed by the window's events.
    ImguiContext(float scale, GLFWwindow* window);
    ~ImguiContext();
    ImguiContext(const ImguiContext&) = delete;
    ImguiContext& operator=(const ImguiContext&) = delete;

    float scale() const { return scale_; }
    /// Theme and font for another display; not within a frame. The renderer must take the glyphs anew.
    void rescale(float scale);

  private:
    float scale_;
    ImGuiContext* context_;
    bool hasWindow_ = false;
};

}  // namespace fluxwalk::ui
