#include <cmath>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/cli/core_commands.h"
#include "core/cli/output.h"
#include "core/cli/reference_run.h"
#include "core/cli/run_solver.h"
#include "core/cli/sensor_arguments.h"
#include "core/cli/sensor_files.h"
#include "core/cli/values.h"
#include "core/image/sensors.h"
#include "core/io/sensors_csv.h"
#include "core/reference/agreement.h"
#include "core/reference/random_sensors.h"
#include "core/solve/state.h"

namespace fluxwalk::cli {

namespace {

constexpr std::uint64_t kDefaultPaths = 1024;
constexpr unsigned kDefaultPoints = 200;
constexpr unsigned kMostPoints = 1'000'000;

struct VerifyArguments {
    SceneArguments scene;
    SolverArguments solver;
    OutputArguments output;
    SensorArguments sensors;
    TraceLimits limits;
    unsigned points = 0;
    bool isComparing = false;
    std::filesystem::path measured;  ///< of --compare, empty to solve
    std::filesystem::path values;
};

// What is compared with the reference.
struct Subject {
    std::vector<scene::Sensor> sensors;
    std::vector<reference::Claim> claims;  ///< empty where nothing is compared
    std::string name;
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

// The object at a sensor; "in space" where it sits on none.
std::string nameOfPlace(const scene::Scene& scene, const rays::RayScene& rays, const scene::Sensor& sensor) {
    const double reach = image::kCaptureReach * scene.bounds().diagonal();
    const auto hit = rays.closest({base::Vec3(sensor.position + reach * sensor.normal), 0.0f,
                                   base::Vec3(-sensor.normal), static_cast<float>(2.0 * reach)});
    return hit ? "on " + base::toOneLine(scene.objects[base::index(hit->object)].name) : "in space";
}

std::string describeAgreement(const Subject& subject, const std::vector<reference::Estimate>& truth,
                              const scene::Scene& scene, const rays::RayScene& rays) {
    const reference::Agreement a = reference::compare(subject.claims, truth);
    if (a.count == 0) {
        return "nothing to compare: no sensor has a reference yet\n";
    }
    std::string text = fmt::format(
        "{} against the reference at {} sensors, mean {:.4g} lx:\n"
        "  RMS {:.2f} % of the mean (the reference's own {:.2f} % taken off), bias {:+.2f} +- {:.2f} %\n",
        subject.name, a.count, a.mean, 100.0 * a.rms, 100.0 * a.noise, 100.0 * a.bias, 100.0 * a.biasError);
    if (a.medianWidth > 0.0) {
        text += fmt::format(
            "  intervals: {} of {} hold the reference ({:.1f} %), {:.1f} % wide (median)\n", a.held, a.count,
            100.0 * static_cast<double>(a.held) / static_cast<double>(a.count), 100.0 * a.medianWidth);
    }
    text += "  worst:\n";
    for (const std::size_t i : a.worst) {
        const scene::Sensor& s = subject.sensors[i];
        text += fmt::format("    {:.4g} lx, reference {:.4g} +- {:.2g} lx, at {:.3f},{:.3f},{:.3f} {}\n",
                            subject.claims[i].value, truth[i].luminance, truth[i].luminanceError,
                            s.position.x, s.position.y, s.position.z, nameOfPlace(scene, rays, s));
    }
    return text;
}

std::string describeReference(const reference::IrradianceTracer& tracer, double seconds) {
    const reference::NoiseCheck noise = tracer.checkNoise();
    return fmt::format(
        "reference: {} paths at each of {} sensors, {:.3g} rays, {:.2f} million a second; standard error "
        "{:.2f} % of "
        "the mean\n"
        "  its noise: two halves of the paths differ by {:.2f} times what their standard errors say (chi2; 1 "
        "+- "
        "{:.2f} is expected)\n",
        tracer.paths(), tracer.sensorCount(), static_cast<double>(tracer.rays()),
        1e-6 * static_cast<double>(tracer.rays()) / std::max(seconds, 1e-9), 100.0 * precisionOf(tracer),
        noise.ratio, noise.deviation);
}

ExitCode traceAndTell(const VerifyArguments& arguments, const Subject& subject, const scene::Scene& scene,
                      const rays::RayScene& rays, const base::Executor& executor) {
    // Other random numbers than the solver's.
    const std::uint64_t seed = base::combine(arguments.solver.options.seed, 0x7ef);
    reference::IrradianceTracer tracer(scene, rays, executor, subject.sensors, seed);
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
    if (!arguments.output.quiet) {
        std::string text = describeReference(tracer, seconds);
        if (!subject.claims.empty()) {
            text += describeAgreement(subject, truth, scene, rays);
        }
        printText(text);
    }
    return isStopped ? ExitCode::interrupted : ExitCode::success;
}

ExitCode runVerify(const VerifyArguments& arguments) {
    if (!arguments.values.empty()) {
        requireWritable(arguments.values);
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
                    ->excludes("--sensors")
                    ->group("Reference");
                addSolverOptions(app, arguments->solver);
                app.add_option(
                       "-o,--output", arguments->values,
                       "Rows x,y,z,nx,ny,nz with E_r,E_g,E_b, lux and their standard errors se_r, se_g, "
                       "se_b, se_lux; a name that ends in .json gets JSON.")
                    ->type_name("OUT.csv|json")
                    ->group("Output");
                addOutputOptions(app, arguments->output);
                return [arguments] { return runVerify(*arguments); };
            }};
}

}  // namespace fluxwalk::cli
