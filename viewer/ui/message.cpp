#include "viewer/ui/message.h"

#include <algorithm>

#include <imgui.h>

#include "viewer/ui/theme.h"

namespace fluxwalk::ui {

void drawMessage(const Message& message, float scale) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    // Long paths are wrapped, not cut.
    const float width = std::min(620.0f * scale, 0.9f * display.x);
    ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, 14.0f * scale), ImGuiCond_Always, ImVec2(0.5f, 0.0f));
    ImGui::SetNextWindowFocus();
    if (ImGui::Begin("##message", nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                         ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav)) {
        ImGui::PushTextWrapPos(width);
        ImGui::PushStyleColor(ImGuiCol_Text,
                              message.isError ? kWarning : ImGui::GetStyleColorVec4(ImGuiCol_Text));
        ImGui::TextUnformatted(message.text.c_str());
        ImGui::PopStyleColor();
        if (message.isError) {
            ImGui::TextColored(kTextDim, "Esc closes this.");
        }
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void drawWaiting(const std::string& text, float left) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 place(left + 0.5f * (display.x - left - size.x), 0.5f * (display.y - size.y));
    ImGui::GetBackgroundDrawList()->AddText(place, ImGui::GetColorU32(kTextDim), text.c_str());
}

}  // namespace fluxwalk::ui
