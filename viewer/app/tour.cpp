#include "viewer/app/tour.h"

#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>
#include <imgui.h>

#include "core/base/photometry.h"
#include "viewer/app/sight.h"
#include "viewer/app/state_folder.h"
#include "viewer/ui/keys.h"
#include "viewer/ui/orbit.h"

namespace fluxwalk::app {
namespace {

using base::Vec3d;

constexpr double kMessageSeconds = 5.0;
constexpr double kErrorSeconds = 60.0;
constexpr double kRadiansPerPixel = 0.005;
/// Distance for each notch of the wheel.
constexpr double kDolly = 0.87;
/// Seconds in which the camera goes to an object.
constexpr double kGlide = 0.6;
/// Part of the way to a new place that is used where something stands before it.
constexpr double kFree = 0.9;
constexpr double kNarrowest = 15.0 * base::kPi / 180.0;
constexpr double kWidest = 110.0 * base::kPi / 180.0;
constexpr double kFovStep = 1.05;

gl::PixelSize displaySize() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    return {static_cast<int>(size.x), static_cast<int>(size.y)};
}

}  // namespace

Tour::Tour(gl::WindowContext& window, const Exhibit& exhibit, SceneOpener& opener)
    : window_(window),
      opener_(opener),
      cameras_(exhibit.scene->cameras),
      solid_(exhibit.solid),
      book_(findStateFolder()),
      path_(exhibit.path),
      wantsToPlay_(!exhibit.path.empty()) {
    try {
        book_.readRecentFiles();
        if (!exhibit.file.empty()) {
            book_.remember(exhibit.file);
        }
    } catch (const base::FileError& error) {
        complain(error.what(), glfwGetTime());
    } catch (const base::UsageError&) {
        // Nowhere to remember it; bookmarks and paths will say so.
    }
}

void Tour::say(const std::string& text, double now) {
    message_ = ui::Message{text, false, now + kMessageSeconds};
}

void Tour::complain(const std::string& text, double now) {
    message_ = ui::Message{text, true, now + kErrorSeconds};
}

bool Tour::lead(const Frame& frame) {
    followOpener(frame.now);
    if (!book_.hasScene()) {
        if (const auto hash = frame.floor.sceneHash()) {
            try {
                book_.openScene(*hash);
            } catch (const base::FileError& error) {
                complain(error.what(), frame.now);
            }
        }
    }
    if (std::exchange(wantsToPlay_, false)) {
        playback_.begin(path_, frame.now);
    }
    if (frame.isSteered) {
        playback_.stop();
    }
    bool leads = takeKeys(frame);
    leads |= orbit(frame);
    if (playback_.isPlaying()) {
        frame.walker.jumpTo(playback_.follow(frame.now));
        leads = true;
    }
    return leads;
}

void Tour::followOpener(double now) {
    if (const auto error = opener_.takeError()) {
        complain(*error, now);
    } else if (!opener_.opening().empty()) {
        message_ = ui::Message{"Opening " + opener_.opening() + " ...", false, now + 0.5};
    }
}

bool Tour::takeKeys(const Frame& frame) {
    if (ImGui::GetIO().WantTextInput) {
        return false;
    }
    const auto isPressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    if (isPressed(GLFW_KEY_F1)) {
        isHelpOpen_ = !isHelpOpen_;
    }
    if (isPressed(GLFW_KEY_ESCAPE)) {
        isHelpOpen_ = false;
        message_.reset();
    }
    if (isPressed(GLFW_KEY_F11)) {
        window_.setFullScreen(!window_.isFullScreen());
    }
    if (isPressed(GLFW_KEY_B)) {
        keep(frame);
    }
    if (isPressed(GLFW_KEY_R)) {
        toggleRecording(frame);
    }
    if (isPressed(GLFW_KEY_L)) {
        togglePlaying(frame);
    }
    if (isPressed(GLFW_KEY_G)) {
        focus(frame);
    }
    bool changed = changeFov(frame.walker);
    for (int digit = 1; digit <= 9; ++digit) {
        if (isPressed(GLFW_KEY_0 + digit)) {
            changed |= goToBookmark(static_cast<std::size_t>(digit - 1), frame);
        }
    }
    return changed;
}

bool Tour::changeFov(ui::Walker& walker) {
    const double before = walker.verticalFov();
    double fov = before;
    if (ImGui::IsKeyPressed(GLFW_KEY_EQUAL) || ImGui::IsKeyPressed(GLFW_KEY_KP_ADD)) {
        fov = std::max(std::min(fov, kNarrowest), fov / kFovStep);
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_MINUS) || ImGui::IsKeyPressed(GLFW_KEY_KP_SUBTRACT)) {
        fov = std::min(std::max(fov, kWidest), fov * kFovStep);
    }
    walker.setVerticalFov(fov);
    return fov != before;
}

std::optional<Floor::Met> Tour::pick(const Frame& frame) const {
    const gl::PixelSize size = displaySize();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const base::Vec2d cursor = frame.isCaptured
                                   ? 0.5 * base::Vec2d(size.width, size.height)
                                   : base::Vec2d(static_cast<double>(mouse.x), static_cast<double>(mouse.y));
    return frame.floor.meet(rayThrough(frame.walker.camera(), size, cursor));
}

bool Tour::orbit(const Frame& frame) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool isDown = io.MouseDown[2] || (io.MouseDown[0] && io.KeyAlt);
    if (!isDown || frame.isCaptured) {
        pivot_.reset();
        return false;
    }
    if (!pivot_) {
        const bool begins = ImGui::IsMouseClicked(2) || ImGui::IsMouseClicked(0);
        if (!begins || io.WantCaptureMouse) {
            return false;
        }
        const auto met = pick(frame);
        pivot_ = met ? met->point : solid_->bounds().center();
        playback_.stop();
        frame.walker.movement = ui::Movement::fly;
    }
    scene::Camera camera = frame.walker.camera();
    if (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f) {
        camera = ui::orbit(camera, *pivot_, static_cast<double>(io.MouseDelta.x) * kRadiansPerPixel,
                           -static_cast<double>(io.MouseDelta.y) * kRadiansPerPixel);
    }
    if (io.MouseWheel != 0.0f) {
        camera = ui::dolly(camera, *pivot_, std::pow(kDolly, static_cast<double>(io.MouseWheel)),
                           1e-3 * solid_->bounds().diagonal());
    }
    if (scene::findFault(camera)) {
        return false;
    }
    frame.walker.jumpTo(camera);
    return true;
}

void Tour::focus(const Frame& frame) {
    const auto met = pick(frame);
    if (!met) {
        say("There is no object under the cursor to go to.", frame.now);
        return;
    }
    const scene::Camera& from = frame.walker.camera();
    scene::Camera to = ui::lookAtWhole(from, met->bounds);
    // Within a room the whole of it cannot be seen: as far back as there is space.
    const Vec3d way = to.position - met->point;
    const Vec3d towardsEye = from.position - met->point;
    const Vec3d lifted = met->point + 1e-4 * towardsEye;
    if (const auto wall =
            frame.floor.meet({base::Vec3(lifted), 0.0f, base::Vec3(to.position - lifted), 1.0f})) {
        to.position = met->point + kFree * (wall->point - met->point);
        if (glm::length(to.position - met->point) < 0.1 * glm::length(way)) {
            to.position = met->point + 0.5 * towardsEye;
        }
        to.forward = glm::normalize(met->point - to.position);
    }
    if (scene::findFault(to)) {
        return;
    }
    frame.walker.movement = ui::Movement::fly;
    playback_.begin({{0.0, from}, {kGlide, to}}, frame.now);
}

void Tour::toggleRecording(const Frame& frame) {
    if (!recorder_.isRecording()) {
        playback_.stop();
        recorder_.begin(frame.walker.camera(), frame.now);
        say("Recording the path: R ends it.", frame.now);
        return;
    }
    path_ = recorder_.end(frame.walker.camera(), frame.now);
    try {
        say("The path is in " + book_.savePath(path_).string() + ". L plays it.", frame.now);
    } catch (const std::runtime_error& error) {
        complain(error.what(), frame.now);
    }
}

void Tour::togglePlaying(const Frame& frame) {
    if (playback_.isPlaying()) {
        playback_.stop();
    } else if (path_.empty() || recorder_.isRecording()) {
        say(recorder_.isRecording() ? "The path is still being recorded: R ends it."
                                    : "There is no path to play: R records one.",
            frame.now);
    } else {
        playback_.begin(path_, frame.now);
    }
}

void Tour::keep(const Frame& frame) {
    if (!book_.hasScene()) {
        say("The scene is still being read; try again.", frame.now);
        return;
    }
    try {
        const std::string name = book_.keep(frame.walker.camera());
        const std::size_t number = book_.bookmarks().size();
        say("Kept as " + name + (number <= 9 ? ": key " + std::to_string(number) + " comes back here." : "."),
            frame.now);
    } catch (const std::runtime_error& error) {
        complain(error.what(), frame.now);
    }
}

bool Tour::goToBookmark(std::size_t bookmark, const Frame& frame) {
    if (bookmark >= book_.bookmarks().size()) {
        say("There is no bookmark " + std::to_string(bookmark + 1) + ": B keeps one.", frame.now);
        return false;
    }
    goTo(book_.bookmarks()[bookmark], frame.walker, frame.now);
    return true;
}

void Tour::goTo(const scene::Camera& camera, ui::Walker& walker, double now) {
    if (const auto fault = scene::findFault(camera)) {
        complain("The camera " + camera.name + " " + *fault + ".", now);
        return;
    }
    playback_.stop();
    walker.jumpTo(camera);
}

ui::Places Tour::places() const {
    ui::Places places;
    places.cameras = cameras_;
    places.bookmarks = book_.bookmarks();
    places.recentFiles = book_.recentFiles();
    places.isRecording = recorder_.isRecording();
    places.isPlaying = playback_.isPlaying();
    places.hasPath = !path_.empty();
    return places;
}

bool Tour::act(const ui::PlaceActions& actions, const Frame& frame) {
    if (actions.keeps) {
        keep(frame);
    }
    if (actions.togglesRecording) {
        toggleRecording(frame);
    }
    if (actions.togglesPlaying) {
        togglePlaying(frame);
    }
    if (actions.recentFile >= 0) {
        opener_.open(book_.recentFiles()[static_cast<std::size_t>(actions.recentFile)]);
    }
    if (actions.forget >= 0) {
        try {
            book_.forget(static_cast<std::size_t>(actions.forget));
        } catch (const std::runtime_error& error) {
            complain(error.what(), frame.now);
        }
    }
    if (actions.camera >= 0) {
        goTo(cameras_[static_cast<std::size_t>(actions.camera)], frame.walker, frame.now);
        return true;
    }
    return actions.bookmark >= 0 && goToBookmark(static_cast<std::size_t>(actions.bookmark), frame);
}

void Tour::draw(double now, float scale) {
    if (message_ && now > message_->until) {
        message_.reset();
    }
    if (isHelpOpen_) {
        ui::drawKeyTable(scale);
    }
    if (message_) {
        ui::drawMessage(*message_, scale);
    }
}

}  // namespace fluxwalk::app
