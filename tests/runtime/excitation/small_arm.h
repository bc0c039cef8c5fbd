// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/excitation/motion_limits.h"
#include "runtime/model/linear_model.h"

namespace dyngen::test {

/// A made-up arm of two joints and four parameters whose regressor and gradient are written down:
///
///   Y = [ ddq1 + cos(q2) ddq2   cos(q1)   dq1   0              ]
///       [ cos(q2) ddq1          0         0     sin(q2) dq1^2  ]
runtime::LinearModel small_arm();

/// Limits of it, with which no torque limit binds.
runtime::MotionLimits small_arm_limits();

}  // namespace dyngen::test
