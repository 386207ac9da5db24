#pragma once

#include <cstdint>

#include "core/scene/scene.h"

/// Pathological scenes: each is to be solved, or refused by a clear word, but never to hang or crash.
namespace fluxwalk::test {

/// A square of 1 m2 that emits 100 lm/m2, and nothing else.
scene::Scene buildOnePolygon();

/// Room of 4 x 3 x 4 m with a lamp of 1 m2 (object "lamp", 1000 lm/m2) under its ceiling, and `count` squares
/// of 1 m2, each an object, in one and the same place (bitwise) 1 m above the floor.
scene::Scene buildCoincident(unsigned count);

/// Closed room around a floor 2,000 km wide, 3 m high, and on it a lamp and a table of 2 m: the floor's sides
/// are a million times longer than theirs.
scene::Scene buildHugePolygon();

/// Furnished room of 4 x 3 x 4 m with a lamp whose corner is at (1e6, 1e6, 1e6) m; all coordinates are exact
/// in float, whose steps there are 1/16 m.
scene::Scene buildFarAway();

/// Closed room of 10 x 10 x 10 m (object 0) full of `count` random triangles with edges of 2 to 20 cm, in
/// objects of 50; one object of ten emits 50 lm/m2 from both sides.
scene::Scene buildCloud(unsigned count, std::uint64_t seed);

}  // namespace fluxwalk::test
