#include "viewer/app/view_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/App.hpp>

#include "core/cli/camera_arguments.h"
#include "core/cli/checkpointing.h"
#include "core/cli/lit_meshes.h"
#include "core/cli/output.h"
#include "core/cli/run_solver.h"
#include "core/cli/values.h"
#include "core/io/lit_gltf.h"
#include "core/io/visitor_files.h"
#include "viewer/app/choice.h"
#include "viewer/app/first_view.h"
#include "viewer/app/floor.h"
#include "viewer/app/look_arguments.h"
#include "viewer/app/overlays.h"
#include "viewer/app/picture_file.h"
#include "viewer/app/picture_sequence.h"
#include "viewer/app/picture_size.h"
#include "viewer/app/screenshot.h"
#include "viewer/app/sight.h"
#include "viewer/app/walkthrough.h"
#include "viewer/ui/keys.h"

namespace fluxwalk::app {
namespace {

/// Written where there is no display to walk on.
constexpr const char* kFallbackPicture = "walkthrough.png";
constexpr gl::PixelSize kWindowSize{1400, 900};
constexpr gl::PixelSize kDefaultPicture{1280, 720};

enum class GlChoice : std::uint8_t { automatic, egl, osmesa, window };

struct ViewArguments {
    cli::SceneArguments scene;
    cli::SolverArguments solver;
    cli::OutputArguments output;
    cli::CameraArguments camera;
    std::filesystem::path screenshot;
    std::filesystem::path play;
    double framesPerSecond = 30.0;
    gl::PixelSize size = kDefaultPicture;
    GlChoice gl = GlChoice::automatic;
    LookArguments look;
};

constexpr Choices<GlChoice, 4> kGlChoices{{{"auto", GlChoice::automatic},
                                           {"egl", GlChoice::egl},
                                           {"osmesa", GlChoice::osmesa},
                                           {"window", GlChoice::window}}};

bool isLit(const std::string& scene) {
    std::error_code ignored;
    return cli::namesFile(scene) && std::filesystem::exists(scene, ignored) && io::isLitGltf(scene);
}

/// Something to look at, solved or about to be.
struct Shown {
    std::shared_ptr<const scene::Scene> scene;
    solve::Snapshot snapshot;
    std::shared_ptr<const scene::Scene> solid;
};

Shown loadLit(const std::string& file) {
    io::LitFile lit = io::readLitGltf(file);
    Shown shown;
    shown.snapshot.meshes = std::move(lit.meshes);
    shown.scene = std::make_shared<const scene::Scene>(std::move(lit.scene));
    shown.solid = std::make_shared<const scene::Scene>(sceneOfMeshes(shown.snapshot.meshes));
    return shown;
}

scene::Camera cameraFor(const ViewArguments& arguments, const Shown& shown) {
    return cli::chooseCamera(arguments.camera, *shown.scene, [&] {
        const Solid solid(shown.solid);
        return chooseFirstView(solid.rays, shown.solid->bounds());
    });
}

std::unique_ptr<gl::Context> makeContext(GlChoice choice) {
    switch (choice) {
        case GlChoice::egl:
            return gl::makeHeadlessContext(gl::HeadlessKind::egl);
        case GlChoice::osmesa:
            return gl::makeHeadlessContext(gl::HeadlessKind::osmesa);
        case GlChoice::window:
            return std::make_unique<gl::WindowContext>("Fluxwalk", kWindowSize, false);
        case GlChoice::automatic:
            break;
    }
    return gl::makeHeadlessContext(gl::HeadlessKind::automatic);
}

/// Elements, clusters and links are not in lit files.
void requireNoSolution(const LookArguments& look) {
    if (look.pick || !(detailFor(look.draw) == solve::Detail{})) {
        throw base::UsageError(
            "a lit file has no elements and links: --pick, --overlay, --show level, residual and errors need "
            "a "
            "scene that is solved (with --resume FILE, from a checkpoint)");
    }
}

image::Inspection inspectPixel(const solve::Problem& problem, const scene::Camera& camera, gl::PixelSize size,
                               const base::Vec2d& pixel) {
    if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x >= size.width || pixel.y >= size.height) {
        throw base::UsageError("--pick: the pixel lies outside the picture of " + std::to_string(size.width) +
                               "x" + std::to_string(size.height));
    }
    auto inspection = image::inspectAlong(problem, rayThrough(camera, size, pixel));
    if (!inspection) {
        throw base::UsageError("--pick: nothing is seen at that pixel");
    }
    return std::move(*inspection);
}

/// A camera for each picture, and where it goes.
struct Shot {
    scene::Camera camera;
    std::filesystem::path file;
};

/// The one picture asked for, or those of a path.
std::vector<Shot> planShots(const ViewArguments& arguments, const std::filesystem::path& file,
                            const std::function<scene::Camera()>& camera) {
    if (arguments.play.empty()) {
        return {{camera(), file}};
    }
    const scene::CameraPath path = io::readCameraPath(arguments.play);
    const PictureSequence sequence(file);
    std::vector<Shot> shots;
    for (unsigned i = 0; i < countPictures(scene::durationOf(path), arguments.framesPerSecond); ++i) {
        shots.push_back({scene::cameraAt(path, i / arguments.framesPerSecond), sequence.file(i)});
    }
    return shots;
}

/// What pictures see, by one line for each two pixels.
std::vector<image::Look> looksOf(const std::vector<Shot>& shots, gl::PixelSize size) {
    std::vector<image::Look> looks;
    for (const Shot& shot : shots) {
        looks.push_back({shot.camera, static_cast<double>(size.width) / size.height,
                         static_cast<std::uint32_t>(size.width / 2 + 1)});
    }
    return looks;
}

cli::ExitCode takePicture(const ViewArguments& arguments, const std::filesystem::path& file) {
    // A bad path or name is told before the solving, which may take long.
    cli::requireWritable(planShots(arguments, file, [] { return scene::Camera{}; }).front().file);
    checkPictureFile(file, arguments.look);
    const ui::InspectionView& view = arguments.look.inspection;
    if ((view.links || view.contributors || view.visibility) && !arguments.look.pick) {
        throw base::UsageError("--overlay links, contributors and visibility need the point of --pick X,Y");
    }
    // All that can fail before the solving, which may take long.
    const std::unique_ptr<gl::Context> context = makeContext(arguments.gl);
    Shown shown;
    std::optional<cli::Solved> solved;
    if (isLit(arguments.scene.scene)) {
        requireNoSolution(arguments.look);
        shown = loadLit(arguments.scene.scene);
    } else {
        if (!arguments.camera.name.empty()) {
            cli::chooseCamera(arguments.camera, cli::loadScene(arguments.scene), {});
        }
        solved = cli::runSolver("view", arguments.scene, arguments.solver, arguments.output);
        shown = {solved->scene, {}, solved->scene};
    }
    const std::vector<Shot> shots = planShots(arguments, file, [&] { return cameraFor(arguments, shown); });
    if (solved) {
        shown.snapshot = cli::showSolved(*solved, detailFor(arguments.look.draw), arguments.output,
                                         looksOf(shots, arguments.size));
    }
    std::optional<image::Inspection> inspection;
    if (arguments.look.pick) {
        inspection = inspectPixel(solved->solver->problem(), shots.front().camera, arguments.size,
                                  *arguments.look.pick);
    }
    std::vector<std::string> files;
    for (const Shot& shot : shots) {
        const auto& [scene, snapshot, solid] = shown;
        if (isLightFile(shot.file)) {
            const std::vector<float> light =
                drawLight(*context, scene, snapshot, shot.camera, arguments.size, arguments.look.samples);
            cli::writeOutput([&] { writeLight(shot.file, arguments.size, light); });
        } else {
            const std::vector<std::uint8_t> pixels = drawPicture(
                *context, scene, snapshot, shot.camera, arguments.size, arguments.look.draw,
                {inspection ? &*inspection : nullptr, arguments.look.inspection}, arguments.look.samples);
            cli::writeOutput([&] { writePixels(shot.file, arguments.size, pixels); });
        }
        files.push_back(shot.file.string());
    }
    if (!solved) {
        return cli::ExitCode::success;
    }
    if (inspection) {
        std::fputs(ui::describeInspection(*inspection, *shown.scene).c_str(), stdout);
    }
    cli::completeReport(*solved, files);
    cli::deliver(solved->report, arguments.output);
    return solved->exitCode();
}

/// What a window shows of the arguments' scene. Runs on any thread.
std::unique_ptr<Exhibit> makeExhibit(const ViewArguments& arguments) {
    auto exhibit = std::make_unique<Exhibit>();
    Shown shown;
    if (isLit(arguments.scene.scene)) {
        requireNoSolution(arguments.look);
        shown = loadLit(arguments.scene.scene);
    } else {
        const auto checkpointing = std::make_shared<cli::Checkpointing>(arguments.solver);
        shown.scene = std::make_shared<const scene::Scene>(cli::loadScene(arguments.scene));
        shown.solid = shown.scene;
        exhibit->options = checkpointing->options();
        exhibit->options->lighting =
            cli::turnLights(arguments.solver.lights, *shown.scene, exhibit->options->lighting);
        exhibit->solver.make = [checkpointing, scene = shown.scene,
                                threads = arguments.solver.threads](const solve::Options& options) {
            return checkpointing->makeSolver(scene, options, threads);
        };
        exhibit->solver.resumable = [checkpointing](const solve::Solver& solver, solve::Moment moment) {
            checkpointing->keep(solver, moment);
        };
        if (!arguments.output.quiet) {
            for (const std::string& warning : shown.scene->warnings) {
                cli::printWarning(warning);
            }
        }
    }
    if (cli::namesFile(arguments.scene.scene)) {
        exhibit->file = arguments.scene.scene;
    }
    exhibit->camera = cameraFor(arguments, shown);
    exhibit->look = arguments.look.draw;
    exhibit->inspection = arguments.look.inspection;
    exhibit->isProbing =
        exhibit->inspection.links || exhibit->inspection.contributors || exhibit->inspection.visibility;
    exhibit->scene = shown.scene;
    if (!exhibit->options) {
        exhibit->lit = std::make_shared<const solve::Snapshot>(std::move(shown.snapshot));
    }
    exhibit->solid = shown.solid;
    return exhibit;
}

/// Another scene, opened in the window: solved in the same way, seen from where it is good.
std::unique_ptr<Exhibit> openOther(const ViewArguments& arguments, const std::string& scene) {
    ViewArguments other;
    other.scene = arguments.scene;
    other.scene.scene = scene;
    other.solver = arguments.solver;
    other.solver.checkpoint.clear();
    other.solver.resume.clear();
    other.output = arguments.output;
    return makeExhibit(other);
}

cli::ExitCode openWindow(const ViewArguments& arguments, gl::WindowContext& window) {
    auto exhibit = makeExhibit(arguments);
    if (!arguments.play.empty()) {
        exhibit->path = io::readCameraPath(arguments.play);
    }
    walkThrough(window, std::move(exhibit),
                [&arguments](const std::string& scene) { return openOther(arguments, scene); });
    return cli::ExitCode::success;
}

cli::ExitCode runView(const ViewArguments& arguments) {
    checkLook(arguments.look);
    if (arguments.look.pick && !arguments.play.empty()) {
        throw base::UsageError("--pick needs one picture, --play makes many");
    }
    if (!arguments.camera.eye.empty()) {
        // Refused before the solving, which may take long.
        cli::chooseCamera(arguments.camera, {}, {});
    }
    if (!arguments.screenshot.empty()) {
        return takePicture(arguments, arguments.screenshot);
    }
    if (arguments.look.pick) {
        throw base::UsageError(
            "--pick needs --screenshot OUT.png; in the window, point at things and press I");
    }
    if (arguments.gl == GlChoice::egl || arguments.gl == GlChoice::osmesa) {
        throw base::UsageError("--gl egl and --gl osmesa have no window: add --screenshot OUT.png");
    }
    std::optional<gl::WindowContext> window;
    try {
        window.emplace("Fluxwalk", kWindowSize, true);
    } catch (const gl::ContextUnavailable& error) {
        if (arguments.gl == GlChoice::window || !arguments.play.empty()) {
            throw;
        }
        const std::filesystem::path file = std::filesystem::absolute(kFallbackPicture);
        cli::printWarning(std::string(error.what()) + "; writing a picture to " + file.string());
        return takePicture(arguments, file);
    }
    return openWindow(arguments, *window);
}

}  // namespace

cli::Command viewCommand() {
    return {
        "view", "Walk through a scene while it is solved, or through a lit mesh written by solve.",
        [](CLI::App& app) {
            const auto arguments = std::make_shared<ViewArguments>();
            cli::addSceneOptions(app, arguments->scene);
            cli::addCameraOptions(app, arguments->camera);
            app.add_option(
                   "--screenshot", arguments->screenshot,
                   "Solve, write a picture and end, without a window. A file named *.exr gets linear light "
                   "in cd/m\u00b2.")
                ->type_name("OUT.png|OUT.exr")
                ->group("Picture");
            app.add_option_function<std::string>(
                   "--size", [arguments](const std::string& text) { arguments->size = parseSize(text); },
                   "Size of the picture in pixels; 1280x720 by default.")
                ->type_name("WxH")
                ->group("Picture");
            app.add_option_function<std::string>(
                   "--gl",
                   [arguments](const std::string& text) {
                       arguments->gl = parseChoice("--gl", text, kGlChoices);
                   },
                   "What draws the picture: egl needs no display, osmesa is Mesa's software renderer, window "
                   "a display. By default egl, or osmesa where that cannot be had.")
                ->type_name("auto|egl|osmesa|window")
                ->group("Picture");
            app.add_option("--play", arguments->play,
                           "A recorded path to go along: in the window, or in the numbered pictures of "
                           "--screenshot OUT_%04d.png.")
                ->type_name("PATH.json")
                ->group("Picture");
            app.add_option_function<std::string>(
                   "--fps",
                   [arguments](const std::string& text) {
                       arguments->framesPerSecond = cli::parseNumberOption("--fps", text, 0.01, 1000.0, "Hz");
                   },
                   "Pictures for each second of the path; 30 by default.")
                ->type_name("N")
                ->group("Picture");
            app.footer(ui::describeKeys());
            addPictureOptions(app, arguments->look);
            addLookOptions(app, arguments->look);
            cli::addSolverOptions(app, arguments->solver);
            cli::addOutputOptions(app, arguments->output);
            return [arguments] { return runView(*arguments); };
        }};
}

}  // namespace fluxwalk::app
