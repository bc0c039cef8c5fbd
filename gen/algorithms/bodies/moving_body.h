// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>

#include "gen/algorithms/bodies/link_inertia.h"
#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/kinematics/kinematics.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// What the derivatives of the torques need to know of a body, or of several that move on their
/// own: sums over its points r about a point O, with the velocity v of r against O.
struct MovingBody {
  Tensor K = {0, 0, 0, 0, 0, 0};  ///< integral of r r^T dm: XX XY XZ YY YZ ZZ
  Vector3 h = {0, 0, 0};          ///< integral of r dm
  GiNaC::ex m = 0;                ///< mass
  Matrix3 G;                      ///< integral of 2 v r^T dm
  Vector3 p = {0, 0, 0};          ///< integral of 2 v dm
  Vector3 f = {0, 0, 0};          ///< force that moves it
  Vector3 n = {0, 0, 0};          ///< its moment about O
};

/// How a point moves on from another: its place, and twice the difference of their velocities.
struct PointStep {
  Vector3 P = {0, 0, 0};
  Vector3 V2 = {0, 0, 0};
};

/// Begins the names of what is written: "C" and the link for a body about O of the link.
struct BodyName {
  std::string mark;
  int link = 0;
};

/// A rigid body that turns about O, which moves as the motion says.
/// @param rates  how many times v stands in G and p
MovingBody write_rigid_body(Trace& trace, const BodyName& name, const LinkInertia& inertia,
                            const LinkMotion& motion, int rates = 2);

/// A rigid body at rest: K, h and m alone.
MovingBody write_standing_body(Trace& trace, const BodyName& name, const LinkInertia& inertia);

void add(MovingBody& sum, const MovingBody& more);

/// Names every element that is a sum.
MovingBody assigned(Trace& trace, const BodyName& name, const MovingBody& body);

/// In axes of which the present ones are turned by the rotation's angle about z.
MovingBody turned_about_z(Trace& trace, const BodyName& name, const FrameRotation& rotation,
                          const MovingBody& body);
/// The same about x, by the rotation's alpha.
MovingBody turned_about_x(Trace& trace, const BodyName& name, const FrameRotation& rotation,
                          const MovingBody& body);

/// R A R^T, the same turns of any tensor. @param name  begins the names of help variables
Matrix3 turned_about_z(Trace& trace, const std::string& name, const FrameRotation& rotation,
                       const Matrix3& tensor);
Matrix3 turned_about_x(Trace& trace, const std::string& name, const FrameRotation& rotation,
                       const Matrix3& tensor);

/// About the point that sees the present one at step.P.
MovingBody moved(const PointStep& step, const MovingBody& body);

}  // namespace dyngen
