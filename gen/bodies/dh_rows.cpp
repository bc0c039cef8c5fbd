// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/bodies/dh_rows.h"

#include <algorithm>
#include <cmath>

namespace dyngen {

namespace {

/// A common normal farther from the joint than this many times the distance of the joints makes
/// large lengths that nearly cancel: ten cost one digit.
constexpr Real kFarNormal = 10;

std::size_t group_index(int index) { return static_cast<std::size_t>(index); }

struct AxisLine {
  Vector3 point{};
  Vector3 direction{};  // a unit vector
};

Real same_or_zero(Real length) { return std::fabs(length) < kSameLength ? 0 : length; }

/// In (-pi, pi].
Real angle_of(Real sine, Real cosine) {
  const Real angle = rounded_angle(std::atan2(sine, cosine), kSameAngle);
  return angle <= -kRealPi ? kRealPi : angle;
}

Pose turned_about_z(Real theta, Real r) { return {turn_z(theta), {{0, 0, r}}}; }
Pose turned_about_x(Real alpha, Real d) { return {turn_x(alpha), {{d, 0, 0}}}; }

/// From a frame to a line: Rz(gamma) Tz(b), perhaps Tx(offset) Rz(turn) Tz(rise), then Rx(alpha)
/// Tx(d), whose z is the line.
struct AxisReach {
  Real gamma = 0, b = 0;
  bool far = false;  // the step in the middle is needed
  Real offset = 0, turn = 0, rise = 0;
  Real alpha = 0, d = 0;
};

/// Turns by half a turn are spared: alpha and d change their signs instead.
void spare_half_turn(Real& gamma, Real& alpha, Real& d) {
  if (gamma > -kRealPi / 2 + kSameAngle && gamma <= kRealPi / 2 + kSameAngle) return;
  gamma = rounded_angle(gamma > 0 ? gamma - kRealPi : gamma + kRealPi, kSameAngle);
  if (alpha < kRealPi - kSameAngle) alpha = -alpha;  // half a turn is its own opposite
  d = -d;
}

AxisReach reach_of(const AxisLine& line) {
  const Vector3& u = line.direction;
  const Vector3& p = line.point;
  const Real tilt = std::hypot(u[0], u[1]);
  const Real beside = std::hypot(p[0], p[1]);
  AxisReach result;
  if (tilt < kSameAngle) {
    result.alpha = u[2] > 0 ? 0 : kRealPi;
    result.d = same_or_zero(beside);
    if (result.d == 0) return result;
    result.gamma = angle_of(p[1], p[0]);
    spare_half_turn(result.gamma, result.alpha, result.d);
    return result;
  }
  // the common normal's direction, z x u, and where it meets both lines
  const Vector3 normal = {{-u[1] / tilt, u[0] / tilt, 0}};
  const Real along = -(p[0] * u[0] + p[1] * u[1]) / (tilt * tilt);  // on the line, from its point
  const Real distance = std::max(beside, norm(p));
  if (std::fabs(along) > kFarNormal * distance + kSameLength && beside >= kSameLength) {
    result.far = true;
    result.gamma = angle_of(p[1], p[0]);
    result.offset = beside;
    Real none = 0;
    spare_half_turn(result.gamma, none, result.offset);
    const Vector3 x = turn_z(-result.gamma) * normal;
    result.turn = angle_of(x[1], x[0]);
    result.rise = same_or_zero(p[2]);
    result.alpha = angle_of(tilt, u[2]);
    spare_half_turn(result.turn, result.alpha, none);
    return result;
  }
  result.gamma = angle_of(normal[1], normal[0]);
  result.b = same_or_zero(p[2] + along * u[2]);
  result.alpha = angle_of(tilt, u[2]);
  result.d = same_or_zero(dot(p, normal));
  spare_half_turn(result.gamma, result.alpha, result.d);
  return result;
}

/// How many numbers are not zero, beside what they count for.
int count_numbers(const FrameInertia& inertia) {
  constexpr Real kNothing = 1e-15L;  // of the largest
  const Real mass = std::fabs(inertia.mass);
  Real size = 0, arm = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    size = std::max(size, std::fabs(inertia.inertia[i][i]));
    arm = std::max(arm, std::fabs(inertia.first_moment[i]));
  }
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    count += std::fabs(inertia.first_moment[i]) > std::max(kNothing * arm, kSameLength * mass);
    count += std::fabs(inertia.inertia[i][k]) > kNothing * size;
  }
  return count;
}

class TableMaker {
 public:
  explicit TableMaker(const GroupedRobot& robot) : robot_(robot), row_of_(robot.groups.size(), 0) {
    const std::size_t count = robot.groups.size();
    std::vector<int> behind(count, 1);
    main_child_.assign(count, -1);
    for (std::size_t g = count; g-- > 1;) behind[group_index(robot.groups[g].parent)] += behind[g];
    for (std::size_t g = 1; g < count; ++g) {
      int& child = main_child_[group_index(robot.groups[g].parent)];
      if (child < 0 || behind[g] > behind[group_index(child)]) child = static_cast<int>(g);
    }
    frames_.resize(count);
  }

  std::vector<DhRow> run() {
    for (std::size_t g = 1; g < robot_.groups.size(); ++g) add_group(static_cast<int>(g));
    if (robot_.tip_group > 0) add_tip();
    return std::move(rows_);
  }

 private:
  [[nodiscard]] const MovingGroup& group(int g) const { return robot_.groups[group_index(g)]; }

  /// The axis of a group's joint in the frame of its parent group.
  [[nodiscard]] AxisLine axis_in_parent(int g) const {
    const MovingGroup& own = group(g);
    return {own.pose * own.point, own.pose.R * own.axis};
  }

  static AxisLine in_frame(const Pose& frame, const AxisLine& line) {
    const Pose back = inverse(frame);
    return {back * line.point, back.R * line.direction};
  }

  /// Adds mounts, and returns the row's start with the frame behind Rx(alpha) Tx(d).
  DhRow begin_row(int parent_row, int g, const AxisReach& way, Pose& frame) {
    int parent = parent_row;
    const auto mount = [&](Real d, Real theta, Real r) {
      if (d == 0 && theta == 0 && r == 0) return;
      rows_.push_back({DhRowUse::kMount, parent, g, 0, d, theta, r, Pose{}});
      frame = frame * turned_about_x(0, d) * turned_about_z(theta, r);
      parent = static_cast<int>(rows_.size());
    };
    mount(0, way.gamma, way.b);
    if (way.far) mount(way.offset, way.turn, way.rise);
    frame = frame * turned_about_x(way.alpha, way.d);
    DhRow row;
    row.parent = parent;
    row.alpha = way.alpha;
    row.d = way.d;
    return row;
  }

  void add_group(int g) {
    const MovingGroup& own = group(g);
    Pose frame = frames_[group_index(own.parent)];  // in the parent group's frame
    const AxisReach way = reach_of(in_frame(frame, axis_in_parent(g)));
    DhRow row = begin_row(row_of_[group_index(own.parent)], g, way, frame);
    row.group = g;
    const Pose before = inverse(own.pose) * frame;  // in the group's own frame
    choose_x(g, before, row);
    row.frame = before * turned_about_z(row.theta, row.r);
    frames_[group_index(g)] = row.frame;
    rows_.push_back(row);
    row_of_[group_index(g)] = static_cast<int>(rows_.size());
  }

  /// Sets theta and r so that the next axis is reached, or what is free of them so that few numbers
  /// are not zero.
  void choose_x(int g, const Pose& before, DhRow& row) const {
    AxisLine next;
    if (main_child_[group_index(g)] >= 0) {
      next = in_frame(before, axis_in_parent(main_child_[group_index(g)]));
    } else if (robot_.tip_group == g) {
      const Pose tip = inverse(before) * robot_.tip;
      next = {tip.p, tip.R.column(2)};
      const AxisReach way = reach_of(next);
      const bool same_line = way.d == 0 && way.alpha == 0 && !way.far && way.b == 0 &&
                             std::hypot(next.direction[0], next.direction[1]) < kSameAngle;
      if (same_line) {
        row.theta = angle_of(tip.R[1][0], tip.R[0][0]);
        row.r = same_or_zero(tip.p[2]);
        return;
      }
    } else {
      choose_freely(g, before, row, true, true);
      return;
    }
    const AxisReach way = reach_of(next);
    const bool parallel = std::hypot(next.direction[0], next.direction[1]) < kSameAngle;
    row.theta = way.gamma;
    row.r = way.b;
    if (parallel) choose_freely(g, before, row, way.d == 0, true);
  }

  void choose_freely(int g, const Pose& before, DhRow& row, bool any_theta, bool any_r) const {
    const MovingGroup& own = group(g);
    std::vector<Real> thetas = {row.theta}, heights = {0};
    const Pose body = inverse(before);  // the group's frame
    for (std::size_t k = 0; any_theta && k < 3; ++k) {
      const Vector3 x = body.R.column(k);
      if (std::fabs(x[2]) > kSameAngle) continue;
      Real theta = angle_of(x[1], x[0]), none = 0, nothing = 0;
      spare_half_turn(theta, none, nothing);
      thetas.push_back(theta);
    }
    if (any_r) heights.push_back(same_or_zero(body.p[2]));
    if (any_r && own.mass > 0) {
      heights.push_back(same_or_zero((body * ((1 / own.mass) * own.first_moment))[2]));
    }
    int least = -1;
    DhRow best = row;
    for (const Real theta : thetas) {
      for (const Real r : heights) {
        const bool right_angle = std::fabs(std::remainder(theta, kRealPi / 2)) < kSameAngle;
        const int cost = count_numbers(inertia_in(own, before * turned_about_z(theta, r))) +
                         (r == 0 ? 0 : 2) + (right_angle ? 0 : 2);
        if (least >= 0 && cost >= least) continue;
        least = cost;
        best.theta = theta;
        best.r = r;
      }
    }
    row = best;
  }

  void add_tip() {
    const int g = robot_.tip_group;
    const Pose own = frames_[group_index(g)];
    const Pose tip = inverse(own) * robot_.tip;
    const bool is_there = std::hypot(tip.p[0], tip.p[1], tip.p[2]) < kSameLength &&
                          std::hypot(tip.R[0][2], tip.R[1][2], tip.R[1][0]) < kSameAngle &&
                          tip.R[0][0] > 0 && tip.R[2][2] > 0;
    if (is_there) return;
    Pose frame = own;
    const AxisReach way = reach_of({tip.p, tip.R.column(2)});
    DhRow row = begin_row(row_of_[group_index(g)], g, way, frame);
    row.use = DhRowUse::kTip;
    row.group = g;
    const Pose rest = inverse(frame) * robot_.tip;
    row.theta = angle_of(rest.R[1][0], rest.R[0][0]);
    row.r = same_or_zero(rest.p[2]);
    row.frame = frame * turned_about_z(row.theta, row.r);
    rows_.push_back(row);
  }

  const GroupedRobot& robot_;
  std::vector<int> main_child_;  // of each group, -1: none
  std::vector<int> row_of_;      // of each group's frame, 0: the base
  std::vector<Pose> frames_;     // of the rows of the groups, in the groups' frames
  std::vector<DhRow> rows_;
};

}  // namespace

std::vector<DhRow> dh_rows(const GroupedRobot& robot) { return TableMaker(robot).run(); }

FrameInertia inertia_in(const MovingGroup& group, const Pose& frame) {
  const Matrix3 back = transposed(frame.R);
  FrameInertia result;
  result.mass = group.mass;
  result.first_moment = back * (group.first_moment - group.mass * frame.p);
  // J_p = J_0 - m(2 c.p 1 - c p^T - p c^T) + m(p.p 1 - p p^T), with m c the first moment
  Matrix3 shifted = group.inertia + parallel_axes(group.mass, frame.p);
  const Real product = 2 * dot(group.first_moment, frame.p);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      shifted[i][k] += group.first_moment[i] * frame.p[k] + frame.p[i] * group.first_moment[k] -
                       (i == k ? product : 0);
    }
  }
  result.inertia = turned(back, shifted);
  return result;
}

}  // namespace dyngen
