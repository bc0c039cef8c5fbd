// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/bodies/centroid.h"

#include <fmt/format.h>

#include <vector>

#include "gen/algorithms/bodies/standing_composites.h"
#include "gen/algorithms/kinematics/axes.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/symbols/index.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// The links as bodies, as far as a trace has named them.
std::vector<LinkInertia> bodies_of_links(const CodeModel& code) {
  std::vector<LinkInertia> result(code.bodies.links.size() + 1);
  result[0].tensor.fill(0);
  result[0].MS = {0, 0, 0};
  result[0].M = 0;
  for (std::size_t j = 0; j < code.bodies.links.size(); ++j) {
    const auto& chi = code.bodies.links[j];
    LinkInertia& own = result[j + 1];
    for (std::size_t k = 0; k < own.tensor.size(); ++k) own.tensor[k] = chi[k];
    for (std::size_t k = 0; k < 3; ++k) own.MS[k] = chi[index(Chi::kMX) + k];
    own.M = chi[index(Chi::kM)];
  }
  return result;
}

struct CentroidRobot {
  std::vector<LinkFrame> frames;
  StandingComposites bodies;
};

CentroidRobot write_robot(Trace& trace, const CodeModel& code) {
  CentroidRobot robot;
  robot.frames = write_frames(trace, code);
  robot.bodies = write_standing_composites(trace, code, robot.frames, bodies_of_links(code));
  return robot;
}

ex write_inverse_mass(Trace& trace, const CentroidRobot& robot) {
  trace.section("one over the mass of all links");
  return trace.assign("MI", GiNaC::pow(robot.bodies.robot.m, -1));
}

std::vector<int> all_links(const CodeModel& code) {
  std::vector<int> links;
  for (int j = 1; j <= code.size(); ++j) links.push_back(j);
  return links;
}

}  // namespace

std::string why_no_centroid(const CodeModel& code) { return code.bodies.why_absent; }

void write_center_of_mass(Trace& trace, const CodeModel& code) {
  const CentroidRobot robot = write_robot(trace, code);
  const ex inverse = write_inverse_mass(trace, robot);
  for (std::size_t k = 0; k < 3; ++k) {
    trace.output("p", static_cast<int>(k), robot.bodies.robot.h[k] * inverse);
  }
  trace.output("mass", 0, robot.bodies.robot.m);
}

void write_center_of_mass_jacobian(Trace& trace, const CodeModel& code) {
  const CentroidRobot robot = write_robot(trace, code);
  const ex inverse = write_inverse_mass(trace, robot);
  const std::vector<Axes> axes = write_axes(trace, robot.frames, all_links(code));
  trace.section("velocity of the centre of mass per joint rate");
  const int n = static_cast<int>(code.coordinate_names.size());
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& link = code.link(j);
    if (link.coordinate < 0) continue;
    const MovingBody& body = robot.bodies.in_axis[at(j)];
    const FrameRotation& r = robot.frames[at(j)].from_anchor;
    const Axes& anchor = axes[at(robot.frames[at(j)].anchor)];
    const auto assign = [&](const char* name, const ex& value) {
      return trace.assign(fmt::format("{}_{}", name, j), value);
    };
    const bool revolute = link.type == JointType::kRevolute;
    const ex along_x = revolute ? assign("HX", body.h[1] * inverse) : ex(0);
    const ex along_y = revolute ? assign("HY", body.h[0] * inverse) : ex(0);
    const ex along_z = revolute ? ex(0) : assign("MZ", body.m * inverse);
    for (int k = 0; k < 3; ++k) {
      const ex across = trace.assign(fmt::format("w{}_{}", k + 1, j),
                                     r.cos_alpha * anchor.y[at(k)] + r.sin_alpha * anchor.z[at(k)]);
      trace.output("J", k * n + link.coordinate,
                   along_y * across - along_x * anchor.x[at(k)] + along_z * axes[at(j)].z[at(k)]);
    }
  }
}

void write_momentum(Trace& trace, const CodeModel& code) {
  struct Momentum {
    Vector3 linear = {0, 0, 0}, angular = {0, 0, 0};
    void add(const Vector3& more_linear, const Vector3& more_angular) {
      for (std::size_t k = 0; k < 3; ++k) {
        linear[k] += more_linear[k];
        angular[k] += more_angular[k];
      }
    }
  };
  const CentroidRobot robot = write_robot(trace, code);
  std::vector<Momentum> in_axis(robot.frames.size()), in_link(robot.frames.size());
  for (int j = code.size(); j >= 1; --j) {
    trace.section(fmt::format("momentum that joints {} and beyond give, about O{}", j, j));
    const CodeLink& link = code.link(j);
    const LinkFrame& frame = robot.frames[at(j)];
    const auto& [K, h, m, G, p, f, n] = robot.bodies.in_axis[at(j)];
    Momentum own = in_axis[at(j)];
    const Momentum& beyond = in_link[at(j)];
    own.add(turn(frame.from_anchor, beyond.linear), turn(frame.from_anchor, beyond.angular));
    if (link.type == JointType::kRevolute) {
      const ex Jzz = trace.assign(fmt::format("JZZ_{}", j), K[0] + K[3]);
      own.add({-h[1] * link.dq, h[0] * link.dq, 0},
              {-K[2] * link.dq, -K[4] * link.dq, Jzz * link.dq});
    } else if (link.type == JointType::kPrismatic) {
      own.add({0, 0, m * link.dq}, {h[1] * link.dq, -h[0] * link.dq, 0});
    }
    own.linear = assign_vector(trace, "PL", j, own.linear);
    own.angular = assign_vector(trace, "PA", j, own.angular);

    const FrameRotation fixed = without_turn(frame.rotation);
    const Vector3 linear = assign_vector(
        trace, "PLA", j, to_parent(trace, fmt::format("PLX_{}", j), fixed, own.linear));
    Vector3 angular = to_parent(trace, fmt::format("PAX_{}", j), fixed, own.angular);
    const Vector3 lever = cross(write_step_to_parent(trace, code, robot.frames, j), linear);
    for (std::size_t k = 0; k < 3; ++k) angular[k] += lever[k];
    (frame.parallel ? in_axis : in_link)[at(link.parent)].add(linear, angular);
  }
  trace.section("momentum");
  for (std::size_t k = 0; k < 3; ++k) {
    trace.output("h", static_cast<int>(k), in_link[0].linear[k]);
    trace.output("h", static_cast<int>(k) + 3, in_link[0].angular[k]);
  }
}

}  // namespace dyngen
