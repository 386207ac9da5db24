#pragma once

#include <vector>

namespace fluxwalk::solve {

struct Problem;

/// By node: the error in lux that the links of a leaf, and of all that it is part of, leave in its
/// irradiance; 0 for other nodes. Each link's is what the oracle compares with the threshold (which spreads
/// power over the whole scene), brought to the area where its light arrives; those of several links are taken
/// as independent. An element's exchange with itself does not count.
std::vector<float> computeLinkErrors(Problem& problem);

}  // namespace fluxwalk::solve
