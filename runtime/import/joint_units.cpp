// SPDX-License-Identifier: MIT
#include "runtime/import/joint_units.h"

#include <fmt/format.h>

#include <string>

#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

/// The only element, or that of a joint.
template <typename Value>
Value of_one(const std::vector<Value>& values, std::size_t joint, Value otherwise) {
  if (values.empty()) return otherwise;
  if (values.size() == 1) return values.front();
  return joint < values.size() ? values[joint] : otherwise;
}

const char* expected_units(MotionKind kind, ColumnQuantity quantity) {
  const bool angle = kind == MotionKind::kAngle;
  switch (quantity) {
    case ColumnQuantity::kPosition:
      return angle ? "an angle, such as rad or deg" : "a length, such as m or mm";
    case ColumnQuantity::kVelocity:
      return angle ? "the speed of an angle, such as rad/s, deg/s or rpm"
                   : "the speed of a length, such as m/s or mm/s";
    case ColumnQuantity::kAcceleration:
      return angle ? "rad/s^2 or deg/s^2" : "m/s^2 or mm/s^2";
    case ColumnQuantity::kTorque:
      return angle ? "a torque, such as N m" : "a force, such as N";
    case ColumnQuantity::kTime:
    case ColumnQuantity::kTemperature:
      break;
  }
  return "";
}

void check_unit(const ImportMap& map, const MapPlace& place, const std::string& unit,
                const std::string& of, std::size_t joint, MotionKind kind,
                ColumnQuantity quantity) {
  const std::optional<MotionKind> own = motion_kind(unit, quantity);
  if (!own || *own == kind) return;
  throw ImportError(map_error(
      map, place,
      fmt::format("found unit {} of {}, and joint {} of the robot is {}: expected {}. If the "
                  "sensor measures something else, write the joint's unit and the factor in 'gain'",
                  quoted(unit), of, joint + 1,
                  kind == MotionKind::kAngle ? "revolute" : "prismatic",
                  expected_units(kind, quantity))));
}

}  // namespace

void check_joint_units(const ImportMap& map, const SignalMap& signal, ColumnQuantity quantity,
                       const std::vector<MotionKind>& kinds,
                       const std::vector<ColumnPlace>& columns) {
  for (std::size_t j = 0; j < kinds.size(); ++j) {
    const std::string offset = of_one(signal.offset_units, j, std::string());
    check_unit(map, of_one(signal.offset_places, j, signal.place), offset, "the offset", j,
               kinds[j], quantity);
    const bool motor = of_one(signal.sides, j, GearSide::kJoint) == GearSide::kMotor;
    if (motor || j >= columns.size()) continue;
    const bool told = !signal.units.empty();
    check_unit(map, told ? of_one(signal.unit_places, j, signal.place) : signal.columns.place,
               told ? of_one(signal.units, j, std::string()) : columns[j].unit,
               quoted(columns[j].name) + (told ? "" : " in the log"), j, kinds[j], quantity);
  }
}

}  // namespace dyngen::runtime
