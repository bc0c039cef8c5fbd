// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/estimation/whitener.h"

namespace dyngen::runtime {

/// What any torque of a joint would change where EffectRun::unknown says that it is not known, in
/// the whitened equations of that joint in one run: taken out of them, they say what they say
/// whatever it was. Torque there is straight between points half an equation apart. What one point
/// changes lies in few equations, and the cost grows with their number; where noise has slow parts
/// it lies in many.
class UnknownTorque {
 public:
  UnknownTorque(const EffectRun& run, int joint, const Whitener& whitener);

  /// @param rows  (equations of the run x any), whitened, in place
  void take_out_of(Eigen::Ref<Eigen::MatrixXd> rows) const;
  /// Degrees of freedom that it takes from the equations.
  [[nodiscard]] Eigen::Index degrees() const;

 private:
  Eigen::SparseMatrix<double> columns_;  // (equations x points) of unit length; or no columns, and
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> products_;  // of their inner products
  // Of dense columns an orthonormal basis, from the last point to the first. It is 0 before a
  // point: some columns each, of the equations from there to the end of the run.
  std::vector<Eigen::MatrixXd> basis_;
};

}  // namespace dyngen::runtime
