#include "viewer/app/render_command.h"

#include <chrono>
#include <filesystem>
#include <memory>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "core/cli/camera_arguments.h"
#include "core/cli/interrupt.h"
#include "core/cli/output.h"
#include "core/cli/progress.h"
#include "core/cli/run_solver.h"
#include "core/cli/values.h"
#include "core/image/still_options.h"
#include "viewer/app/first_view.h"
#include "viewer/app/look_arguments.h"
#include "viewer/app/picture_file.h"
#include "viewer/app/picture_size.h"
#include "viewer/app/still_file.h"

namespace fluxwalk::app {
namespace {

/// A still needs no finer solution: gathering makes its light several times more exact.
constexpr double kDefaultError = 0.03;

struct RenderArguments {
    cli::SceneArguments scene;
    cli::SolverArguments solver;
    cli::OutputArguments output;
    cli::CameraArguments camera;
    gl::PixelSize size{1280, 720};
    std::filesystem::path picture;
    LookArguments look;
    image::StillOptions still;
    bool asHalf = false;
};

// All that can be refused before the solving, which may take long.
void requireSound(const RenderArguments& arguments) {
    const std::string extension = arguments.picture.extension().string();
    const bool isLight = isLightFile(arguments.picture);
    if (!isLight && extension != ".png" && extension != ".PNG") {
        throw base::UsageError("--output: '" + arguments.picture.string() +
                               "' ends neither in .exr nor in .png");
    }
    if (isLight && arguments.look.draw.exposure) {
        throw base::UsageError("an .exr holds the light itself: --exposure is for .png");
    }
    if (!isLight && arguments.asHalf) {
        throw base::UsageError("--half is for .exr");
    }
    const auto pixels =
        static_cast<std::uint64_t>(arguments.size.width) * static_cast<std::uint64_t>(arguments.size.height);
    if (pixels > image::kMostPixels) {
        throw base::UsageError(fmt::format("--size: {}x{} are more than {} pixels, those of 7680x4320",
                                           arguments.size.width, arguments.size.height, image::kMostPixels));
    }
    cli::requireWritable(arguments.picture);
    if (!arguments.output.report.empty()) {
        cli::requireWritable(arguments.output.report);
    }
    if (!arguments.camera.eye.empty()) {
        cli::chooseCamera(arguments.camera, {}, {});
    } else if (!arguments.camera.name.empty()) {
        cli::chooseCamera(arguments.camera, cli::loadScene(arguments.scene), {});
    }
}

image::Still take(const RenderArguments& arguments, const cli::Solved& solved) {
    const solve::Problem& problem = solved.solver->problem();
    const scene::Camera camera = cli::chooseCamera(arguments.camera, *solved.scene, [&] {
        return chooseFirstView(problem.rays, solved.scene->bounds());
    });
    image::StillOptions options = arguments.still;
    options.width = static_cast<std::uint32_t>(arguments.size.width);
    options.height = static_cast<std::uint32_t>(arguments.size.height);
    options.seed = problem.options.seed;
    cli::Progress progress(stderr, cli::chooseStyle(stderr, arguments.output.quiet));
    image::StillCallbacks callbacks;
    callbacks.progress = [&](double fraction) { progress.update(fraction, "gathering"); };
    callbacks.shouldStop = [] { return cli::Interrupt::isRequested(); };
    return image::takeStill(problem, camera, options, callbacks);
}

void write(const RenderArguments& arguments, const image::Still& still) {
    const bool isLight = isLightFile(arguments.picture);
    const double exposure = isLight ? 0.0 : arguments.look.draw.exposure.value_or(meterStill(still));
    cli::writeOutput(
        [&] { writeStill(arguments.picture, still, exposure, arguments.look.draw.curve, arguments.asHalf); });
}

cli::ExitCode runRender(const RenderArguments& arguments) {
    requireSound(arguments);
    cli::Solved solved = cli::runSolver("render", arguments.scene, arguments.solver, arguments.output);
    const auto start = std::chrono::steady_clock::now();
    // A Ctrl-C that ended the solving leaves its picture to be taken; another one ends that too.
    const cli::Interrupt interrupt;
    const image::Still still = take(arguments, solved);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write(arguments, still);
    cli::completeReport(solved, {arguments.picture.string()});
    cli::deliver(solved.report, arguments.output);
    if (!arguments.output.quiet && !arguments.output.json) {
        cli::printText(fmt::format(
            "picture    {} of {} rows, {} points gathered, {:.1f} rays each, {}\n", still.rowsDone,
            still.height, still.gathers,
            static_cast<double>(still.rays) / static_cast<double>(std::max<std::uint64_t>(1, still.gathers)),
            cli::formatDuration(seconds)));
    }
    return still.rowsDone < still.height ? cli::ExitCode::interrupted : solved.exitCode();
}

void addRenderOptions(CLI::App& app, const std::shared_ptr<RenderArguments>& arguments) {
    app.add_option_function<std::string>(
           "--size", [arguments](const std::string& text) { arguments->size = parseSize(text); },
           "Size of the picture in pixels, up to those of 7680x4320; 1280x720 by default.")
        ->type_name("WxH")
        ->group("Picture");
    for (const image::StillOptionInfo& option : image::stillOptionsTable()) {
        const std::string name = "--" + std::string(option.name);
        app.add_option_function<std::string>(
               name,
               [arguments, name, &option](const std::string& text) {
                   option.set(arguments->still,
                              cli::parseCountOption(name, text, option.minimum, option.maximum));
               },
               fmt::format("{} Default {}; {} to {}.", option.explanation, option.defaultValue(),
                           option.minimum, option.maximum))
            ->type_name("N")
            ->group("Picture");
    }
    addToneOptions(app, arguments->look);
    app.add_flag("--half", arguments->asHalf,
                 "Light in an .exr as 16-bit floats: half the size, and nothing brighter than 65504.")
        ->group("Picture");
}

}  // namespace

cli::Command renderCommand() {
    return {"render", "Solve a scene and take a still of it, with light gathered anew at every pixel.",
            [](CLI::App& app) {
                const auto arguments = std::make_shared<RenderArguments>();
                arguments->solver.options.error = kDefaultError;
                arguments->solver.options.errorOf = solve::ErrorOf::gathered;
                cli::addSceneOptions(app, arguments->scene);
                cli::addCameraOptions(app, arguments->camera);
                addRenderOptions(app, arguments);
                cli::addSolverOptions(app, arguments->solver);
                app.add_option("-o,--output", arguments->picture,
                               "The picture: .png as the viewer would show it; .exr with linear light in "
                               "cd/m\u00b2 and the layers irradiance, albedo, normal and object.")
                    ->required()
                    ->type_name("OUT.exr|OUT.png")
                    ->group("Output");
                cli::addOutputOptions(app, arguments->output);
                return [arguments] { return runRender(*arguments); };
            }};
}

}  // namespace fluxwalk::app
