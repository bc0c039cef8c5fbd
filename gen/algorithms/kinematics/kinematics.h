// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/code_model/link_form.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Velocities and accelerations of a link in one of its views.
struct LinkMotion {
  Vector3 W;   ///< angular velocity
  Vector3 WP;  ///< its derivative
  Matrix3 U;   ///< skew(WP) + skew(W) skew(W)
  Vector3 VP;  ///< acceleration of the origin, less gravity
  Vector3 WW;  ///< W2 W3, W1 W3, W1 W2
  Vector3 D;   ///< W2^2 - W3^2, W3^2 - W1^2, W1^2 - W2^2
};

/// The same in both views, and what the joint adds to the motion.
struct ChainMotion {
  LinkMotion link, axis;
  GiNaC::ex rate = 0;           ///< angular velocity about z against the anchor
  bool rides_on_anchor = true;  ///< the origin has the acceleration of the anchor's

  [[nodiscard]] const LinkMotion& in(View view) const { return view == View::kLink ? link : axis; }
};

/// What moves the robot.
struct MotionTerms {
  bool velocity = true;
  bool acceleration = true;
  bool gravity = true;
};

/// Writes the forward recursion of customised Newton-Euler; element 0 is the base. All quantities
/// are written in both views: what is not used goes with the dead code.
///
/// Source: Khalil and Dombre, "Modeling, Identification and Control of Robots", 2002, ch. 9
/// (forward recursive computation with the matrices U). Where the axes are at right angles or
/// parallel, the third column of U is carried over from the parent instead of WP: both links share
/// the axis z, so U z is the same vector in both, and it does not depend on the joint's own rate.
std::vector<ChainMotion> write_chain_motion(Trace& trace, const CodeModel& code,
                                            const std::vector<LinkFrame>& frames,
                                            const MotionTerms& terms, const RneaForm& form);

/// The motion in the links' frames alone, in the form that does without choices.
std::vector<LinkMotion> write_motion(Trace& trace, const CodeModel& code,
                                     const std::vector<LinkFrame>& frames,
                                     const MotionTerms& terms);

}  // namespace dyngen
