#pragma once

#include "core/solve/state.h"

/// Light before the first sweep, so that the oracle sees interreflection at once.
namespace fluxwalk::solve {

/// What the whole scene would get in lux if its light were mixed well and half of it lost. Also the unit of
/// the first threshold.
double estimateAmbient(const Problem& problem);

/// Gives everything that irradiance.
void seedRadiosity(Problem& problem, double ambient);

/// Takes all light away where nothing shines.
void darken(Problem& problem);

/// The threshold of the first level in lux.
double firstThreshold(OracleKind oracle, double ambient);

/// Of the channels and all sides that light reaches, in lux.
double meanIrradiance(const hierarchy::Hierarchy& h);

}  // namespace fluxwalk::solve
