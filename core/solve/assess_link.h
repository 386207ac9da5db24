#pragma once

#include <limits>

#include "core/solve/state.h"

namespace fluxwalk::solve {

/// The oracle's judgement of a link between two different nodes, from what the link keeps and the radiosities
/// that stand: a new pair and a standing link are judged alike. Where samples alone already say more than
/// `enough` (lux), strict bounds are spared.
transport::LinkAssessment assessLink(const Problem& problem, const hierarchy::Link& link,
                                     float enough = std::numeric_limits<float>::infinity());

}  // namespace fluxwalk::solve
