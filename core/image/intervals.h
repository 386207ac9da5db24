#pragma once

#include <span>
#include <vector>

#include "core/scene/sensor.h"
#include "core/solve/solution_errors.h"
#include "core/solve/solver.h"

/// Illuminance at sensors with its own error. An interval is made of what the gather and the solution know of
/// themselves; nobody has to know the truth.
namespace fluxwalk::image {

enum class IntervalKind : std::uint8_t {
    /// Holds the true illuminance for 99 of 100 sensors: 2.576 standard deviations made of the parts below,
    /// the
    /// weights of which were fixed on the Cornell box, the two rooms and the room with the sculpture, and are
    /// the same for all scenes (tests/image/intervals_test.cpp has others).
    likely,
    /// What the light could be at most and at least, given the solution's radiosities within three of their
    /// standard deviations (those alone stay an estimate): every source anywhere within its range over
    /// itself;
    /// from 0 to all of it seen, unless the space between is certainly empty; its form factor exact where it
    /// is
    /// planar and nowhere within bounds of the kernel where it is not; and no more than one hemisphere of
    /// sources in all.
    strict
};

/// Standard deviations in lux by cause.
struct ErrorParts {
    /// Shadow rays: from differences between the gather's own neighbouring samples, and from what as many
    /// rays that all agree may still have missed. Of sampled clusters their points, too.
    double shadows = 0.0;
    /// Sources are taken as uniform where opening them further promised little: their range of radiosity
    /// times how unevenly the point sees them.
    double range = 0.0;
    /// Form factors of curved sources by quadrature.
    double kernel = 0.0;
    /// The solution's own error (solve/solution_errors.h) as it reaches the sensor: of each patch as one, of
    /// patches as independent, and the error of what all reflected light lacks.
    double solution = 0.0;
    /// Parts of surfaces that lie in narrow gaps count as dark in the solution. Where a sensor sees such, as
    /// in the gap itself, they may be as bright as what else it sees.
    double gaps = 0.0;
    /// No deviation: what the sensor lacks if all reflected light lacks what the solution's probes found;
    /// negative where there is too much. The interval reaches so much farther on that side.
    double defect = 0.0;
};

/// Where a sensor is.
enum class SensorPlace : std::uint8_t {
    surface,  ///< on a side that light reaches
    space,
    /// Within a solid, or somewhere else where no light comes: what it looks upon are sides that light never
    /// reaches.
    solid
};

struct Measurement {
    base::Rgb irradiance{0.0f};  ///< lux
    double illuminance = 0.0;    ///< lux
    double low = 0.0;            ///< interval of the illuminance, lux
    double high = 0.0;
    ErrorParts parts;  ///< of IntervalKind::likely
    SensorPlace place = SensorPlace::space;
};

/// Values as image::measure() gives them, each with its interval.
std::vector<Measurement> measureIntervals(const solve::Solver& solver, std::span<const scene::Sensor> sensors,
                                          IntervalKind kind = IntervalKind::likely);

}  // namespace fluxwalk::image
