#include "viewer/app/walkthrough.h"

#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include "viewer/app/floor.h"
#include "viewer/app/inspector.h"
#include "viewer/app/mouse_look.h"
#include "viewer/app/overlays.h"
#include "viewer/app/picture_file.h"
#include "viewer/app/sample_choice.h"
#include "viewer/gl/render_target.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/imgui_renderer.h"
#include "viewer/ui/legend.h"
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
constexpr int kSamples = 4;
/// Of a picture that is kept.
constexpr int kKeptSamples = 8;
/// Seconds between readings of the light meter.
constexpr double kMeteringTime = 0.2;
/// What the line of keys takes of the lower edge, at 96 dpi.
constexpr float kKeysHeight = 58.0f;
/// A camera so many metres above a floor is a person who stands there and will want to walk.
constexpr double kLowestEyes = 0.8;
constexpr double kHighestEyes = 2.3;

/// The window, its parts and their state: one frame is one call of step().
class Walkthrough {
  public:
    Walkthrough(gl::WindowContext& window, const Exhibit& exhibit);

    void step();

  private:
    void waitForWork();
    void takeSnapshot();
    void show(std::shared_ptr<const solve::Snapshot> snapshot);
    void followOverlays();
    void inspect(bool isClicked);
    void chooseMovement();
    void takeKeys();
    bool move(double seconds);
    void meter();
    void keepPicture(bool asLight);
    void drawScene();
    void drawInterface();

    gl::WindowContext& window_;
    const Exhibit& exhibit_;
    ui::ImguiContext imgui_;
    ui::ImguiRenderer imguiRenderer_;
    render::SceneRenderer renderer_;
    std::unique_ptr<gl::RenderTarget> target_;
    MouseLook mouse_;
    ui::Walker walker_;
    ui::ViewSettings settings_;
    solve::Options options_;
    bool isPaused_ = false;
    bool hasChosenMovement_ = false;
    std::shared_ptr<const solve::Snapshot> shown_;
    double automaticExposure_ = 0.0;
    bool isMeteringOld_ = true;
    double lastMetering_ = -1.0;
    /// Settings that the overlay was filled for.
    render::DrawSettings overlaid_;
    std::optional<ui::Legend> faceLegend_;
    bool isOverlayOld_ = true;
    Inspector inspector_;
    SampleChoice sampleChoice_;

    double now_ = 0.0;
    double lastMove_ = -1.0;
    double lastDraw_ = 0.0;
    double drawSeconds_ = 0.0;
    double framesPerSecond_ = 0.0;
    int framesToSettle_ = kSettlingFrames;
    bool needsDrawing_ = true;
    bool isAnimating_ = true;
    render::DrawSettings drawn_;
    Floor floor_;
    /// Last, so that the solver stops before anything it may wake goes.
    std::optional<session::SolverSession> session_;
};

Walkthrough::Walkthrough(gl::WindowContext& window, const Exhibit& exhibit)
    : window_(window),
      exhibit_(exhibit),
      imgui_(window.contentScale(), window.window()),
      imguiRenderer_(window.functions()),
      renderer_(window.functions(), exhibit.scene),
      mouse_(window.window()),
      walker_(exhibit.camera, exhibit.solid->bounds()),
      settings_{{}, exhibit.look, exhibit.isProbing, exhibit.inspection},
      options_(exhibit.options.value_or(solve::Options{})),
      sampleChoice_(kSamples, window.isSoftware()),
      now_(glfwGetTime()),
      floor_(exhibit.solid) {
    if (exhibit.look.exposure) {
        settings_.exposure = {false, 0.0, *exhibit.look.exposure};
    }
    if (exhibit.options) {
        session_.emplace(session::solveWith(exhibit.solver), *exhibit.options, [] { glfwPostEmptyEvent(); });
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

void Walkthrough::takeSnapshot() {
    if (!session_) {
        return;
    }
    auto newest = session_->latest();
    if (newest == shown_) {
        return;
    }
    const bool mayWait = window_.isSoftware() && shown_ != nullptr && !newest->finished;
    if (mayWait && now_ - lastDraw_ < drawSeconds_ / kFollowingPart) {
        return;
    }
    show(std::move(newest));
}

void Walkthrough::show(std::shared_ptr<const solve::Snapshot> snapshot) {
    renderer_.setMeshes(snapshot->meshes);
    isMeteringOld_ = true;
    shown_ = std::move(snapshot);
    needsDrawing_ = true;
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
        faceLegend_ = fillOverlay(renderer_.overlay(), *shown_, look, renderer_.colorMap());
        isOverlayOld_ = false;
        needsDrawing_ = true;
    }
    overlaid_ = look;
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
        ui::drawInspection(*inspection, *exhibit_.scene, walker_.camera(), settings_.inspection,
                           {imgui_.scale(), kKeysHeight * imgui_.scale()});
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
    if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
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
    if (ImGui::IsKeyPressed(GLFW_KEY_F12, false)) {
        keepPicture(ImGui::GetIO().KeyShift);
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
    if (io.MouseWheel != 0.0f && !io.WantCaptureMouse) {
        walker_.speed =
            std::clamp(walker_.speed * std::pow(1.15, static_cast<double>(io.MouseWheel)), 0.01, 100.0);
    }
    const bool changed =
        walker_.update(input, seconds, [this](const base::Vec3d& point) { return floor_.below(point); });
    return changed || input.ahead != 0.0 || input.right != 0.0 || input.up != 0.0;
}

// The exposure follows what is seen, as eyes do.
void Walkthrough::meter() {
    const gl::PixelSize size = window_.framebufferSize();
    const bool isLocked = !settings_.exposure.isAutomatic && settings_.exposure.exposure > 0.0;
    if (!isMeteringOld_ || isLocked || !shown_ || size.height <= 0 || now_ - lastMetering_ < kMeteringTime) {
        return;
    }
    automaticExposure_ =
        renderer_.meterExposure(walker_.camera(), static_cast<double>(size.width) / size.height);
    isMeteringOld_ = false;
    lastMetering_ = now_;
}

// Writes what is seen, without the panel, beside where the program was started; the title says where.
void Walkthrough::keepPicture(bool asLight) {
    const gl::PixelSize size = window_.framebufferSize();
    if (size.width <= 0 || size.height <= 0) {
        return;
    }
    const double aspect = static_cast<double>(size.width) / size.height;
    const gl::RenderTarget target(window_.functions(), size, kKeptSamples,
                                  asLight ? gl::PixelFormat::full : gl::PixelFormat::byte);
    target.bind();
    if (asLight) {
        renderer_.drawLight(walker_.camera(), aspect);
    } else {
        render::DrawSettings look = settings_.draw;
        look.exposure = settings_.exposure.exposure;
        renderer_.draw(walker_.camera(), aspect, look);
    }
    target.resolve();
    std::string message;
    try {
        const std::filesystem::path file =
            freePictureName(std::filesystem::current_path(), exhibit_.scene->name, asLight ? ".exr" : ".png");
        if (asLight) {
            writeLight(file, size, target.readLight());
        } else {
            writePixels(file, size, target.readRgb());
        }
        message = file.string();
    } catch (const std::exception& error) {
        message = error.what();
    }
    glfwSetWindowTitle(window_.window(), ("Fluxwalk - " + message).c_str());
}

void Walkthrough::drawScene() {
    const gl::PixelSize size = window_.framebufferSize();
    if (size.width <= 0 || size.height <= 0) {
        return;
    }
    const bool isMoving = now_ - lastMove_ < kStandstill;
    const int samples = settings_.smoothEdges ? sampleChoice_.choose(isMoving) : 1;
    render::DrawSettings wanted = settings_.draw;
    wanted.exposure = settings_.exposure.exposure;
    const bool isSame =
        target_ && target_->size() == size && target_->samples() == samples && drawn_ == wanted;
    if (isSame && !needsDrawing_) {
        framesPerSecond_ = 0.0;
        return;
    }
    if (!target_ || !(target_->size() == size) || target_->samples() != samples) {
        target_.reset();
        target_ = std::make_unique<gl::RenderTarget>(window_.functions(), size, samples);
    }
    target_->bind();
    renderer_.draw(walker_.camera(), static_cast<double>(size.width) / size.height, wanted);
    target_->resolve();
    drawn_ = wanted;
    needsDrawing_ = false;
    framesPerSecond_ = lastDraw_ > 0.0 ? 1.0 / std::max(now_ - lastDraw_, 1e-3) : 0.0;
    lastDraw_ = now_;
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
    info.triangleCount = renderer_.triangleCount();
    info.framesPerSecond = framesPerSecond_;
    info.renderer = window_.renderer();
    if (settings_.draw.shown == render::Shown::illuminance ||
        settings_.draw.shown == render::Shown::luminance) {
        info.shownRange = renderer_.rangeOf(settings_.draw);
    }
    const double fov = walker_.verticalFov();
    const ui::PanelActions actions = ui::drawPanel(info, settings_, options_, walker_, scale);
    inspect(ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::GetIO().WantCaptureMouse);
    const ui::Canvas canvas{scale, kKeysHeight * scale};
    float legendWidth = 0.0f;
    if (faceLegend_) {
        legendWidth = ui::drawLegend(*faceLegend_, canvas);
    } else if (settings_.draw.shown == render::Shown::illuminance ||
               settings_.draw.shown == render::Shown::luminance) {
        legendWidth =
            ui::drawLegend(ui::makeLegend(settings_.draw, info.shownRange, renderer_.colorMap()), canvas);
    }
    if (settings_.isProbing && settings_.inspection.visibility && inspector_.inspection() != nullptr) {
        ui::drawLegend(ui::makeVisibilityLegend(renderer_.colorMap()), canvas, legendWidth);
    }
    ui::drawKeys(mouse_.isCaptured(), walker_.movement, scale);
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
    if (actions.camera >= 0) {
        walker_.jumpTo(exhibit_.scene->cameras[static_cast<std::size_t>(actions.camera)]);
    }
    needsDrawing_ |= actions.camera >= 0 || fov != walker_.verticalFov();
}

void Walkthrough::step() {
    waitForWork();
    const double seconds = std::min(glfwGetTime() - now_, 0.1);
    now_ = glfwGetTime();
    takeSnapshot();
    chooseMovement();

    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    takeKeys();
    const bool isMoving = move(seconds);
    if (isMoving) {
        lastMove_ = now_;
        needsDrawing_ = true;
    }
    drawInterface();
    followOverlays();
    ImGui::Render();
    isMeteringOld_ |= needsDrawing_;
    meter();
    const bool isAdapting =
        automaticExposure_ > 0.0 && settings_.exposure.follow(automaticExposure_, seconds);
    isAnimating_ = isMoving || isAdapting || now_ - lastMove_ < kStandstill;

    const double start = glfwGetTime();
    drawScene();
    if (target_) {
        target_->copyToWindow();
        imguiRenderer_.draw(*ImGui::GetDrawData());
    }
    window_.swapBuffers();
    if (lastDraw_ == now_) {
        drawSeconds_ = glfwGetTime() - start;
        sampleChoice_.report(target_->samples(), drawSeconds_);
    }
}

}  // namespace

void walkThrough(gl::WindowContext& window, const Exhibit& exhibit) {
    Walkthrough walkthrough(window, exhibit);
    while (glfwWindowShouldClose(window.window()) == GLFW_FALSE) {
        walkthrough.step();
    }
    // The solver ends at its next wave; nobody need look at a dead window until then.
    glfwHideWindow(window.window());
}

}  // namespace fluxwalk::app
