// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/excite_limits.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "gen/functions/functions.h"
#include "gen/generator/generator.h"
#include "gen/program/program.h"
#include "gen/symbols/exact.h"
#include "runtime/tools/dynid/robot/row_values.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::string joints_text(const std::vector<Index>& joints, Index all) {
  if (static_cast<Index>(joints.size()) == all) return "all joints";
  std::string text = joints.size() == 1 ? "joint" : "joints";
  for (const Index joint : joints) text += fmt::format(" {}", joint + 1);
  return text;
}

void set_positions(RobotLimits& result, const DescribedRobot& robot, double share) {
  MotionLimits& limits = result.limits;
  limits.lower = row_values(robot, RowKey::kQmin);
  limits.upper = row_values(robot, RowKey::kQmax);
  std::vector<Index> assumed;
  for (Index j = 0; j < limits.lower.size(); ++j) {
    if (!std::isfinite(limits.lower[j]) || !std::isfinite(limits.upper[j])) {
      const double reach =
          robot.linear.revolute[static_cast<std::size_t>(j)] ? std::numbers::pi : 0.5;
      limits.lower[j] = -reach;
      limits.upper[j] = reach;
      assumed.push_back(j);
    }
    const double middle = 0.5 * (limits.lower[j] + limits.upper[j]);
    const double half = 0.5 * share * (limits.upper[j] - limits.lower[j]);
    limits.lower[j] = middle - half;
    limits.upper[j] = middle + half;
  }
  if (assumed.empty()) return;
  result.notes.push_back(fmt::format(
      "qmin, qmax: the file has none for {}; assumed: half a turn (0.5 m where it slides) to both "
      "sides",
      joints_text(assumed, limits.lower.size())));
}

void set_accelerations(RobotLimits& result, const DescribedRobot& robot,
                       const LimitOptions& options) {
  constexpr double kTimeToFullSpeed = 0.25, kWithoutSpeed = 10;
  MotionLimits& limits = result.limits;
  const Index n = limits.lower.size();
  limits.acceleration = row_values(robot, RowKey::kAmax) * options.share;
  if (!options.acceleration.empty()) {
    const Index given = static_cast<Index>(options.acceleration.size());
    if (given != 1 && given != n) {
      throw std::invalid_argument(
          fmt::format("--acceleration: {} values, expected one or {}", given, n));
    }
    for (Index j = 0; j < n; ++j) {
      limits.acceleration[j] = options.acceleration[static_cast<std::size_t>(given == 1 ? 0 : j)];
    }
    return;
  }
  std::vector<Index> assumed;
  for (Index j = 0; j < n; ++j) {
    if (std::isfinite(limits.acceleration[j])) continue;
    limits.acceleration[j] =
        std::isfinite(limits.speed[j]) ? limits.speed[j] / kTimeToFullSpeed : kWithoutSpeed;
    assumed.push_back(j);
  }
  if (assumed.empty()) return;
  std::string values;
  for (const Index j : assumed) values += fmt::format(" {:.3g}", limits.acceleration[j]);
  result.notes.push_back(
      fmt::format("amax: the file has none for {}; assumed:{} (vmax in 0.25 s, or 10; "
                  "--acceleration gives others)",
                  joints_text(assumed, n), values));
}

void set_torques(RobotLimits& result, const DescribedRobot& robot, double share) {
  MotionLimits& limits = result.limits;
  limits.torque = row_values(robot, RowKey::kTaumax) * share;
  if (!limits.torque.array().isFinite().any()) {
    result.notes.emplace_back("taumax: the file has none; torque is not limited");
    return;
  }
  VectorXd chi(robot.standard.size());
  constexpr Index kRow = kChiCount;
  for (int j = 1; j <= robot.model.size(); ++j) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const Quantity& quantity = robot.model.joint(j).chi[k];
      // a row that the file does not have says nothing against 0; a '*' does
      if (quantity.unknown && quantity.line != 0) {
        result.notes.push_back(fmt::format(
            "taumax: torque cannot be foretold and is not limited: {} (and maybe others) is '*'",
            chi_name(static_cast<Chi>(k), j)));
        return;
      }
      chi[kRow * (j - 1) + static_cast<Index>(k)] =
          quantity.unknown ? 0 : to_double(quantity.value);
    }
  }
  limits.beta = robot.grouping * chi;
}

/// Pose and Jacobian of the last link by the generator's own programs.
std::function<ToolPoint(const VectorXd&)> tool_function(const DescribedRobot& robot,
                                                        const std::array<double, 3>& tool) {
  GeneratorOptions options;
  options.functions = {"fk", "jacobian"};
  options.search = {.patience = 0, .work = 0};
  CodeModel code = make_code_model(robot.model, options);
  const std::vector<RobotFunction> functions = write_functions(code, options);
  auto pose = std::make_shared<const Program>(lower(functions.at(0).trace));
  auto jacobian = std::make_shared<const Program>(lower(functions.at(1).trace));
  const Index n = robot.linear.joints();
  const Eigen::Vector3d offset(tool[0], tool[1], tool[2]);
  // dyngen's matrices are row-major
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return [pose, jacobian, n, offset](const VectorXd& q) {
    RowMajor T(4, 4), J(6, n);
    const std::span<const double> in(q.data(), static_cast<std::size_t>(q.size()));
    // a geometry without parameters of its own: chi is not read
    evaluate(*pose, 1, {{"q", in}}, {{"T", {T.data(), 16}}});
    evaluate(*jacobian, 1, {{"q", in}}, {{"J", {J.data(), static_cast<std::size_t>(J.size())}}});
    const Eigen::Vector3d arm = T.topLeftCorner(3, 3) * offset;
    ToolPoint point{T.topRightCorner(3, 1) + arm, J.topRows(3)};
    for (Index j = 0; j < n; ++j) {
      const Eigen::Vector3d w = J.col(j).tail(3);
      point.jacobian.col(j) += w.cross(arm);
    }
    return point;
  };
}

void set_box(RobotLimits& result, const DescribedRobot& robot, const LimitOptions& options) {
  if (!options.keep_out) return;
  const std::array<double, 6>& box = *options.keep_out;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(box[2 * i] < box[2 * i + 1])) {
      throw std::invalid_argument(fmt::format("--keep-out: {} to {} along {}, expected a range",
                                              box[2 * i], box[2 * i + 1], "xyz"[i]));
    }
  }
  result.limits.box = KeepOutBox{.lower = {box[0], box[2], box[4]},
                                 .upper = {box[1], box[3], box[5]},
                                 .tool = tool_function(robot, options.tool)};
}

}  // namespace

RobotLimits limits_of(const DescribedRobot& robot, const LimitOptions& options) {
  if (!(options.share > 0) || options.share > 1) {
    throw std::invalid_argument(
        fmt::format("--limits: {}, expected a share in (0, 1]", options.share));
  }
  RobotLimits result;
  set_positions(result, robot, options.share);
  result.limits.speed = row_values(robot, RowKey::kVmax) * options.share;
  set_accelerations(result, robot, options);
  set_torques(result, robot, options.share);
  set_box(result, robot, options);
  result.limits.validate(robot.linear);
  return result;
}

}  // namespace dyngen::runtime
