// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "runtime/effects/effect_rows.h"

namespace dyngen::runtime {

/// Triangles of the equations with effects, over and over at other points: what Householder's
/// reflections make of the model's own columns is kept, since effects change none of them, and only
/// the columns of effects are reflected and triangulated. A joint on which no effect acts has the
/// same triangle at all points.
///
/// Joints whose torque is late, or on which an effect acts that reads the model's parameters, have
/// other columns at every point: they are triangulated whole.
class ModelTriangles {
 public:
  /// @param data  must outlive it
  explicit ModelTriangles(const EffectRecordings& data);

  /// What factor_of() makes of linearised(), but for rounding.
  TorqueFactor at(EffectSignals& signals, const EffectPoint& point, const EffectUnknowns& unknowns);

 private:
  /// The model's columns of one joint in all runs.
  struct Joint {
    Eigen::MatrixXd reflected;  ///< (N x k) reflections below the diagonal, the triangle above; or
                                ///< nothing
    Eigen::VectorXd sizes;      ///< (k) of the reflections
    JointFactor alone;          ///< with the recorded torque
  };
  /// @param reflections  wanted too: they are as large as the columns
  const Joint& joint(int j, bool reflections);

  const EffectRecordings& data_;
  std::vector<std::optional<Joint>> joints_;
};

}  // namespace dyngen::runtime
