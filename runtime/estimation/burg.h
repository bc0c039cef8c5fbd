// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {

/// Fits one autoregressive process to stretches of it, of any lengths, by forward and backward
/// errors of prediction within each: it is stable whatever is missing between them, which the
/// autocovariance of what is left does not promise. The order with the least Bayesian information
/// criterion (Schwarz 1978), of those for which there are errors enough.
/// @param stretches  without gaps; mean 0
/// Source: Burg 1975; of several stretches: de Waele and Broersen 2000.
AutoregressiveNoise autoregression_of(const std::vector<Eigen::VectorXd>& stretches,
                                      Eigen::Index most_order);

/// Stretches of a series between what does not count.
/// @param counted  (samples) 1 or 0
std::vector<Eigen::VectorXd> stretches_of(const Eigen::VectorXd& series,
                                          const Eigen::VectorXd& counted);

}  // namespace dyngen::runtime
