// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_pose.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace dyngen {

namespace {

Vector3 first_three(const std::vector<long double>& v, std::size_t from) {
  return {{v[from], v[from + 1], v[from + 2]}};
}

/// A unit vector; reported if it has no length.
std::optional<Vector3> unit_direction(const Vector3& v, const XmlAttribute& attribute,
                                      XmlValues& values) {
  const Real length = norm(v);
  if (length > 0) return (1 / length) * v;
  values.error(attribute, fmt::format("'{}' has no length", printable(attribute.name)),
               "expected a direction");
  return std::nullopt;
}

Matrix3 turn_euler(const Vector3& angle, const std::string& sequence) {
  Matrix3 turn = Matrix3::identity();
  for (std::size_t k = 0; k < 3; ++k) {
    const char axis = sequence[k];
    const bool turns_with = axis >= 'a';
    const char lower = turns_with ? axis : static_cast<char>(axis - 'A' + 'a');
    const Matrix3 own = lower == 'x'   ? turn_x(angle[k])
                        : lower == 'y' ? turn_y(angle[k])
                                       : turn_z(angle[k]);
    turn = turns_with ? turn * own : own * turn;
  }
  return turn;
}

Matrix3 turn_of(const XmlAttribute& attribute, const MjcfAngles& angles, XmlValues& values) {
  const Matrix3 none = Matrix3::identity();
  if (attribute.name == "quat") {
    const auto v = values.numbers(attribute, 4);
    if (!v) return none;
    const std::array<Real, 4> wxyz = {(*v)[0], (*v)[1], (*v)[2], (*v)[3]};
    if (wxyz[0] == 0 && wxyz[1] == 0 && wxyz[2] == 0 && wxyz[3] == 0) {
      values.error(attribute, "'quat' has no length", "expected a quaternion w x y z");
      return none;
    }
    return turn_quaternion(wxyz);
  }
  if (attribute.name == "axisangle") {
    const auto v = values.numbers(attribute, 4);
    if (!v) return none;
    const auto axis = unit_direction(first_three(*v, 0), attribute, values);
    return axis ? turn_about(*axis, mjcf_angle((*v)[3], angles)) : none;
  }
  if (attribute.name == "euler") {
    const auto v = values.numbers(attribute, 3);
    if (!v) return none;
    return turn_euler(
        {{mjcf_angle((*v)[0], angles), mjcf_angle((*v)[1], angles), mjcf_angle((*v)[2], angles)}},
        angles.euler);
  }
  if (attribute.name == "zaxis") {
    const auto v = values.numbers(attribute, 3);
    if (!v) return none;
    const auto z = unit_direction(first_three(*v, 0), attribute, values);
    return z ? turn_z_to(*z) : none;
  }
  const auto v = values.numbers(attribute, 6);
  if (!v) return none;
  const auto x = unit_direction(first_three(*v, 0), attribute, values);
  if (!x) return none;
  const Vector3 written = first_three(*v, 3);
  const auto y = unit_direction(written - dot(written, *x) * *x, attribute, values);
  return y ? Matrix3::of_columns(*x, *y, cross(*x, *y)) : none;
}

}  // namespace

Real mjcf_angle(Real written, const MjcfAngles& angles) {
  constexpr Real kDegree = kRealPi / 180;
  return rounded_angle(angles.degrees ? written * kDegree : written, angles.tolerance);
}

std::optional<Vector3> mjcf_vector(const MjcfAttributes& attributes, std::string_view name,
                                   XmlValues& values) {
  const XmlAttribute* attribute = attributes.find(name);
  if (attribute == nullptr) return std::nullopt;
  const auto v = values.numbers(*attribute, 3);
  if (!v) return std::nullopt;
  return first_three(*v, 0);
}

Matrix3 turn_z_to(const Vector3& d) {
  const Real sine = std::hypot(d[0], d[1]);
  if (sine == 0) return d[2] > 0 ? Matrix3::identity() : turn_x(kRealPi);
  return turn_about({{-d[1] / sine, d[0] / sine, 0}}, std::atan2(sine, d[2]));
}

Pose mjcf_pose(const MjcfAttributes& attributes, const MjcfAngles& angles, XmlValues& values) {
  Pose pose;
  pose.p = mjcf_vector(attributes, "pos", values).value_or(Vector3{});
  const XmlAttribute* first = nullptr;
  for (const std::string_view name : {"quat", "axisangle", "xyaxes", "zaxis", "euler"}) {
    const XmlAttribute* attribute = attributes.find(name);
    if (attribute == nullptr) continue;
    if (first != nullptr) {
      values.error(*attribute, fmt::format("both '{}' and '{}' are given", first->name, name),
                   "expected one orientation");
      continue;
    }
    first = attribute;
    pose.R = turn_of(*attribute, angles, values);
  }
  return pose;
}

}  // namespace dyngen
