// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/rnea.h"

#include <fmt/format.h>

#include <vector>

namespace dyngen {
namespace {

using GiNaC::ex;

/// Force and moment about the origin, in the link's frame.
struct Wrench {
  Vector3 force = {0, 0, 0};
  Vector3 moment = {0, 0, 0};
};

ex chi(const CodeLink& link, Chi kind) { return link.chi[index(kind)]; }

Vector3 first_moments(const CodeLink& link) {
  return {chi(link, Chi::kMX), chi(link, Chi::kMY), chi(link, Chi::kMZ)};
}

/// F = M VP + U MS
Vector3 link_force(const CodeLink& link, const LinkMotion& motion) {
  const Vector3 ms = first_moments(link);
  Vector3 force;
  for (std::size_t k = 0; k < 3; ++k) {
    force[k] = chi(link, Chi::kM) * motion.VP[k];
    for (std::size_t i = 0; i < 3; ++i) force[k] += motion.U[k][i] * ms[i];
  }
  return force;
}

/// J WP + W x (J W), written with U.
Vector3 euler_moment(Trace& trace, int j, const CodeLink& link, const LinkMotion& motion) {
  const ex XX = chi(link, Chi::kXX), XY = chi(link, Chi::kXY), XZ = chi(link, Chi::kXZ);
  const ex YY = chi(link, Chi::kYY), YZ = chi(link, Chi::kYZ), ZZ = chi(link, Chi::kZZ);
  const Vector3& WP = motion.WP;
  const Vector3& WW = motion.WW;
  const Vector3& D = motion.D;
  const Matrix3& U = motion.U;
  const auto difference = [&](const char* name, const ex& a, const ex& b) {
    return trace.assign(fmt::format("{}_{}", name, j), a - b);
  };
  const ex zy = difference("ZmY", ZZ, YY), xz = difference("XmZ", XX, ZZ),
           yx = difference("YmX", YY, XX);
  return {XX * WP[0] + zy * WW[0] + XZ * U[1][0] - XY * U[2][0] + YZ * D[0],
          YY * WP[1] + xz * WW[1] + XY * U[2][1] - YZ * U[0][1] + XZ * D[1],
          ZZ * WP[2] + yx * WW[2] + YZ * U[0][2] - XZ * U[1][2] + XY * D[2]};
}

ex friction_torque(const CodeLink& link) {
  ex torque = chi(link, Chi::kFV) * link.dq + chi(link, Chi::kOFF);
  const ex FS = chi(link, Chi::kFS);
  if (!FS.is_zero()) torque += FS * GiNaC::csgn(link.dq);
  return torque;
}

/// Gravity alone, along the axis of a revolute joint, does no work about it.
bool gravity_along_axis(const LinkMotion& motion) {
  return motion.VP[0].is_zero() && motion.VP[1].is_zero();
}

}  // namespace

void write_rnea(Trace& trace, const CodeModel& code, const RneaTerms& terms) {
  const std::vector<LinkFrame> frames = write_frames(trace, code);
  const std::vector<LinkMotion> motions = write_motion(trace, code, frames, terms.motion);
  const bool standing = !terms.motion.velocity && !terms.motion.acceleration;

  std::vector<Wrench> total(code.links.size() + 1);  // of the links that hang on each
  std::vector<ex> torque(code.links.size() + 1);
  if (terms.wrench) {
    for (std::size_t k = 0; k < 3; ++k) {
      total.back().force[k] = -code.wrench[k];
      total.back().moment[k] = -code.wrench[k + 3];
    }
  }
  for (int j = code.size(); j >= 1; --j) {
    const CodeLink& link = code.link(j);
    const std::size_t at = static_cast<std::size_t>(j);
    const LinkMotion& motion = motions[at];
    const LinkFrame& frame = frames[at];
    Wrench& own = total[at];
    trace.section(
        fmt::format("backward, link {}: F force, N moment of the link about O{}; E, T with the "
                    "links it carries",
                    j, j));

    const Vector3 F = assign_vector(trace, "F", j, link_force(link, motion));
    Vector3 N = euler_moment(trace, j, link, motion);
    const Vector3 lever = cross(first_moments(link), motion.VP);
    for (std::size_t k = 0; k < 3; ++k) N[k] += lever[k];
    N = assign_vector(trace, "N", j, N);
    for (std::size_t k = 0; k < 3; ++k) {
      own.force[k] += F[k];
      own.moment[k] += N[k];
    }
    own.force = assign_vector(trace, "E", j, own.force);
    own.moment = assign_vector(trace, "T", j, own.moment);

    if (link.type == JointType::kRevolute) {
      torque[at] = standing && gravity_along_axis(motion) ? ex(0) : own.moment[2];
    } else if (link.type == JointType::kPrismatic) {
      torque[at] = own.force[2];
    }
    if (link.coordinate >= 0) {
      if (terms.rotor && terms.motion.acceleration) torque[at] += chi(link, Chi::kIA) * link.ddq;
      if (terms.friction) torque[at] += friction_torque(link);
    }
    if (link.parent == 0) continue;

    Wrench& parent = total[static_cast<std::size_t>(link.parent)];
    const Vector3 FA = assign_vector(
        trace, "FA", j, to_parent(trace, fmt::format("EA_{}", j), frame.rotation, own.force));
    const Vector3 TA = to_parent(trace, fmt::format("TA_{}", j), frame.rotation, own.moment);
    const Vector3 arm = cross(frame.P, FA);
    for (std::size_t k = 0; k < 3; ++k) {
      parent.force[k] += FA[k];
      parent.moment[k] += TA[k] + arm[k];
    }
  }
  trace.section("joint torques");
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& link = code.link(j);
    if (link.coordinate >= 0) {
      trace.output("tau", link.coordinate, torque[static_cast<std::size_t>(j)]);
    }
  }
}

void write_friction(Trace& trace, const CodeModel& code) {
  for (const CodeLink& link : code.links) {
    if (link.coordinate >= 0) trace.output("tau", link.coordinate, friction_torque(link));
  }
}

}  // namespace dyngen
