// SPDX-License-Identifier: MIT
// What is left to be seen by who does not know what friction does in the instant in which a joint
// stops, turns or lets go.
#pragma once

#include "tests/blind/cases/whitening.h"

namespace blind {

/// Times, in samples, at which a joint stops, turns, rests at a sample or lets go: where the
/// velocity is 0 by a line through it and the acceleration, between the samples of the event.
std::vector<double> instants_of(const Log& log, Eigen::Index joint);

/// Whitens the equations of one recording, less what impulses at these instants would change.
/// RestWhitener takes out what torque at the samples of a rest would change: what is known of
/// friction between the last of them and the next sample, and in the instant of a turn, stays.
class InstantWhitener {
 public:
  /// @param whitener  must outlive it
  InstantWhitener(const Whitener& whitener, const Log& log);
  /// @param rows  (N j x k)
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& rows) const;

 private:
  const Whitener& whitener_;
  std::vector<Eigen::MatrixXd> impulses_;  // of each joint, whitened, orthonormal
};

}  // namespace blind
