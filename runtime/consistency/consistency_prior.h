// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/consistency/consistent_parameters.h"

namespace dyngen::runtime {

/// The prior as the search uses it: consistent everywhere.
struct ConsistencyPrior {
  std::vector<Eigen::Matrix4d> factors;  ///< (links) U0, the pseudo-inertia is J0 = U0 U0'
  Eigen::VectorXd chi;                   ///< (14 links) complete
  Eigen::VectorXd scale;  ///< (14 links) unit of distance of IA..OFF; not read of the ten
  std::string message;    ///< what was replaced, a sentence a line
};

/// Completes problem.prior. Sizes and options are checked before.
ConsistencyPrior complete_prior(const ConsistencyProblem& problem,
                                const ConsistencyOptions& options);

}  // namespace dyngen::runtime
