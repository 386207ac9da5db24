#include "viewer/app/walkthrough.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <vector>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include "viewer/app/floor.h"
#include "viewer/app/inspector.h"
#include "viewer/app/keep_picture.h"
#include "viewer/app/mouse_look.h"
#include "viewer/app/overlays.h"
#include "viewer/app/seen_picture.h"
#include "viewer/app/still_taker.h"
#include "viewer/app/tapped_keys.h"
#include "viewer/app/tour.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/imgui_renderer.h"
#include "viewer/ui/keys.h"
#include "viewer/ui/legend.h"
#include "viewer/ui/message.h"
#include "viewer/ui/panel.h"

namespace fluxwalk::app {
namespace {

constexpr double kFrameTime = 1.0 / 60.0;
/// Seconds between looks at the solver while nothing moves.
constexpr double kIdleTime = 0.2;
/// Frames that Dear ImGui needs to settle after an event.
constexpr int kSettlingFrames = 3;
/// Without a graphics card, following the solver may take this part of the time, so that it gets the rest.
constexpr double kFollowingPart = 0.25;
/// Seconds after the last movement when a software picture gets its smooth edges back.
constexpr double kStandstill = 0.3;
/// What the line of keys takes of the lower edge, at 96 dpi.
constexpr float kKeysHeight = 58.0f;
/// A camera so many metres above a floor is a person who stands there and will want to walk.
constexpr double kLowestEyes = 0.8;
constexpr double kHighestEyes = 2.3;

/// The window, its parts and their state: one frame is one call of step().
class Walkthrough {
  public:
    Walkthrough(gl::WindowContext& window, const Exhibit& exhibit, SceneOpener& opener);

    void step();
    /// The solver, to be stopped elsewhere; null for none. Nothing else may be called afterwards.
    std::unique_ptr<session::SolverSession> release() { return std::move(session_); }
    /// The same for a file that is being written.
    std::future<void> releaseFile() { return stills_.release(); }

  private:
    void waitForWork();
    void followDisplay();
    void takeSnapshot();
    void show(std::shared_ptr<const solve::Snapshot> snapshot);
    void followOverlays();
    void followLight();
    void inspect(bool isClicked);
    void chooseMovement();
    void takeKeys();
    bool move(double seconds);
    void keepPicture(bool asLight);
    void drawInterface();
    StillTaker::Frame stillFrame();

    gl::WindowContext& window_;
    const Exhibit& exhibit_;
    ui::ImguiContext imgui_;
    ui::ImguiRenderer imguiRenderer_;
    SeenPicture picture_;
    MouseLook mouse_;
    TappedKeys tappedKeys_;
    ui::Walker walker_;
    ui::ViewSettings settings_;
    solve::Options options_;
    std::vector<scene::LightSource> lights_;
    bool isPaused_ = false;
    bool hasChosenMovement_ = false;
    std::shared_ptr<const solve::Snapshot> shown_;
    /// Settings that the overlay was filled for.
    render::DrawSettings overlaid_;
    std::optional<ui::Legend> faceLegend_;
    bool isOverlayOld_ = true;
    Inspector inspector_;

    double now_ = 0.0;
    double lastMove_ = -1.0;
    int framesToSettle_ = kSettlingFrames;
    bool isAnimating_ = true;
    Floor floor_;
    Tour tour_;
    StillTaker stills_;
    /// Last, so that the solver stops before anything it may wake goes.
    std::unique_ptr<session::SolverSession> session_;
};

Walkthrough::Walkthrough(gl::WindowContext& window, const Exhibit& exhibit, SceneOpener& opener)
    : window_(window),
      exhibit_(exhibit),
      imgui_(window.contentScale(), window.window()),
      imguiRenderer_(window.functions()),
      picture_(window, exhibit.scene),
      mouse_(window.window()),
      tappedKeys_(window.window()),
      walker_(exhibit.camera, exhibit.solid->bounds()),
      settings_{{}, exhibit.look, exhibit.isProbing, exhibit.inspection, true, true, {}, {}},
      options_(exhibit.options.value_or(solve::Options{})),
      lights_(scene::listLightSources(*exhibit.scene)),
      now_(glfwGetTime()),
      floor_(exhibit.solid),
      tour_(window, exhibit, opener),
      stills_(window, {tour_, picture_.renderer(), settings_}, exhibit.scene->name) {
    settings_.lights = ui::controlsOf(lights_, options_.lighting);
    if (exhibit.look.exposure) {
        settings_.exposure = {false, 0.0, *exhibit.look.exposure};
    }
    if (exhibit.options) {
        session_ = std::make_unique<session::SolverSession>(session::solveWith(exhibit.solver),
                                                            *exhibit.options, [] { glfwPostEmptyEvent(); });
    } else {
        show(exhibit.lit);
    }
}

void Walkthrough::waitForWork() {
    const double start = glfwGetTime();
    const double timeout = isAnimating_ || framesToSettle_ > 0 ? now_ + kFrameTime - start : kIdleTime;
    if (timeout > 1e-4) {
        glfwWaitEventsTimeout(timeout);
    } else {
        glfwPollEvents();
    }
    const bool hadEvent = glfwGetTime() - start < timeout - 1e-3;
    framesToSettle_ = hadEvent ? kSettlingFrames : std::max(0, framesToSettle_ - 1);
}

// The window may have been moved to a display with other pixels.
void Walkthrough::followDisplay() {
    if (const float scale = window_.contentScale(); scale != imgui_.scale()) {
        imgui_.rescale(scale);
        imguiRenderer_.takeGlyphs();
        framesToSettle_ = kSettlingFrames;
    }
}

void Walkthrough::takeSnapshot() {
    if (!session_) {
        return;
    }
    auto newest = session_->latest();
    if (newest == shown_) {
        return;
    }
    const bool mayWait = window_.isSoftware() && shown_ != nullptr && !newest->finished;
    if (mayWait && now_ - picture_.lastDraw() < picture_.drawSeconds() / kFollowingPart) {
        return;
    }
    show(std::move(newest));
}

void Walkthrough::show(std::shared_ptr<const solve::Snapshot> snapshot) {
    picture_.renderer().setMeshes(snapshot->meshes, snapshot->lighting);
    picture_.renew();
    shown_ = std::move(snapshot);
    isOverlayOld_ = true;
}

// Elements, clusters and coloured faces follow the settings and the snapshot.
void Walkthrough::followOverlays() {
    const render::DrawSettings& look = settings_.draw;
    if (session_ && !(detailFor(look) == detailFor(overlaid_))) {
        session_->setDetail(detailFor(look));
    }
    const bool isSame = look.shown == overlaid_.shown && look.elementEdges == overlaid_.elementEdges &&
                        look.clusterBoxes == overlaid_.clusterBoxes &&
                        look.clusterDepth == overlaid_.clusterDepth;
    if (shown_ && (!isSame || isOverlayOld_)) {
        faceLegend_ =
            fillOverlay(picture_.renderer().overlay(), *shown_, look, picture_.renderer().colorMap());
        isOverlayOld_ = false;
        picture_.renew();
    }
    overlaid_ = look;
}

// Where light is gathered for the display, and for whom first.
void Walkthrough::followLight() {
    if (!session_) {
        return;
    }
    const gl::PixelSize size = window_.framebufferSize();
    const bool isGathered = options_.display == solve::DisplayLight::gathered && size.height > 0;
    session_->setGathering(isGathered ? std::optional(image::Look{
                                            walker_.camera(), static_cast<double>(size.width) / size.height})
                                      : std::nullopt);
}

void Walkthrough::inspect(bool isClicked) {
    if (!session_ || !settings_.isProbing || !shown_) {
        return;
    }
    const ImGuiIO& io = ImGui::GetIO();
    Inspector::Frame frame;
    frame.camera = walker_.camera();
    frame.size = {static_cast<int>(io.DisplaySize.x), static_cast<int>(io.DisplaySize.y)};
    frame.cursor = mouse_.isCaptured()
                       ? 0.5 * base::Vec2d(frame.size.width, frame.size.height)
                       : base::Vec2d(static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y));
    frame.isOverPanel = io.WantCaptureMouse && !mouse_.isCaptured();
    frame.isClicked = isClicked;
    frame.solution = shown_->sequence;
    inspector_.update(*session_, frame);
    if (const image::Inspection* inspection = inspector_.inspection()) {
        ui::drawInspection(
            *inspection, *exhibit_.scene, walker_.camera(), settings_.inspection,
            {imgui_.scale(), kKeysHeight * imgui_.scale(), ui::rightOfPanel(settings_, imgui_.scale())});
    }
}

void Walkthrough::chooseMovement() {
    if (hasChosenMovement_ || !floor_.isReady()) {
        return;
    }
    hasChosenMovement_ = true;
    const base::Vec3d& eye = walker_.camera().position;
    const double height = eye.y - floor_.below(eye).value_or(eye.y);
    if (height > kLowestEyes && height < kHighestEyes) {
        walker_.movement = ui::Movement::walk;
    }
}

void Walkthrough::takeKeys() {
    if (ImGui::GetIO().WantTextInput) {
        return;
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_TAB, false)) {
        mouse_.setCaptured(!mouse_.isCaptured());
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_T, false)) {
        stills_.press(stillFrame());
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
        if (!mouse_.isCaptured() && !tour_.isOpen()) {
            stills_.dismiss();
        }
        mouse_.setCaptured(false);
        inspector_.unpin();
    }
    if (session_ && ImGui::IsKeyPressed(GLFW_KEY_I, false)) {
        settings_.isProbing = !settings_.isProbing;
        inspector_.unpin();
    }
    if (session_ && isPaused_ && ImGui::IsKeyPressed(GLFW_KEY_N, false)) {
        session_->step();
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_H, false)) {
        settings_.isPanelOpen = !settings_.isPanelOpen;
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_F, false)) {
        const bool walks = walker_.movement == ui::Movement::walk;
        walker_.movement = walks ? ui::Movement::fly : ui::Movement::walk;
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_C, false)) {
        const bool isPicture = settings_.draw.shown == render::Shown::picture;
        settings_.draw.shown = isPicture ? render::Shown::illuminance : render::Shown::picture;
    }
    const bool asLight = ImGui::GetIO().KeyShift;
    if (ImGui::IsKeyPressed(GLFW_KEY_F12, false) && !stills_.keep(asLight, stillFrame())) {
        keepPicture(asLight);
    }
    if (session_ && ImGui::IsKeyPressed(GLFW_KEY_P, false)) {
        isPaused_ = !isPaused_;
        session_->setPaused(isPaused_);
    }
}

bool Walkthrough::move(double seconds) {
    const ImGuiIO& io = ImGui::GetIO();
    ui::WalkInput input;
    const base::Vec2d look = mouse_.update(io.WantCaptureMouse);
    input.turn = look.x;
    input.tilt = look.y;
    const auto axis = [](int forwards, int backwards) {
        return (ImGui::IsKeyDown(forwards) ? 1.0 : 0.0) - (ImGui::IsKeyDown(backwards) ? 1.0 : 0.0);
    };
    if (!io.WantTextInput) {
        input.ahead = std::clamp(axis(GLFW_KEY_W, GLFW_KEY_S) + axis(GLFW_KEY_UP, GLFW_KEY_DOWN), -1.0, 1.0);
        input.right =
            std::clamp(axis(GLFW_KEY_D, GLFW_KEY_A) + axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT), -1.0, 1.0);
        input.up = axis(GLFW_KEY_E, GLFW_KEY_Q);
        input.fast = io.KeyShift;
        input.slow = io.KeyCtrl;
    }
    const bool isSteered =
        input.turn != 0.0 || input.tilt != 0.0 || input.ahead != 0.0 || input.right != 0.0 || input.up != 0.0;
    if (tour_.lead({walker_, floor_, now_, isSteered, mouse_.isCaptured()})) {
        return true;
    }
    if (io.MouseWheel != 0.0f && !io.WantCaptureMouse && !tour_.isOrbiting()) {
        walker_.speed =
            std::clamp(walker_.speed * std::pow(1.15, static_cast<double>(io.MouseWheel)), 0.01, 100.0);
    }
    const bool changed = walker_.update(input, seconds, floor_.walls());
    return changed || input.ahead != 0.0 || input.right != 0.0 || input.up != 0.0;
}

void Walkthrough::keepPicture(bool asLight) {
    render::DrawSettings look = settings_.draw;
    look.exposure = settings_.exposure.exposure;
    picture_.renderer().setSharpTextures(true);
    try {
        const std::filesystem::path file = app::keepPicture(
            window_.functions(), picture_.renderer(), {walker_.camera(), window_.framebufferSize(), look},
            exhibit_.scene->name, asLight);
        tour_.say(file.string(), now_);
    } catch (const base::FileError& error) {
        tour_.complain(error.what(), now_);
    }
}

StillTaker::Frame Walkthrough::stillFrame() {
    const float scale = imgui_.scale();
    const ui::Canvas canvas{scale, kKeysHeight * scale, ui::rightOfPanel(settings_, scale)};
    return {session_.get(), walker_.camera(), now_, now_ == lastMove_, shown_ ? shown_->sequence : 0, canvas};
}

void Walkthrough::drawInterface() {
    const float scale = imgui_.scale();
    ui::PanelInfo info;
    info.scene = exhibit_.scene.get();
    info.snapshot = shown_.get();
    if (session_) {
        info.session = session_->status();
    }
    info.isPaused = isPaused_;
    render::SceneRenderer& renderer = picture_.renderer();
    info.triangleCount = renderer.triangleCount();
    info.framesPerSecond = picture_.framesPerSecond();
    info.renderer = window_.renderer();
    if (settings_.draw.shown == render::Shown::illuminance ||
        settings_.draw.shown == render::Shown::luminance) {
        info.shownRange = renderer.rangeOf(settings_.draw);
    }
    info.places = tour_.places();
    info.lights = lights_;
    info.still = stills_.info();
    const double fov = walker_.verticalFov();
    const ui::PanelActions actions = ui::drawPanel(info, settings_, options_, walker_, scale);
    if (!stills_.isLarge()) {
        inspect(ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::GetIO().WantCaptureMouse &&
                !tour_.isOrbiting());
        const bool isProbed = settings_.isProbing && inspector_.inspection() != nullptr;
        drawLegends({imgui_.scale(), kKeysHeight * imgui_.scale()}, settings_.draw, faceLegend_,
                    isProbed && settings_.inspection.visibility, info.shownRange,
                    picture_.renderer().colorMap());
    }
    stills_.draw(stillFrame(), actions.still);
    const float left = ui::rightOfPanel(settings_, scale);
    ui::drawKeys({mouse_.isCaptured(), walker_.movement == ui::Movement::walk, settings_.isPanelOpen}, left,
                 scale);
    if (session_ && info.triangleCount == 0 && info.session->phase == session::Phase::solving) {
        ui::drawWaiting("Finding the first light ...", left);
    }
    if (session_ && actions.changedOptions) {
        session_->setOptions(options_);
    }
    if (session_ && actions.steps) {
        session_->step();
    }
    if (session_ && actions.togglesPause) {
        isPaused_ = !isPaused_;
        session_->setPaused(isPaused_);
    }
    const bool isElsewhere = tour_.act(actions.places, {walker_, floor_, now_, false, mouse_.isCaptured()});
    tour_.draw(now_, scale);
    if (isElsewhere || fov != walker_.verticalFov()) {
        picture_.renew();
    }
}

void Walkthrough::step() {
    waitForWork();
    const double seconds = std::min(glfwGetTime() - now_, 0.1);
    now_ = glfwGetTime();
    followDisplay();
    takeSnapshot();
    chooseMovement();

    ImGui_ImplGlfw_NewFrame();
    tappedKeys_.follow();
    ImGui::NewFrame();
    takeKeys();
    const bool isMoving = move(seconds);
    if (isMoving) {
        lastMove_ = now_;
        picture_.renew();
    }
    tour_.record({walker_, floor_, now_});
    drawInterface();
    followOverlays();
    followLight();
    ImGui::Render();
    const bool isAdapting = picture_.adapt(walker_.camera(), settings_.exposure, now_, seconds);
    isAnimating_ = isMoving || isAdapting || now_ - lastMove_ < kStandstill;

    const double start = glfwGetTime();
    render::DrawSettings look = settings_.draw;
    look.exposure = settings_.exposure.exposure;
    picture_.draw({walker_.camera(), look, settings_.smoothEdges, now_ - lastMove_ < kStandstill}, now_);
    if (picture_.copyToWindow()) {
        imguiRenderer_.draw(*ImGui::GetDrawData());
    }
    window_.swapBuffers();
    picture_.report(glfwGetTime() - start, now_);
}

}  // namespace

void walkThrough(gl::WindowContext& window, std::unique_ptr<Exhibit> exhibit, const OpenScene& open) {
    // Solvers of scenes that were left end at their next wave; nobody need wait for them before the end.
    std::vector<std::future<void>> leaving;
    SceneOpener opener(window.window(), open);
    while (exhibit) {
        const std::string& name = exhibit->scene->name;
        glfwSetWindowTitle(window.window(), (name.empty() ? "Fluxwalk" : name + " - Fluxwalk").c_str());
        std::unique_ptr<Exhibit> next;
        Walkthrough walkthrough(window, *exhibit, opener);
        while (!next && glfwWindowShouldClose(window.window()) == GLFW_FALSE) {
            walkthrough.step();
            next = opener.takeReady();
        }
        if (!next) {
            // Nobody need look at a dead window until the solver ends.
            glfwHideWindow(window.window());
        }
        leaving.push_back(walkthrough.releaseFile());
        leaving.push_back(
            std::async(std::launch::async, [old = walkthrough.release()]() mutable { old.reset(); }));
        exhibit = std::move(next);
    }
}

}  // namespace fluxwalk::app
