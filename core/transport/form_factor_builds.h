#pragma once

#include "core/transport/form_factor.h"

/// computePairFactor is compiled for more than one instruction set and picks one at run time. These name the
/// builds, so that a test can tell that they agree bit for bit.
namespace fluxwalk::transport {

PairFactor computePairFactorBaseline(const ElementPoints& a, const ElementPoints& b);
/// Needs a processor with AVX2.
PairFactor computePairFactorAvx2(const ElementPoints& a, const ElementPoints& b);

}  // namespace fluxwalk::transport
