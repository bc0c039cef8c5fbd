// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/value_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "gen/robot_file/body_checks.h"

namespace dyngen {

namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr double kNearRightAngle = 1e-3;  // rounded by hand, rather than calibrated

double rounded(const GiNaC::ex& value) {
  return GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_double();
}

bool is_integer(const GiNaC::ex& value) { return value.info(GiNaC::info_flags::integer); }

bool is_integer_between(const GiNaC::ex& value, int low, int high) {
  return is_integer(value) && value >= low && value <= high;
}

void check_sigma(const Row& row, Diagnostics& diagnostics) {
  for (const FieldValue& value : row.values) {
    if (value.unknown || is_integer_between(value.value, 0, 2)) continue;
    diagnostics.error(value.position, value.length,
                      fmt::format("joint type {} in 'sigma'", printable(value.text)),
                      "0 is revolute, 1 prismatic, 2 fixed");
  }
}

void check_ant(const Row& row, Diagnostics& diagnostics) {
  for (std::size_t j = 0; j < row.values.size(); ++j) {
    const FieldValue& value = row.values[j];
    if (value.unknown || is_integer_between(value.value, 0, static_cast<int>(j))) continue;
    diagnostics.error(
        value.position, value.length,
        fmt::format("the parent of link {} in 'ant' is {}", j + 1, printable(value.text)),
        j == 0 ? "link 1 stands on the base: 0"
               : fmt::format("expected a link before it, 0 (the base) to {}", j));
  }
}

void check_positive(const RobotFile& file, RowKey key, Diagnostics& diagnostics) {
  for (const FieldValue& value : file.row(key).values) {
    if (value.unknown || rounded(value.value) > 0) continue;
    diagnostics.error(
        value.position, value.length,
        fmt::format("limit {} in '{}' is not positive", printable(value.text), row_keyword(key)),
        "limits are magnitudes; write - for a joint without a limit");
  }
}

void check_not_negative(const RobotFile& file, RowKey key, Severity severity,
                        const std::string& hint, Diagnostics& diagnostics) {
  for (const FieldValue& value : file.row(key).values) {
    if (value.unknown || rounded(value.value) >= 0) continue;
    const std::string message =
        fmt::format("negative value {} in '{}'", printable(value.text), row_keyword(key));
    if (severity == Severity::kError) {
      diagnostics.error(value.position, value.length, message, hint);
    } else {
      diagnostics.warning(value.position, value.length, message, hint);
    }
  }
}

void check_joint_limits(const RobotFile& file, Diagnostics& diagnostics) {
  const Row& low = file.row(RowKey::kQmin);
  const Row& high = file.row(RowKey::kQmax);
  for (std::size_t j = 0; j < low.values.size() && j < high.values.size(); ++j) {
    const FieldValue& min = low.values[j];
    const FieldValue& max = high.values[j];
    if (min.unknown || max.unknown || rounded(min.value) <= rounded(max.value)) continue;
    diagnostics.error(max.position, max.length,
                      fmt::format("qmax of joint {} is {}, below its qmin {}", j + 1,
                                  printable(max.text), printable(min.text)),
                      fmt::format("qmin stands on line {}", min.position.line));
  }
}

/// "pi/2", "-pi", "3*pi/2": a multiple of the right angle, as the file would write it.
std::string right_angles(long count) {
  if (count == 0) return "0";
  const std::string sign = count < 0 ? "-" : "";
  const long quarters = std::labs(count);
  const long numerator = quarters % 2 == 0 ? quarters / 2 : quarters;
  const std::string factor = numerator == 1 ? "" : fmt::format("{}*", numerator);
  return fmt::format("{}{}pi{}", sign, factor, quarters % 2 == 0 ? "" : "/2");
}

void warn_of_degrees(const FieldValue& value, RowKey key, Diagnostics& diagnostics) {
  const std::string text = printable(value.text);
  diagnostics.warning(
      value.position, value.length,
      fmt::format("{} in '{}' looks like degrees: angles are in radians", text, row_keyword(key)),
      value.text.find_first_not_of(".0123456789-") == std::string::npos
          ? fmt::format("write {}*deg", text)
          : "write 90*deg for 90 degrees");
}

/// More than two turns, or a round number of more than one: calibrated offsets are not round.
bool looks_like_degrees(const FieldValue& value) {
  constexpr double kTurn = 4 * kRightAngle;
  const double angle = std::fabs(rounded(value.value));
  return angle > 2 * kTurn || (angle > kTurn && is_integer(2 * value.value));
}

void check_angles(const RobotFile& file, RowKey key, Diagnostics& diagnostics) {
  for (const FieldValue& value : file.row(key).values) {
    if (value.unknown || is_integer(value.value * 2 / GiNaC::Pi)) continue;
    const double angle = rounded(value.value);
    if (looks_like_degrees(value)) {
      warn_of_degrees(value, key, diagnostics);
      continue;
    }
    const double quarters = std::round(angle / kRightAngle);
    if (std::fabs(angle - quarters * kRightAngle) >= kNearRightAngle) continue;
    const std::string exact = right_angles(static_cast<long>(quarters));
    diagnostics.warning(value.position, value.length,
                        fmt::format("{} in '{}' is nearly, but not exactly, {}",
                                    printable(value.text), row_keyword(key), exact),
                        fmt::format("write {} if that is meant", exact));
  }
}

/// Limits of revolute joints; an axis without an end has larger ones.
void check_limit_angles(const RobotFile& file, RowKey key, Diagnostics& diagnostics) {
  constexpr double kMostDegrees = 1000;
  const std::vector<FieldValue>& values = file.row(key).values;
  const std::vector<FieldValue>& sigma = file.row(RowKey::kSigma).values;
  for (std::size_t j = 0; j < values.size(); ++j) {
    const FieldValue& value = values[j];
    if (value.unknown || (j < sigma.size() && !sigma[j].value.is_zero())) continue;
    if (is_integer(value.value * 2 / GiNaC::Pi)) continue;
    if (std::fabs(rounded(value.value)) > kMostDegrees || !looks_like_degrees(value)) continue;
    warn_of_degrees(value, key, diagnostics);
  }
}

/// A fixed joint has no actuator: what its column says of one is a mistake.
void check_fixed_joints(const RobotFile& file, Diagnostics& diagnostics) {
  const std::vector<FieldValue>& sigma = file.row(RowKey::kSigma).values;
  std::size_t fixed = 0;
  for (std::size_t j = 0; j < sigma.size(); ++j) {
    if (sigma[j].unknown || !sigma[j].value.is_equal(2)) continue;
    ++fixed;
    for (const RowKey key : {RowKey::kIA, RowKey::kFs, RowKey::kFv, RowKey::kOff}) {
      const std::vector<FieldValue>& values = file.row(key).values;
      if (j >= values.size() || (!values[j].unknown && values[j].value.is_zero())) continue;
      diagnostics.error(values[j].position, values[j].length,
                        fmt::format("'{}' of joint {} is '{}', but the joint is fixed (sigma 2): "
                                    "expected 0",
                                    row_keyword(key), j + 1, printable(values[j].text)));
    }
  }
  if (fixed == 0 || fixed != static_cast<std::size_t>(file.joint_count)) return;
  diagnostics.error(file.row(RowKey::kSigma).keyword, 5,
                    "every joint is fixed (sigma 2): expected a joint that moves");
}

}  // namespace

void check_values(const RobotFile& file, Diagnostics& diagnostics) {
  check_sigma(file.row(RowKey::kSigma), diagnostics);
  check_ant(file.row(RowKey::kAnt), diagnostics);
  check_angles(file, RowKey::kAl, diagnostics);
  check_angles(file, RowKey::kTh, diagnostics);
  check_limit_angles(file, RowKey::kQmin, diagnostics);
  check_limit_angles(file, RowKey::kQmax, diagnostics);
  check_fixed_joints(file, diagnostics);
  if (file.parameters == ParameterMeaning::kBodies) {  // a sum may have any sign
    check_not_negative(file, RowKey::kM, Severity::kError,
                       "a mass is 0 or more, unless a row says: parameters base", diagnostics);
    check_not_negative(file, RowKey::kIA, Severity::kError,
                       "a rotor inertia is 0 or more, unless a row says: parameters base",
                       diagnostics);
  }
  for (const RowKey key : {RowKey::kFs, RowKey::kFv}) {
    check_not_negative(file, key, Severity::kWarning,
                       "friction takes energy out: expected 0 or more", diagnostics);
  }
  for (const RowKey key : {RowKey::kVmax, RowKey::kAmax, RowKey::kTaumax}) {
    check_positive(file, key, diagnostics);
  }
  check_joint_limits(file, diagnostics);
  check_sizes(file, diagnostics);
  if (!file.made_of.empty()) return;  // each body was checked where it is described
  check_bodies(file, diagnostics);
  if (!diagnostics.has_errors()) check_masses(file, AbsentRows::kUnknown, diagnostics);
}

}  // namespace dyngen
