#include <chrono>
#include <functional>
#include <thread>

#include <benchmark/benchmark.h>
#include <imgui.h>

#include "core/scene/builders.h"
#include "core/scene/lighting.h"
#include "viewer/session/solver_session.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/panel.h"

// Seconds from a request to the first snapshot that shows what it asked for, on the gallery, through the
// session that the window talks to: at rest, and while the solver refines. A snapshot is what the window
// draws next.
namespace fluxwalk::session {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using solve::Options;
using solve::Snapshot;

constexpr double kError = 0.05;

std::unique_ptr<SolverSession> startOn(const char* name) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene(name));
    SolverSource source;
    source.make = [scene](const Options& options) {
        return std::make_unique<solve::Solver>(scene, options, 0);
    };
    Options options;
    options.error = kError;
    return std::make_unique<SolverSession>(solveWith(source), options, std::function<void()>{});
}

/// The scene, solved once for all that begin at rest.
SolverSession& restingGallery() {
    static const std::unique_ptr<SolverSession> session = startOn("gallery");
    session->wait();
    return *session;
}

double waitFor(const SolverSession& session, const std::function<bool(const Snapshot&)>& condition) {
    const Clock::time_point start = Clock::now();
    for (auto snapshot = session.latest(); snapshot == nullptr || !condition(*snapshot);
         snapshot = session.latest()) {
        std::this_thread::sleep_for(500us);
    }
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The largest time matters as much as the mean.
class Latency {
  public:
    explicit Latency(benchmark::State& state) : state_(state) {}
    ~Latency() { state_.counters["worst_ms"] = 1e3 * worst_; }
    void take(double seconds) {
        worst_ = std::max(worst_, seconds);
        state_.SetIterationTime(seconds);
    }

  private:
    benchmark::State& state_;
    double worst_ = 0.0;
};

Options dimmed(Options options, int step) {
    options.lighting.materials.clear();
    const auto scene = *scene::buildScene("gallery");
    const scene::LightSource source = scene::listLightSources(scene).front();
    scene::setFactor(options.lighting, source, base::Rgb(step % 2 == 0 ? 0.2f : 3.0f));
    return options;
}

/// What the window's thread does for a frame beside drawing: it asks the session and lays out the panel.
void panelFrame(benchmark::State& state) {
    SolverSession& session = restingGallery();
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("gallery"));
    const ui::ImguiContext imgui(1.0f);
    ImGui::GetIO().DisplaySize = ImVec2(1280.0f, 720.0f);
    ImGui::GetIO().Fonts->Build();
    ui::Walker walker(scene->cameras.front(), scene->bounds());
    ui::ViewSettings settings;
    ui::PanelInfo info;
    info.scene = scene.get();
    info.lights = scene::listLightSources(*scene);
    settings.lights = ui::controlsOf(info.lights, {});
    Options options = session.options();
    for (auto _ : state) {
        const auto snapshot = session.latest();
        info.snapshot = snapshot.get();
        info.session = session.status();
        ImGui::NewFrame();
        ui::drawPanel(info, settings, options, walker, 1.0f);
        ImGui::Render();
    }
}
BENCHMARK(panelFrame)->Unit(benchmark::kMillisecond);

/// From the making of the session, which builds the solver, to the first light.
void firstPicture(benchmark::State& state) {
    Latency latency(state);
    for (auto _ : state) {
        const Clock::time_point start = Clock::now();
        const auto session = startOn("gallery");
        waitFor(*session, [](const Snapshot&) { return true; });
        latency.take(std::chrono::duration<double>(Clock::now() - start).count());
    }
}
BENCHMARK(firstPicture)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3);

void relightAtRest(benchmark::State& state) {
    SolverSession& session = restingGallery();
    Latency latency(state);
    int step = 0;
    for (auto _ : state) {
        const Options options = dimmed(session.options(), step++);
        session.setOptions(options);
        latency.take(waitFor(session, [&](const Snapshot& s) { return s.lighting == options.lighting; }));
        session.wait();
    }
    state.counters["links"] = static_cast<double>(session.latest()->statistics.counters.links);
}
BENCHMARK(relightAtRest)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(6);

void relightWhileSolving(benchmark::State& state) {
    const auto session = startOn("gallery");
    waitFor(*session, [](const Snapshot&) { return true; });
    Latency latency(state);
    int step = 0;
    for (auto _ : state) {
        const Options options = dimmed(session->options(), step++);
        session->setOptions(options);
        latency.take(waitFor(*session, [&](const Snapshot& s) { return s.lighting == options.lighting; }));
        std::this_thread::sleep_for(137ms);
    }
}
BENCHMARK(relightWhileSolving)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(20);

void displayAngleAtRest(benchmark::State& state) {
    SolverSession& session = restingGallery();
    Latency latency(state);
    int step = 0;
    for (auto _ : state) {
        Options options = session.options();
        options.displayAngle = ++step % 2 == 0 ? 4.0 : 8.0;
        const std::uint64_t before = session.latest()->sequence;
        session.setOptions(options);
        latency.take(waitFor(session, [&](const Snapshot& s) { return s.sequence > before; }));
        session.wait();
    }
}
BENCHMARK(displayAngleAtRest)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(6);

/// The threshold at rest, and as many times that.
void turnThreshold(benchmark::State& state, double from, double to) {
    SolverSession& session = restingGallery();
    Latency latency(state);
    static const double threshold = session.latest()->statistics.threshold;
    Options options = session.options();
    for (auto _ : state) {
        options.threshold = from * threshold;
        session.setOptions(options);
        session.wait();
        options.threshold = to * threshold;
        const std::uint64_t before = session.latest()->sequence;
        session.setOptions(options);
        latency.take(waitFor(session, [&](const Snapshot& s) { return s.sequence > before; }));
        session.wait();
    }
}

void thresholdLowered(benchmark::State& state) {
    turnThreshold(state, 8.0, 1.0);
}
BENCHMARK(thresholdLowered)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1);

void thresholdRaised(benchmark::State& state) {
    turnThreshold(state, 1.0, 8.0);
}
BENCHMARK(thresholdRaised)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace fluxwalk::session
