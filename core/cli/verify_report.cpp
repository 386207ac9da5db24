#include "core/cli/verify_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/cli/output.h"
#include "core/cli/reference_run.h"
#include "core/cli/report.h"
#include "core/image/sensors.h"
#include "core/io/file.h"

namespace fluxwalk::cli {

namespace {

double percent(double part) {
    return 100.0 * part;
}

}  // namespace

VerifyReport::VerifyReport(const Subject& subject, const reference::IrradianceTracer& tracer, double seconds,
                           const scene::Scene& scene, const rays::RayScene& rays)
    : subject_(subject),
      tracer_(tracer),
      seconds_(seconds),
      scene_(scene),
      rays_(rays),
      truth_(tracer.irradiance()),
      precision_(precisionOf(tracer)) {
    if (!subject.claims.empty()) {
        agreement_ = reference::compare(subject.claims, truth_);
    }
}

// The object at a sensor.
std::string VerifyReport::placeOf(std::size_t sensor) const {
    const scene::Sensor& s = subject_.sensors[sensor];
    const double reach = image::kCaptureReach * scene_.bounds().diagonal();
    const auto hit = rays_.closest({base::Vec3(s.position + reach * s.normal), 0.0f, base::Vec3(-s.normal),
                                    static_cast<float>(2.0 * reach)});
    return hit ? "on " + base::toOneLine(scene_.objects[base::index(hit->object)].name) : "in space";
}

std::string VerifyReport::text() const {
    const reference::NoiseCheck noise = tracer_.checkNoise();
    std::string text = fmt::format(
        "reference: {} paths at each of {} sensors, {:.3g} rays, {:.2f} million a second; standard error "
        "{:.2f} % of "
        "the mean\n"
        "  its noise: two halves of the paths differ by {:.2f} times what their standard errors say (chi2; 1 "
        "+- "
        "{:.2f} is expected)\n",
        tracer_.paths(), tracer_.sensorCount(), static_cast<double>(tracer_.rays()),
        1e-6 * static_cast<double>(tracer_.rays()) / std::max(seconds_, 1e-9), percent(precision_),
        noise.ratio, noise.deviation);
    if (subject_.claims.empty()) {
        return text;
    }
    const reference::Agreement& a = agreement_;
    if (a.count == 0) {
        return text + "nothing to compare: no sensor has a reference yet\n";
    }
    text += fmt::format(
        "{} against the reference at {} sensors, mean {:.4g} lx:\n"
        "  RMS {:.2f} % of the mean (the reference's own {:.2f} % taken off), bias {:+.2f} +- {:.2f} %\n",
        subject_.name, a.count, a.mean, percent(a.rms), percent(a.noise), percent(a.bias),
        percent(a.biasError));
    if (a.medianWidth > 0.0) {
        text += fmt::format(
            "  intervals: {} of {} hold the reference ({:.1f} %), {:.1f} % wide (median)\n", a.held, a.count,
            percent(static_cast<double>(a.held) / static_cast<double>(a.count)), percent(a.medianWidth));
    }
    text += "  worst:\n";
    for (const std::size_t i : a.worst) {
        const scene::Sensor& s = subject_.sensors[i];
        text += fmt::format("    {:.4g} lx, reference {:.4g} +- {:.2g} lx, at {:.3f},{:.3f},{:.3f} {}\n",
                            subject_.claims[i].value, truth_[i].luminance, truth_[i].luminanceError,
                            s.position.x, s.position.y, s.position.z, placeOf(i));
    }
    return text;
}

nlohmann::ordered_json VerifyReport::json() const {
    const reference::NoiseCheck noise = tracer_.checkNoise();
    nlohmann::ordered_json json = {
        {"command", "verify"},
        {"reference",
         {{"sensors", tracer_.sensorCount()},
          {"paths", tracer_.paths()},
          {"rays", tracer_.rays()},
          {"seconds", seconds_},
          {"standardError",
           std::isfinite(precision_) ? nlohmann::ordered_json(precision_) : nlohmann::ordered_json()},
          {"noise", {{"ratio", noise.ratio}, {"deviation", noise.deviation}, {"sensors", noise.count}}}}}};
    if (subject_.claims.empty()) {
        return json;
    }
    const reference::Agreement& a = agreement_;
    nlohmann::ordered_json worst = nlohmann::ordered_json::array();
    for (const std::size_t i : a.worst) {
        const scene::Sensor& s = subject_.sensors[i];
        worst.push_back({{"position", {s.position.x, s.position.y, s.position.z}},
                         {"place", placeOf(i)},
                         {"lux", subject_.claims[i].value},
                         {"reference", truth_[i].luminance},
                         {"standardError", truth_[i].luminanceError}});
    }
    json["agreement"] = {{"of", subject_.name},
                         {"sensors", a.count},
                         {"meanLux", a.mean},
                         {"rms", a.rms},
                         {"referenceNoise", a.noise},
                         {"bias", a.bias},
                         {"biasStandardError", a.biasError},
                         {"held", a.held},
                         {"medianIntervalWidth", a.medianWidth},
                         {"worst", std::move(worst)}};
    return json;
}

std::vector<double> VerifyReport::relativeDifferences() const {
    constexpr double kDark = 0.1;
    std::vector<double> differences;
    differences.reserve(truth_.size());
    for (std::size_t i = 0; i < truth_.size(); ++i) {
        const double scale = std::max(truth_[i].luminance, kDark * agreement_.mean);
        differences.push_back(std::isfinite(truth_[i].luminanceError) && scale > 0.0
                                  ? (subject_.claims[i].value - truth_[i].luminance) / scale
                                  : std::numeric_limits<double>::quiet_NaN());
    }
    return differences;
}

void deliver(const VerifyReport& report, const OutputArguments& output) {
    if (!output.report.empty()) {
        const std::string text = toText(report.json());
        writeOutput([&] { io::writeFile(output.report, text); });
    }
    if (output.json) {
        printText(toText(report.json()));
    } else if (!output.quiet) {
        printText(report.text());
    }
}

}  // namespace fluxwalk::cli
