#pragma once

#include <vector>

namespace fluxwalk::solve {

struct Problem;

/// By node: the error in lux that the links of a leaf, and of all that it is part of, leave in its light; 0
/// for other nodes. Each link's is what the oracle compares with the threshold (which spreads power over the
/// area of the whole scene, so that small elements may be more wrong); those of several links are taken as
/// independent. An element's exchange with itself does not count.
std::vector<float> computeLinkErrors(Problem& problem);

}  // namespace fluxwalk::solve
