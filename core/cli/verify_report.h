#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/cli/solver_arguments.h"
#include "core/rays/ray_scene.h"
#include "core/reference/agreement.h"
#include "core/reference/path_tracer.h"
#include "core/scene/scene.h"

namespace fluxwalk::cli {

/// What the reference is traced for.
struct Subject {
    std::vector<scene::Sensor> sensors;
    std::vector<reference::Claim>
        claims;        ///< of the sensors, in their order; empty where nothing is compared
    std::string name;  ///< whose claims
};

/// What `verify` found out.
class VerifyReport {
  public:
    /// Keeps references; `seconds`: that were traced.
    VerifyReport(const Subject& subject, const reference::IrradianceTracer& tracer, double seconds,
                 const scene::Scene& scene, const rays::RayScene& rays);

    /// A few lines for people.
    std::string text() const;
    nlohmann::ordered_json json() const;
    /// Claim - reference by the reference, or by a tenth of the reference's mean where that is more; NaN
    /// where there is no reference.
    std::vector<double> relativeDifferences() const;

  private:
    std::string placeOf(std::size_t sensor) const;

    const Subject& subject_;
    const reference::IrradianceTracer& tracer_;
    double seconds_;
    const scene::Scene& scene_;
    const rays::RayScene& rays_;
    std::vector<reference::Estimate> truth_;
    reference::Agreement agreement_;
    double precision_;
};

/// Writes and prints what the user asked for. Throws WriteError.
void deliver(const VerifyReport& report, const OutputArguments& output);

}  // namespace fluxwalk::cli
