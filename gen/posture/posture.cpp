// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/posture/posture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "gen/symbols/exact.h"
#include "gen/symbols/symbolic_robot.h"

namespace dyngen {
namespace {

using GiNaC::ex;
using Coordinates = std::vector<ex>;  ///< one per joint, exact

constexpr double kDegreeOfPosture = 57.29577951308232;

/// The positive number of one digit next to a length.
ex one_digit(double value) {
  const int power = static_cast<int>(std::floor(std::log10(value)));
  const long digit = std::lround(value / std::pow(10.0, power));
  return ex(digit) * GiNaC::pow(ex(10), power);
}

/// A length as long as those of the arm are in the mean.
ex typical_length(const SymbolicRobot& robot) {
  double sum = 0;
  int count = 0;
  for (const SymbolicLink& link : robot.links) {
    for (const ex& length : {link.d, link.r}) {
      if (!is_number(length) || length.is_zero()) continue;
      sum += std::abs(to_double(length));
      ++count;
    }
  }
  return count == 0 ? GiNaC::numeric(3, 10) : one_digit(sum / count);
}

/// Angles and lengths of the arm as numbers: what is unknown has the typical length.
struct NumericLengths {
  double typical = 0;
  [[nodiscard]] double operator()(const ex& length) const {
    return is_number(length) ? to_double(length) : typical;
  }
};

/// The frame at Rx(alpha) Tx(d) Rz(theta) Tz(r) of another one; and the axis's foot.
std::pair<Frame, Vec3> follow(const Frame& from, const ex& alpha, double d, const ex& theta,
                              double r) {
  const double ca = to_double(exact_cos(alpha)), sa = to_double(exact_sin(alpha));
  const double c = to_double(exact_cos(theta)), s = to_double(exact_sin(theta));
  const Vec3 turned = ca * from.y + sa * from.z;
  Frame frame;
  frame.z = ca * from.z - sa * from.y;
  frame.x = c * from.x + s * turned;
  frame.y = c * turned - s * from.x;
  const Vec3 foot = from.origin + d * from.x;
  frame.origin = foot + r * frame.z;
  return {frame, foot};
}

std::vector<PosedLink> place(const SymbolicRobot& robot, const NumericLengths& length,
                             const Coordinates& q) {
  std::vector<PosedLink> links;
  for (int j = 1; j <= robot.size(); ++j) {
    const SymbolicLink& link = robot.link(j);
    const ex& own = q[static_cast<std::size_t>(j - 1)];
    const bool slides = link.type == JointType::kPrismatic;
    PosedLink posed;
    posed.type = link.type;
    posed.parent = link.parent;
    posed.name = link.name;
    posed.q = to_double(own);
    const Frame parent =
        link.parent == 0 ? Frame{} : links[static_cast<std::size_t>(link.parent - 1)].frame;
    std::tie(posed.frame, posed.foot) =
        follow(parent, link.alpha, length(link.d), slides ? link.theta : link.theta + own,
               length(link.r) + (slides ? posed.q : 0));
    posed.tip = follow(posed.frame, link.tip_alpha, length(link.tip_d), 0, 0).first;
    links.push_back(std::move(posed));
  }
  return links;
}

struct Segment {
  Vec3 from, to;
};

std::vector<Segment> segments(const std::vector<PosedLink>& links) {
  std::vector<Segment> result;
  const auto add = [&](const Vec3& from, const Vec3& to) {
    if (norm(to - from) > 1e-9) result.push_back({from, to});
  };
  std::vector<bool> leaf(links.size(), true);
  for (const PosedLink& link : links) {
    const std::size_t parent = static_cast<std::size_t>(link.parent);
    if (parent > 0) leaf[parent - 1] = false;
    add(parent == 0 ? Vec3{} : links[parent - 1].frame.origin, link.foot);
    add(link.foot, link.frame.origin);
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (leaf[i]) add(links[i].frame.origin, links[i].tip.origin);
  }
  return result;
}

/// How much of two segments lies on the same line at the same place, m.
double shared_length(const Segment& a, const Segment& b) {
  const Vec3 line = unit(a.to - a.from);
  constexpr double kNear = 1e-9;
  for (const Vec3& end : {b.from, b.to}) {
    if (norm(cross(end - a.from, line)) > kNear) return 0;
  }
  const double from = dot(b.from - a.from, line), to = dot(b.to - a.from, line);
  return std::min(norm(a.to - a.from), std::max(from, to)) - std::max(0.0, std::min(from, to));
}

/// How much of the arm lies on other parts of it, m.
double folded_length(const std::vector<PosedLink>& links) {
  const std::vector<Segment> all = segments(links);
  double sum = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) sum += std::max(0.0, shared_length(all[i], all[k]));
  }
  return sum < 1e-9 ? 0 : sum;
}

bool within_limits(const JointModel& joint, const ex& q) {
  return (!joint.qmin || number_sign(q - *joint.qmin) >= 0) &&
         (!joint.qmax || number_sign(*joint.qmax - q) >= 0);
}

/// The one limit that there is, or the middle of both.
ex middle_of_limits(const JointModel& joint) {
  if (joint.qmin && joint.qmax) return (*joint.qmin + *joint.qmax) / 2;
  return joint.qmin ? *joint.qmin : *joint.qmax;
}

ex readable_coordinate(const JointModel& joint, const ex& typical) {
  if (joint.type == JointType::kFixed) return 0;
  if (joint.type == JointType::kPrismatic) {
    if (within_limits(joint, 0) && !joint.r.known_zero()) return 0;
    const bool typical_fits = within_limits(joint, typical);
    if (typical_fits && !(joint.qmin && joint.qmax)) return typical;
    const ex middle = middle_of_limits(joint);
    return typical_fits && is_zero_number(middle) ? typical : middle;
  }
  if (within_limits(joint, 0)) return 0;
  const ex middle = middle_of_limits(joint);
  const ex quarters = std::lround(to_double(middle / (GiNaC::Pi / 2))) * GiNaC::Pi / 2;
  return within_limits(joint, quarters) ? quarters : middle;
}

/// Bends one revolute joint if that makes the arm lie less on itself.
void unfold(const RobotModel& model, const SymbolicRobot& robot, const NumericLengths& length,
            Coordinates& q) {
  double folded = folded_length(place(robot, length, q));
  if (folded == 0) return;
  const Coordinates given = q;
  for (int j = 2; j <= model.size(); ++j) {  // the first joint turns the whole arm
    if (model.joint(j).type != JointType::kRevolute) continue;
    for (const int sign : {1, -1}) {
      Coordinates bent = given;
      ex& own = bent[static_cast<std::size_t>(j - 1)];
      own += sign * GiNaC::Pi / 2;
      if (!within_limits(model.joint(j), own)) continue;
      const double rest = folded_length(place(robot, length, bent));
      if (rest < folded - 1e-9) {
        folded = rest;
        q = bent;
      }
    }
  }
}

std::optional<Vec3> weight(const SymbolicRobot& robot) {
  for (const ex& component : robot.gravity) {
    if (!is_number(component)) return std::nullopt;
  }
  const auto pull = [&](std::size_t k) { return 0 - to_double(robot.gravity[k]); };
  return Vec3{pull(0), pull(1), pull(2)};
}

}  // namespace

Posture make_posture(const RobotModel& model) {
  const PrecisionScope precision;
  const SymbolicRobot robot = make_symbolic(model);
  const ex typical = typical_length(robot);
  const NumericLengths length{to_double(typical)};
  Coordinates q;
  for (const JointModel& joint : model.joints) q.push_back(readable_coordinate(joint, typical));
  unfold(model, robot, length, q);
  Posture posture;
  posture.links = place(robot, length, q);
  posture.weight = weight(robot);
  for (const FileSymbol& symbol : robot.geometry) {
    if (symbol.unit == "m") posture.stand_ins.push_back({symbol.name, length.typical});
  }
  return posture;
}

std::string configuration_text(const Posture& posture) {
  std::string text;
  int moved = 0, moving = 0;
  for (std::size_t i = 0; i < posture.links.size(); ++i) {
    const PosedLink& link = posture.links[i];
    if (link.type != JointType::kFixed) ++moving;
    if (link.q == 0) continue;
    ++moved;
    const bool slides = link.type == JointType::kPrismatic;
    text += fmt::format("{}joint {} at {:.4g} {}", text.empty() ? "" : ", ", i + 1,
                        slides ? link.q : link.q * kDegreeOfPosture, slides ? "m" : "deg");
  }
  if (moved == 0) return moving == 1 ? "the joint at 0" : "all joints at 0";
  if (moved == moving) return text;
  return text + (moving - moved == 1 ? ", the other at 0" : ", the others at 0");
}

std::string stand_in_text(const Posture& posture) {
  if (posture.stand_ins.empty()) return "";
  std::string names;
  for (const StandIn& length : posture.stand_ins) names += length.name + " = ";
  return fmt::format("{}{:.4g} m in place of {}", names, posture.stand_ins.front().value,
                     posture.stand_ins.size() == 1 ? "a run-time length" : "run-time lengths");
}

}  // namespace dyngen
