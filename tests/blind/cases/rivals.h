// SPDX-License-Identifier: MIT
// How well another kind of physics could pass for what was left out.
#pragma once

#include <map>
#include <string>

#include "tests/blind/cases/strength.h"
#include "tests/blind/truths/truth.h"

namespace blind {

/// For each family but the truth's own: the largest share of what the refit leaves of the truth
/// that a usual form of that family follows, on any joint that the truth acts on. Forms are columns
/// on the recorded motion.
/// @param left  whitened, of each training recording
std::map<std::string, double> imitated_shares(const Machine& machine, const Truth& truth,
                                              const std::vector<Recording>& training,
                                              const Whitener& whitener, const Refit& refit,
                                              const std::vector<Eigen::VectorXd>& left);

}  // namespace blind
