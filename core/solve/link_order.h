#pragma once

#include "core/solve/state.h"

namespace fluxwalk::solve {

/// Puts links with clusters first and lists the ends, after links changed.
void orderLinks(Problem& problem);

/// Brings the counters of nodes and links up to date.
void countLinks(Problem& problem);

}  // namespace fluxwalk::solve
