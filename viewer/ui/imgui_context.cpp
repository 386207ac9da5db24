#include "viewer/ui/imgui_context.h"

#include <array>
#include <cmath>
#include <cstring>

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include "viewer/ui/font.h"
#include "viewer/ui/theme.h"

namespace fluxwalk::ui {
namespace {

void addFont(float scale) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    const float size = std::round(kFontSize * scale);
    if (kFontFile.empty()) {
        ImFontConfig config;
        config.SizePixels = size;
        fonts.AddFontDefault(&config);
        return;
    }
    // Latin, Greek, dashes and dots, superscripts, arrows, the minus and other signs.
    static constexpr std::array<ImWchar, 13> kRanges{0x20,   0xff,   0x370,  0x3ff,  0x2010, 0x2027, 0x2070,
                                                     0x209f, 0x2190, 0x2193, 0x2200, 0x2265, 0};
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 2;
    // The atlas frees what it is given with ImGui's allocator.
    void* copy = ImGui::MemAlloc(kFontFile.size());
    std::memcpy(copy, kFontFile.data(), kFontFile.size());
    fonts.AddFontFromMemoryTTF(copy, static_cast<int>(kFontFile.size()), size, &config, kRanges.data());
}

}  // namespace

ImguiContext::ImguiContext(float scale) : scale_(scale), context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    // No settings file in whatever folder the program was started from.
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    addFont(scale);
    applyTheme(scale);
}

ImguiContext::ImguiContext(float scale, GLFWwindow* window) : ImguiContext(scale) {
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    hasWindow_ = true;
}

void ImguiContext::rescale(float scale) {
    scale_ = scale;
    ImGui::GetIO().Fonts->Clear();
    addFont(scale);
    applyTheme(scale);
}

ImguiContext::~ImguiContext() {
    if (hasWindow_) {
        ImGui_ImplGlfw_Shutdown();
    }
    ImGui::DestroyContext(context_);
}

}  // namespace fluxwalk::ui
