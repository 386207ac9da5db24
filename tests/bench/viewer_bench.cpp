#include <algorithm>
#include <ctime>
#include <map>

#include <benchmark/benchmark.h>

#include "core/base/check.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "viewer/gl/context.h"
#include "viewer/gl/render_target.h"
#include "viewer/render/scene_renderer.h"

// Drawing the gallery at 1280 x 720 without a window: a whole frame, what a frame takes of the thread that
// asks for it, and sending a solution to the GPU. The first argument is the number of triangles in thousands,
// about.
namespace fluxwalk::render {
namespace {

constexpr gl::PixelSize kSize{1280, 720};
constexpr int kTurns = 8;

/// The gallery; for 100,000 triangles without what half of its triangles are spent on, since it is thin and
/// round.
std::shared_ptr<const scene::Scene> makeScene(std::int64_t thousands) {
    scene::Scene scene = scene::buildGallery();
    if (thousands <= 100) {
        std::erase_if(scene.objects, [](const scene::Object& object) {
            return object.name == "cord" || object.name == "column shaft";
        });
    }
    return std::make_shared<const scene::Scene>(std::move(scene));
}

/// Solved so roughly and shown so round that it has about so many thousand triangles.
const scene::LitMeshes& galleryMeshes(const std::shared_ptr<const scene::Scene>& scene,
                                      std::int64_t thousands) {
    static std::map<std::int64_t, scene::LitMeshes> known;
    const auto [found, isNew] = known.try_emplace(thousands);
    if (isNew) {
        solve::Options options;
        options.error = thousands > 300 ? 0.3 : 1.0;
        options.threshold = thousands > 300 ? 0.0 : 400.0;
        options.displayAngle = thousands > 300 ? 2.4 : 20.0;
        solve::Solver solver(scene, options, 0);
        solver.solve({});
        found->second = solver.litMeshes();
    }
    return found->second;
}

class Drawing : public benchmark::Fixture {
  public:
    void SetUp(benchmark::State& state) override {
        scene_ = makeScene(state.range(0));
        meshes_ = galleryMeshes(scene_, state.range(0));
        context_ = gl::makeHeadlessContext(gl::HeadlessKind::automatic);
    }
    void TearDown(benchmark::State& state) override {
        std::size_t triangles = 0;
        for (const auto& mesh : meshes_) {
            triangles += mesh->triangles.size() / 3;
        }
        state.counters["triangles"] = static_cast<double>(triangles);
        state.SetLabel(context_->renderer());
        context_.reset();
        meshes_.clear();
    }

  protected:
    /// A view of the middle of the gallery, turned from frame to frame as a visitor turns.
    scene::Camera cameraOf(int turn) const {
        scene::Camera camera = scene_->cameras.at(0);
        const double angle = 0.05 * static_cast<double>(turn % kTurns);
        const base::Vec3d f = camera.forward;
        camera.forward = {f.x * std::cos(angle) - f.z * std::sin(angle), f.y,
                          f.x * std::sin(angle) + f.z * std::cos(angle)};
        return camera;
    }
    static DrawSettings settings() {
        DrawSettings result;
        result.exposure = 0.01;
        return result;
    }

    std::shared_ptr<const scene::Scene> scene_;
    scene::LitMeshes meshes_;
    std::unique_ptr<gl::Context> context_;
};

double threadSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

BENCHMARK_DEFINE_F(Drawing, frame)(benchmark::State& state) {
    const gl::Functions& gl = context_->functions();
    SceneRenderer renderer(gl, scene_);
    renderer.setMeshes(meshes_);
    // One sample is what a window drawn by the processor gives a visitor who moves.
    renderer.setSharpTextures(state.range(1) > 1);
    const gl::RenderTarget target(gl, kSize, static_cast<int>(state.range(1)));
    const auto drawFrame = [&](int turn) {
        target.bind();
        renderer.draw(cameraOf(turn), 16.0 / 9.0, settings());
        target.resolve();
        gl.Finish();
    };
    // Shaders are translated for the machine when they are first used.
    drawFrame(0);
    int turn = 0;
    for (auto _ : state) {
        drawFrame(turn++);
    }
    state.counters["drawn"] = static_cast<double>(renderer.drawnTriangles());
}
BENCHMARK_REGISTER_F(Drawing, frame)
    ->ArgNames({"thousands", "samples"})
    ->Args({100, 1})
    ->Args({300, 1})
    ->Args({300, 4})
    ->Args({1000, 1})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// The small picture that the exposure is read from.
BENCHMARK_DEFINE_F(Drawing, metering)(benchmark::State& state) {
    SceneRenderer renderer(context_->functions(), scene_);
    renderer.setMeshes(meshes_);
    renderer.meterExposure(cameraOf(0), 16.0 / 9.0);
    int turn = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(renderer.meterExposure(cameraOf(turn++), 16.0 / 9.0));
    }
}
BENCHMARK_REGISTER_F(Drawing, metering)
    ->ArgNames({"thousands"})
    ->Arg(300)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// The draw calls themselves are left out: what remains is choosing what to draw.
BENCHMARK_DEFINE_F(Drawing, frameWithoutDrawing)(benchmark::State& state) {
    gl::Functions gl = context_->functions();
    SceneRenderer renderer(gl, scene_);
    renderer.setMeshes(meshes_);
    const gl::RenderTarget target(gl, kSize, 1);
    gl.DrawElements = [](GLenum, GLsizei, GLenum, const void*) {};
    gl.DrawArrays = [](GLenum, GLint, GLsizei) {};
    gl.Clear = [](GLbitfield) {};
    int turn = 0;
    target.bind();
    for (auto _ : state) {
        const double start = threadSeconds();
        renderer.draw(cameraOf(turn++), 16.0 / 9.0, settings());
        state.SetIterationTime(threadSeconds() - start);
    }
}
BENCHMARK_REGISTER_F(Drawing, frameWithoutDrawing)
    ->ArgNames({"thousands"})
    ->Arg(300)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

/// A new solution on the same triangles, as sweeps and relighting give it, or with other triangles.
void send(benchmark::State& state, const gl::Functions& gl, const std::shared_ptr<const scene::Scene>& scene,
          const scene::LitMeshes& first, const scene::LitMeshes& second) {
    SceneRenderer renderer(gl, scene);
    renderer.setMeshes(first);
    bool isFirst = true;
    for (auto _ : state) {
        const double start = threadSeconds();
        renderer.setMeshes(isFirst ? second : first);
        state.SetIterationTime(threadSeconds() - start);
        isFirst = !isFirst;
    }
}

scene::LitMeshes changed(const scene::LitMeshes& meshes, bool hasOtherShape) {
    scene::LitMeshes result;
    for (const auto& mesh : meshes) {
        auto copy = std::make_shared<scene::LitMesh>(*mesh);
        for (base::Rgb& irradiance : copy->irradiance) {
            irradiance *= 1.25f;
        }
        if (hasOtherShape) {
            std::rotate(copy->triangles.begin(), copy->triangles.begin() + 3, copy->triangles.end());
        }
        result.push_back(std::move(copy));
    }
    return result;
}

BENCHMARK_DEFINE_F(Drawing, sendLight)(benchmark::State& state) {
    send(state, context_->functions(), scene_, meshes_, changed(meshes_, false));
}
BENCHMARK_DEFINE_F(Drawing, sendAll)(benchmark::State& state) {
    send(state, context_->functions(), scene_, meshes_, changed(meshes_, true));
}
BENCHMARK_REGISTER_F(Drawing, sendLight)
    ->ArgNames({"thousands"})
    ->Arg(300)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK_REGISTER_F(Drawing, sendAll)
    ->ArgNames({"thousands"})
    ->Arg(300)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

}  // namespace
}  // namespace fluxwalk::render
