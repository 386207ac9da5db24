#include <filesystem>

#include <imgui.h>

#include "viewer/ui/places.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

void drawBookmarks(const Places& places, PlaceActions& actions) {
    beginRow("Bookmarks", "Views of this scene that you kept. Keys: B keeps one, 1 to 9 go there.");
    const std::string label = std::to_string(places.bookmarks.size()) + " kept";
    if (!ImGui::BeginCombo("##bookmarks", label.c_str())) {
        return;
    }
    actions.keeps = ImGui::Selectable("Keep this view");
    for (std::size_t i = 0; i < places.bookmarks.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::SmallButton("x")) {
            actions.forget = static_cast<int>(i);
        }
        explain("Delete");
        ImGui::SameLine();
        if (ImGui::Selectable(places.bookmarks[i].name.c_str())) {
            actions.bookmark = static_cast<int>(i);
        }
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

void drawCameras(const Places& places, PlaceActions& actions) {
    beginRow("Cameras", "Views that the scene brings along.");
    if (!ImGui::BeginCombo("##cameras", "go to ...")) {
        return;
    }
    for (std::size_t i = 0; i < places.cameras.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string& name = places.cameras[i].name;
        if (ImGui::Selectable(name.empty() ? "(unnamed)" : name.c_str())) {
            actions.camera = static_cast<int>(i);
        }
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

}  // namespace

PlaceActions drawPlaces(const Places& places) {
    PlaceActions actions;
    if (!places.cameras.empty()) {
        drawCameras(places, actions);
    }
    drawBookmarks(places, actions);
    beginRow("Path", "Records where you go, to a file, and plays it. Keys: R records, L plays.");
    actions.togglesRecording = ImGui::Button(places.isRecording ? "Stop##record" : "Record");
    if (places.hasPath && !places.isRecording) {
        ImGui::SameLine();
        actions.togglesPlaying = ImGui::Button(places.isPlaying ? "Stop##play" : "Play");
    }
    if (!places.recentFiles.empty()) {
        beginRow("Recent files",
                 "Scenes that were opened lately. A file dropped on the window is opened too.");
        if (ImGui::BeginCombo("##recent", "open ...")) {
            for (std::size_t i = 0; i < places.recentFiles.size(); ++i) {
                ImGui::PushID(static_cast<int>(i));
                const std::filesystem::path file(places.recentFiles[i]);
                if (ImGui::Selectable(file.filename().string().c_str())) {
                    actions.recentFile = static_cast<int>(i);
                }
                explain(places.recentFiles[i].c_str());
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
    }
    return actions;
}

}  // namespace fluxwalk::ui
