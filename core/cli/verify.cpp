#include <cmath>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/cli/core_commands.h"
#include "core/cli/output.h"
#include "core/cli/reference_run.h"
#include "core/cli/run_solver.h"
#include "core/cli/sensor_arguments.h"
#include "core/cli/sensor_files.h"
#include "core/cli/values.h"
#include "core/cli/verify_picture.h"
#include "core/cli/verify_report.h"
#include "core/image/chart.h"
#include "core/image/final_gather.h"
#include "core/image/sensors.h"
#include "core/io/image_write.h"
#include "core/io/sensors_csv.h"
#include "core/reference/random_sensors.h"
#include "core/solve/state.h"

namespace fluxwalk::cli {

namespace {

constexpr std::uint64_t kDefaultPaths = 1024;
constexpr std::uint64_t kDefaultPicturePaths = 64;
constexpr unsigned kDefaultPoints = 200;
constexpr unsigned kMostPoints = 1'000'000;

struct VerifyArguments {
    SceneArguments scene;
    SolverArguments solver;
    OutputArguments output;
    SensorArguments sensors;
    TraceLimits limits;
    ViewArguments view;
    unsigned points = 0;
    bool isComparing = false;
    std::filesystem::path measured;  ///< of --compare, empty to solve
    std::filesystem::path values;
};

// Points drawn by area over what light reaches, those within solids left out.
std::vector<scene::Sensor> drawPoints(const scene::Scene& scene, const rays::RayScene& rays,
                                      const hierarchy::ReachedSides& reached, std::size_t count,
                                      std::uint64_t seed) {
    std::vector<reference::ObjectSide> sides;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        for (const bool back : {false, true}) {
            if (reached.isReached(i, back)) {
                sides.push_back({i, back});
            }
        }
    }
    std::vector<scene::Sensor> sensors;
    if (sides.empty()) {
        throw base::UsageError("verify: the scene has no light");
    }
    // Drawn again where they are hidden; a scene of hidden points only would never end.
    for (std::uint64_t round = 0; sensors.size() < count && round < 100; ++round) {
        const std::vector<scene::Sensor> drawn =
            reference::randomSensors(scene, sides, count, base::combine(seed, round));
        for (const scene::Sensor& sensor : drawn) {
            if (sensors.size() < count && !image::isInSolid(rays, reached, sensor)) {
                sensors.push_back(sensor);
            }
        }
    }
    return sensors;
}

std::vector<scene::Sensor> makeSensors(const VerifyArguments& arguments, const SensorSource* source,
                                       const scene::Scene& scene, const rays::RayScene& rays,
                                       const hierarchy::ReachedSides& reached) {
    if (source != nullptr) {
        return source->make(scene, reached).sensors;
    }
    return drawPoints(scene, rays, reached, arguments.points > 0 ? arguments.points : kDefaultPoints,
                      arguments.solver.options.seed);
}

// A result of measure: its rows are the sensors.
Subject readSubject(const std::filesystem::path& file) {
    io::SensorTable table = io::readSensorTable(file);
    Subject subject;
    subject.name = file.string();
    const auto lux = table.find("lux");
    if (!lux) {
        throw base::FileError(file.string(), "line 1", "has no column lux: not a result of measure");
    }
    const auto low = table.find("low");
    const auto high = table.find("high");
    const auto solid = table.find("solid");
    for (std::size_t i = 0; i < table.sensors.size(); ++i) {
        if (solid && (*solid)[i] != 0.0) {
            continue;
        }
        const bool hasInterval = low && high;
        subject.sensors.push_back(table.sensors[i]);
        subject.claims.push_back(
            {(*lux)[i], hasInterval ? (*low)[i] : (*lux)[i], hasInterval ? (*high)[i] : (*lux)[i]});
    }
    if (subject.sensors.empty()) {
        throw base::FileError(file.string(), "", "holds no sensor outside solids");
    }
    return subject;
}

// Other random numbers than the solver's.
std::uint64_t referenceSeed(const VerifyArguments& arguments) {
    return base::combine(arguments.solver.options.seed, 0x7ef);
}

ExitCode traceAndTell(const VerifyArguments& arguments, const Subject& subject, const scene::Scene& scene,
                      const rays::RayScene& rays, const base::Executor& executor) {
    reference::IrradianceTracer tracer(scene, rays, executor, subject.sensors, referenceSeed(arguments));
    double seconds = 0.0;
    bool isStopped = false;
    {
        const solve::StageTimer timer(seconds);
        isStopped = traceUntil(tracer, arguments.limits, kDefaultPaths, arguments.output.quiet);
    }
    const std::vector<reference::Estimate> truth = tracer.irradiance();
    if (!arguments.values.empty()) {
        writeReference(arguments.values, subject.sensors, truth, tracer);
    }
    deliver(VerifyReport(subject, tracer, seconds, scene, rays), arguments.output);
    return isStopped ? ExitCode::interrupted : ExitCode::success;
}

// Leaves out what lies where no light comes, as the outside of a room.
void dropDark(SeenPoints& seen, const solve::Problem& problem) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < seen.sensors.size(); ++i) {
        if (!image::isInSolid(problem.rays, problem.hierarchy.reached(), seen.sensors[i])) {
            seen.sensors[kept] = seen.sensors[i];
            seen.pixels[kept++] = seen.pixels[i];
        }
    }
    seen.sensors.resize(kept);
    seen.pixels.resize(kept);
    if (kept == 0) {
        throw base::UsageError("the camera sees nothing that light reaches");
    }
}

// Irradiance in lux that a still of one sample a pixel gathers at some of these.
std::vector<base::Rgb> lightOfStill(const solve::Problem& problem, const scene::Camera& camera,
                                    const ViewArguments& view, std::span<const std::size_t> pixels) {
    image::StillOptions options;
    options.width = view.width;
    options.height = view.height;
    options.samples = 1;
    const image::Still still = image::takeStill(problem, camera, options);
    std::vector<base::Rgb> light;
    for (const std::size_t pixel : pixels) {
        light.emplace_back(still.irradiance[3 * pixel], still.irradiance[3 * pixel + 1],
                           still.irradiance[3 * pixel + 2]);
    }
    return light;
}

// Relative differences of a solution from the reference at what a camera sees, as a picture.
ExitCode drawDifferences(const VerifyArguments& arguments) {
    scene::Camera camera;
    const Solved solved =
        runSolver("verify", arguments.scene, arguments.solver, arguments.output,
                  [&](const scene::Scene& scene) { camera = chooseView(arguments.view, scene); });
    const solve::Problem& problem = solved.solver->problem();
    SeenPoints seen = arguments.view.isOfStill
                          ? lookAsStill(camera, arguments.view, problem)
                          : lookThrough(camera, arguments.view, problem.rays, *problem.scene);
    if (!arguments.view.isOfStill) {
        dropDark(seen, problem);
    }
    const std::vector<base::Rgb> values = arguments.view.isOfStill
                                              ? lightOfStill(problem, camera, arguments.view, seen.pixels)
                                              : image::measure(*solved.solver, seen.sensors);
    const std::shared_ptr<const scene::Scene> lit =
        scene::relightScene(problem.scene, solved.solver->options().lighting);
    reference::IrradianceTracer tracer(*lit, problem.rays, problem.executor, seen.sensors,
                                       referenceSeed(arguments));
    double seconds = 0.0;
    bool isStopped = false;
    {
        const solve::StageTimer timer(seconds);
        isStopped = traceUntil(tracer, arguments.limits, kDefaultPicturePaths, arguments.output.quiet);
    }
    Subject subject{std::move(seen.sensors), {}, "the solution"};
    for (const base::Rgb& value : values) {
        const double lux = base::luminance(base::Vec3d(value));
        subject.claims.push_back({lux, lux, lux});
    }
    const VerifyReport report(subject, tracer, seconds, *lit, problem.rays);
    const std::vector<double> differences = report.relativeDifferences();
    std::vector<double> pixels(std::size_t{arguments.view.width} * arguments.view.height, NAN);
    for (std::size_t i = 0; i < differences.size(); ++i) {
        pixels[seen.pixels[i]] = differences[i];
    }
    const std::vector<double> shown =
        image::blurKnown(arguments.view.width, arguments.view.height, pixels, arguments.view.blur);
    const image::Picture picture = image::drawDifference(arguments.view.width, arguments.view.height, shown,
                                                         image::chooseDifferenceRange(shown));
    writeOutput([&] { io::writePng(arguments.values, picture.width, picture.height, picture.pixels); });
    deliver(report, arguments.output);
    return isStopped ? ExitCode::interrupted : solved.exitCode();
}

void requireSense(const VerifyArguments& arguments) {
    const bool isPicture = arguments.values.extension() == ".png";
    if (arguments.view.isAsked() != isPicture) {
        throw base::UsageError(
            isPicture ? "--output: a picture of differences needs --camera, or --eye and --target"
                      : "--camera, --eye: -o must name the picture of differences, a .png");
    }
    if (isPicture && (arguments.isComparing || arguments.points > 0 || arguments.sensors.grid ||
                      !arguments.sensors.sensors.empty())) {
        throw base::UsageError(
            "a picture of differences has its own points: no --compare, --sensors, --grid or "
            "--points with it");
    }
    if (!isPicture && (arguments.view.isOfStill || arguments.view.blur > 0.0)) {
        throw base::UsageError("--still, --blur: only with a camera and -o DIFFERENCES.png");
    }
    if (arguments.isComparing && !arguments.measured.empty() &&
        (arguments.points > 0 || arguments.sensors.grid || !arguments.sensors.sensors.empty())) {
        throw base::UsageError(
            "--compare FILE brings its own sensors: no --sensors, --grid or --points with it");
    }
    for (const std::filesystem::path& file : {arguments.values, arguments.output.report}) {
        if (!file.empty()) {
            requireWritable(file);
        }
    }
}

ExitCode runVerify(const VerifyArguments& arguments) {
    requireSense(arguments);
    if (arguments.view.isAsked()) {
        return drawDifferences(arguments);
    }
    const bool hasSource = !arguments.sensors.sensors.empty() || arguments.sensors.grid;
    const std::unique_ptr<const SensorSource> source =
        hasSource ? std::make_unique<SensorSource>(arguments.sensors, "verify") : nullptr;
    if (arguments.isComparing && arguments.measured.empty()) {
        const Solved solved = runSolver("verify", arguments.scene, arguments.solver, arguments.output,
                                        [&](const scene::Scene& scene) {
                                            if (source) {
                                                source->check(scene);
                                            }
                                        });
        const solve::Problem& problem = solved.solver->problem();
        Subject subject;
        subject.name = "the solution";
        for (const scene::Sensor& sensor : makeSensors(arguments, source.get(), *problem.scene, problem.rays,
                                                       problem.hierarchy.reached())) {
            if (!image::isInSolid(problem.rays, problem.hierarchy.reached(), sensor)) {
                subject.sensors.push_back(sensor);
            }
        }
        for (const image::Measurement& m : image::measureIntervals(*solved.solver, subject.sensors)) {
            subject.claims.push_back({m.illuminance, m.low, m.high});
        }
        const std::shared_ptr<const scene::Scene> lit =
            scene::relightScene(problem.scene, solved.solver->options().lighting);
        return traceAndTell(arguments, subject, *lit, problem.rays, problem.executor);
    }
    Subject subject = arguments.isComparing ? readSubject(arguments.measured) : Subject{};
    const auto original = std::make_shared<const scene::Scene>(loadScene(arguments.scene));
    if (!arguments.output.quiet) {
        for (const std::string& warning : original->warnings) {
            printWarning(warning);
        }
    }
    const std::shared_ptr<const scene::Scene> scene =
        scene::relightScene(original, turnLights(arguments.solver.lights, *original, {}));
    const base::Executor executor(arguments.solver.threads);
    const rays::RayScene rays(*scene, executor);
    if (!arguments.isComparing) {
        if (source) {
            source->check(*scene);
        }
        const hierarchy::ReachedSides reached =
            hierarchy::findReachedSides(*scene, rays, executor, arguments.solver.options.seed);
        subject.sensors = makeSensors(arguments, source.get(), *scene, rays, reached);
    }
    return traceAndTell(arguments, subject, *scene, rays, executor);
}

}  // namespace

Command verifyCommand() {
    return {"verify", "Trace the illuminance at sensors by Monte Carlo, with standard errors, and compare.",
            [](CLI::App& app) {
                const auto arguments = std::make_shared<VerifyArguments>();
                arguments->solver.options.errorOf = solve::ErrorOf::gathered;
                addSceneOptions(app, arguments->scene);
                addSensorOptions(app, arguments->sensors);
                app.add_option_function<std::string>(
                       "--points",
                       [arguments](const std::string& text) {
                           arguments->points = parseCountOption("--points", text, 1, kMostPoints);
                       },
                       fmt::format(
                           "Sensors drawn by area over all that light reaches instead. Default {} where no "
                           "others are named.",
                           kDefaultPoints))
                    ->type_name("N")
                    ->excludes("--sensors")
                    ->excludes("--grid")
                    ->group("Sensors");
                addTraceOptions(app, arguments->limits);
                addViewOptions(app, arguments->view);
                app.add_option_function<std::vector<std::string>>(
                       "--compare",
                       [arguments](const std::vector<std::string>& files) {
                           arguments->isComparing = true;
                           arguments->measured = files.empty() ? std::string() : files.front();
                       },
                       "Say how a result of measure agrees with the reference at its sensors: RMS, bias, how "
                       "many "
                       "intervals hold, the worst places. Without a file the scene is solved first.")
                    ->expected(0, 1)
                    ->type_name("[MEASURED.csv]")
                    ->group("Reference");
                addSolverOptions(app, arguments->solver);
                app.add_option(
                       "-o,--output", arguments->values,
                       "Rows x,y,z,nx,ny,nz with E_r,E_g,E_b, lux and their standard errors se_r, se_g, "
                       "se_b, se_lux; a name that ends in .json gets JSON.")
                    ->type_name("OUT.csv|json|png")
                    ->group("Output");
                addOutputOptions(app, arguments->output);
                return [arguments] { return runVerify(*arguments); };
            }};
}

}  // namespace fluxwalk::cli
