// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

// Where a file says nothing.
constexpr double kFreeTurn = std::numbers::pi;  // rad, either way
constexpr double kFreeStroke = 1.0;             // m, either way
constexpr double kFreeSpeed = 2.0;              // rad/s, m/s
constexpr double kFreeRise = 5.0;               // rad/s^2, m/s^2

std::vector<int> moving_joints(const RobotModel& model) {
  std::vector<int> joints;
  for (int j = 1; j <= model.size(); ++j) {
    if (model.joint(j).coordinate >= 0) joints.push_back(j);
  }
  return joints;
}

const char* type_word(JointType type) {
  return type == JointType::kPrismatic ? "prismatic" : "revolute";
}

std::vector<std::string> other_joints(const RobotModel& a, const RobotModel& b) {
  const std::vector<int> joints_a = moving_joints(a), joints_b = moving_joints(b);
  std::vector<std::string> reasons;
  const std::size_t common = std::min(joints_a.size(), joints_b.size());
  for (std::size_t i = 0; i < common; ++i) {
    const JointModel &x = a.joint(joints_a[i]), &y = b.joint(joints_b[i]);
    if (x.type == y.type) continue;
    reasons.push_back(
        fmt::format("moving joint {} is {} in the first ({}) and {} in the second "
                    "({})",
                    i + 1, type_word(x.type), x.name, type_word(y.type), y.name));
  }
  const auto rest = [&](const RobotModel& model, const std::vector<int>& joints,
                        const char* which) {
    if (joints.size() <= common) return;
    std::string names;
    for (std::size_t i = common; i < joints.size(); ++i) {
      names += (names.empty() ? "" : ", ") + model.joint(joints[i]).name;
    }
    reasons.push_back(
        fmt::format("only the {} has {} {}", which,
                    joints.size() - common == 1 ? "the moving joint" : "the moving joints", names));
  };
  rest(a, joints_a, "first");
  rest(b, joints_b, "second");
  return reasons;
}

/// The limit of a joint in a row of magnitudes; none: the file says nothing.
std::optional<double> row_limit(const RobotFile& file, RowKey key, int joint) {
  const Row& row = file.row(key);
  const auto at = static_cast<std::size_t>(joint - 1);
  if (!row.present || row.values.size() <= at) return {};
  return to_double(row.values[at].value);
}

double smaller_limit(const ComparedRobot& a, int joint_a, const ComparedRobot& b, int joint_b,
                     RowKey key, double otherwise) {
  const auto x = row_limit(a.file, key, joint_a), y = row_limit(b.file, key, joint_b);
  if (x && y) return std::min(*x, *y);
  return x ? *x : y ? *y : otherwise;
}

void find_ranges(const ComparedRobot& a, const ComparedRobot& b, Comparison& result) {
  const std::vector<int> joints_a = moving_joints(a.model), joints_b = moving_joints(b.model);
  for (std::size_t i = 0; i < joints_a.size(); ++i) {
    const JointModel &x = a.model.joint(joints_a[i]), &y = b.model.joint(joints_b[i]);
    const double reach = x.type == JointType::kPrismatic ? kFreeStroke : kFreeTurn;
    const auto number = [](const std::optional<GiNaC::ex>& value, double otherwise) {
      return value ? to_double(*value) : otherwise;
    };
    StateRange range;
    range.q_min = std::max(number(x.qmin, -reach), number(y.qmin, -reach));
    range.q_max = std::min(number(x.qmax, reach), number(y.qmax, reach));
    if (range.q_min > range.q_max) {
      range.q_min = number(x.qmin, -reach);
      range.q_max = std::max(number(x.qmax, reach), range.q_min);
      result.clipped.push_back(x.name);
    }
    range.dq = smaller_limit(a, joints_a[i], b, joints_b[i], RowKey::kVmax, kFreeSpeed);
    range.ddq = smaller_limit(a, joints_a[i], b, joints_b[i], RowKey::kAmax, kFreeRise);
    result.ranges.push_back(range);
  }
}

/// A double in [0, 1) of the generator's upper 53 bits: the same on every machine.
double unit_number(std::mt19937_64& random) {
  constexpr double kBits = 9007199254740992.0;  // 2^53
  return static_cast<double>(random() >> 11) / kBits;
}

MotionArrays random_motion(const std::vector<StateRange>& ranges,
                           const ComparisonOptions& options) {
  std::mt19937_64 random(options.seed);
  MotionArrays motion;
  motion.samples = options.samples;
  const std::size_t n = ranges.size(), count = options.samples;
  motion.q.resize(n * count);
  motion.dq.resize(n * count);
  motion.ddq.resize(n * count);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const StateRange& range = ranges[i];
      motion.q[i * count + k] = range.q_min + (range.q_max - range.q_min) * unit_number(random);
      motion.dq[i * count + k] = range.dq * (2 * unit_number(random) - 1);
      motion.ddq[i * count + k] = range.ddq * (2 * unit_number(random) - 1);
    }
  }
  return motion;
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double share_of(double difference, double largest) {
  if (difference == 0) return 0;
  return largest == 0 ? 1.0 : difference / largest;
}

class Comparer {
 public:
  Comparer(RobotNumbers& a, RobotNumbers& b, const MotionArrays& motion, double tolerance,
           Comparison& result)
      : a_(a), b_(b), motion_(motion), tolerance_(tolerance), result_(result) {}

  void compare_torques() {
    const std::vector<double> x = a_.run("id", motion_), y = b_.run("id", motion_);
    const std::size_t count = motion_.samples, n = a_.joints();
    largest_torque_ = std::max(largest_magnitude(x), largest_magnitude(y));
    result_.same_torques = true;
    for (std::size_t i = 0; i < n; ++i) {
      TorqueDifference worst;
      double largest = 0;
      std::size_t place = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const double own = x[i * count + k], other = y[i * count + k];
        largest = std::max({largest, std::abs(own), std::abs(other)});
        if (std::abs(own - other) <= worst.difference) continue;
        worst.difference = std::abs(own - other);
        place = k;
      }
      worst.share = share_of(worst.difference, largest);
      worst.first = x[i * count + place];
      worst.second = y[i * count + place];
      for (std::size_t joint = 0; joint < n; ++joint) {
        worst.q.push_back(motion_.q[joint * count + place]);
        worst.dq.push_back(motion_.dq[joint * count + place]);
        worst.ddq.push_back(motion_.ddq[joint * count + place]);
      }
      // one joint's torque may be rounding of others': it is judged against the largest of all
      result_.same_torques =
          result_.same_torques && worst.difference <= tolerance_ * largest_torque_;
      result_.torques.push_back(std::move(worst));
    }
  }

  /// @param columns  values of the part per joint: one if they are torques
  void compare_part(const std::string& part, const std::vector<double>& x,
                    const std::vector<double>& y, std::size_t columns) {
    PartDifference worst;
    worst.part = part;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (std::abs(x[k] - y[k]) <= worst.difference) continue;
      worst.difference = std::abs(x[k] - y[k]);
      worst.joint = static_cast<int>(k / (motion_.samples * columns));
    }
    const double largest = std::max(largest_magnitude(x), largest_magnitude(y));
    worst.share = share_of(worst.difference, largest);
    const double scale = columns == 1 ? std::max(largest, largest_torque_) : largest;
    worst.same = worst.difference <= tolerance_ * scale;
    result_.same_torques = result_.same_torques && worst.same;
    result_.parts.push_back(std::move(worst));
  }

  void compare_parts() {
    const auto compare = [&](const std::string& part, const std::string& function,
                             std::size_t columns) {
      compare_part(part, a_.run(function, motion_), b_.run(function, motion_), columns);
    };
    compare("mass matrix", "mass_matrix", a_.joints());
    compare("Coriolis", "coriolis", 1);
    compare("gravity", "gravity", 1);
    compare_part("friction", friction(a_), friction(b_), 1);
    if (a_.has("effects") || b_.has("effects")) {
      compare_part("effects", effects(a_), effects(b_), 1);
    }
  }

  void compare_frames() {
    const std::vector<double> x = a_.run("fk", motion_), y = b_.run("fk", motion_);
    const std::size_t count = motion_.samples;
    for (std::size_t k = 0; k < count; ++k) {
      std::array<double, 3> step{}, own{};
      double squares = 0;  // of the differences of the rotation's elements
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
          const std::size_t at = (4 * row + column) * count + k;
          if (column == 3) {
            step[row] = y[at] - x[at];
            own[row] = x[at];
          } else {
            squares += (y[at] - x[at]) * (y[at] - x[at]);
          }
        }
      }
      result_.frame_distance =
          std::max(result_.frame_distance, std::hypot(step[0], step[1], step[2]));
      result_.reach = std::max(result_.reach, std::hypot(own[0], own[1], own[2]));
      // |R - S|^2 = 8 sin^2(angle / 2)
      const double half = std::min(1.0, std::sqrt(squares / 8));
      result_.frame_angle = std::max(result_.frame_angle, 2 * std::asin(half));
    }
  }

  void compare_axes() {
    const std::vector<int> joints_a = moving_joints(a_.model()),
                           joints_b = moving_joints(b_.model());
    for (std::size_t i = 0; i < joints_a.size(); ++i) {
      const bool slides = a_.model().joint(joints_a[i]).type == JointType::kPrismatic;
      result_.axes.push_back(
          axis_difference(axis_frames(a_, joints_a[i]), axis_frames(b_, joints_b[i]), slides));
    }
  }

 private:
  /// Friction and offset of the file, without effects.
  std::vector<double> friction(RobotNumbers& robot) {
    const std::vector<int> joints = moving_joints(robot.model());
    const std::size_t count = motion_.samples;
    std::vector<double> torque(joints.size() * count);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double FV = robot.parameter(joints[i], Chi::kFV),
                   FS = robot.parameter(joints[i], Chi::kFS),
                   OFF = robot.parameter(joints[i], Chi::kOFF);
      for (std::size_t k = 0; k < count; ++k) {
        const double dq = motion_.dq[i * count + k];
        torque[i * count + k] = FV * dq + FS * (dq > 0 ? 1 : dq < 0 ? -1 : 0) + OFF;
      }
    }
    return torque;
  }

  std::vector<double> effects(RobotNumbers& robot) {
    if (robot.has("effects")) return robot.run("effects", motion_);
    return std::vector<double>(robot.joints() * motion_.samples, 0.0);
  }

  /// Poses of the frame whose z is the joint's axis; empty: frame 0.
  std::vector<double> axis_frames(RobotNumbers& robot, int joint) {
    int link = joint;
    if (robot.model().convention == DhConvention::kStandard) {
      link = robot.model().joint(joint).parent;
    }
    return link == 0 ? std::vector<double>() : robot.run(fmt::format("fk_{}", link), motion_);
  }

  AxisDifference axis_difference(const std::vector<double>& x, const std::vector<double>& y,
                                 bool slides) {
    const std::size_t count = motion_.samples;
    const auto element = [&](const std::vector<double>& frames, std::size_t row, std::size_t column,
                             std::size_t k) {
      if (!frames.empty()) return frames[(4 * row + column) * count + k];
      return row == 2 && column == 2 ? 1.0 : 0.0;
    };
    AxisDifference worst;
    for (std::size_t k = 0; k < count; ++k) {
      std::array<double, 3> z{}, step{}, direction{};
      for (std::size_t row = 0; row < 3; ++row) {
        z[row] = element(y, row, 2, k);
        direction[row] = z[row] - element(x, row, 2, k);
        step[row] = element(x, row, 3, k) - element(y, row, 3, k);
      }
      const double half = std::min(1.0, std::hypot(direction[0], direction[1], direction[2]) / 2);
      worst.angle = std::max(worst.angle, 2 * std::asin(half));
      if (slides) continue;  // only the direction of a prismatic joint matters
      const double distance =
          std::hypot(step[1] * z[2] - step[2] * z[1], step[2] * z[0] - step[0] * z[2],
                     step[0] * z[1] - step[1] * z[0]);
      worst.distance = std::max(worst.distance, distance);
    }
    return worst;
  }

  RobotNumbers& a_;
  RobotNumbers& b_;
  const MotionArrays& motion_;
  double tolerance_;
  double largest_torque_ = 0;  ///< of both
  Comparison& result_;
};

}  // namespace

Comparison compare_robots(const ComparedRobot& first, const ComparedRobot& second,
                          const ComparisonOptions& options) {
  Comparison result;
  result.other_joints = other_joints(first.model, second.model);
  if (!result.other_joints.empty()) return result;
  RobotNumbers a(first.model, first.options), b(second.model, second.options);
  find_ranges(first, second, result);
  const MotionArrays motion = random_motion(result.ranges, options);
  Comparer comparer(a, b, motion, options.tolerance, result);
  comparer.compare_torques();
  comparer.compare_parts();
  comparer.compare_frames();
  comparer.compare_axes();

  const auto small = [&](double difference, double scale) {
    return difference <= options.tolerance * scale;
  };
  const double metre = std::max(1.0, result.reach);
  result.same_axes = std::all_of(result.axes.begin(), result.axes.end(), [&](const auto& axis) {
    return small(axis.angle, 1.0) && small(axis.distance, metre);
  });
  result.same_frame = small(result.frame_distance, metre) && small(result.frame_angle, 1.0);
  return result;
}

}  // namespace dyngen
