// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace blind {

/// A held-out rms of each joint as the suite measures it. The suite's is of all samples; an answer
/// leaves out those at which a joint stands, where friction may be anything. What both say of the
/// base model, fitted to the same recordings, gives the factor.
/// @param truth  its `heldout_base`; without one the rms stays as it is
/// @param base   (n) the base model's rms by the same answer   @param rms  (n)
/// @return       empty if lengths differ
std::vector<double> in_suite_measure(const nlohmann::json& truth, const nlohmann::json& base,
                                     const nlohmann::json& rms);

/// Root mean square over joints of an rms over the oracle's. @return 0 if lengths differ
double over_oracle(const nlohmann::json& truth, const std::vector<double>& rms);

}  // namespace blind
