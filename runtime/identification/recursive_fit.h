// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/identification/fit.h"

namespace dyngen::runtime {

/// A recursive estimator led over all samples of the data, as a control loop would.
/// @param method  kLms, kLmsMode, kRls or kKalman
MethodFit recursive_fit(FitMethod method, const FitData& data, const FitOptions& options);

}  // namespace dyngen::runtime
