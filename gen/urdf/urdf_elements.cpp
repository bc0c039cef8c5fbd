// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/urdf/urdf_elements.h"

#include <fmt/format.h>

#include <cmath>

#include "gen/bodies/decimal.h"

namespace dyngen {
namespace {

double power_of_ten_above(Real value) {
  return std::pow(10.0, std::ceil(std::log10(static_cast<double>(value))));
}

}  // namespace

void UrdfElements::warn_of_unknown(const XmlElement& element, const std::string& where) {
  values_.warning(element,
                  fmt::format("<{}> in {} is unknown and left out", printable(element.name), where),
                  "its dynamics, if it has any, are not in the model");
}

RealVector UrdfElements::vector(const XmlElement& element, std::string_view name,
                                const RealVector& absent) {
  const XmlAttribute* attribute = element.attribute(name);
  if (attribute == nullptr) return absent;
  const auto values = values_.numbers(*attribute, 3);
  if (!values) return absent;
  return {{(*values)[0], (*values)[1], (*values)[2]}};
}

/// Angles within the tolerance are multiples of pi/12; nearly right ones are warned of.
RealVector UrdfElements::angles(const XmlElement& element, const std::string& whose) {
  constexpr Real kNearlyRight = 1e-3L;  // rad: rounded by hand, rather than calibrated
  RealVector rpy = vector(element, "rpy", {});
  const XmlAttribute* attribute = element.attribute("rpy");
  for (std::size_t k = 0; k < 3; ++k) {
    const Real tolerance = std::max(kSameAngle, options_.round_angles);
    const Real written = rpy[k];
    if (std::fabs(written) > 2 * kRealPi + kNearlyRight && attribute != nullptr) {
      values_.warning(*attribute,
                      fmt::format("rpy of {}: {} rad is more than a turn", whose, decimal(written)),
                      "URDF's angles are in rad: is it in degrees?");
    }
    rpy[k] = rounded_angle(written, tolerance);
    const Real right = std::round(written / (kRealPi / 2)) * (kRealPi / 2);
    const bool nearly = right != 0 && rpy[k] == written && written != right &&
                        std::fabs(written - right) < kNearlyRight;
    if (!nearly || attribute == nullptr) continue;
    values_.warning(*attribute,
                    fmt::format("rpy of {}: {} is nearly, but not exactly, {}", whose,
                                decimal(written), angle_text(right)),
                    fmt::format("it is kept as it is, which costs operations in every function; "
                                "--round-angles {:.0e} makes it a right angle",
                                power_of_ten_above(std::fabs(written - right))));
  }
  return rpy;
}

RigidPose UrdfElements::origin(const XmlElement& element, const std::string& whose) {
  const XmlElement* child = only_child(element, "origin");
  if (child == nullptr) return {};
  return {turn_rpy(angles(*child, whose)), vector(*child, "xyz", {})};
}

const XmlElement* UrdfElements::only_child(const XmlElement& element, std::string_view name) {
  const XmlElement* first = nullptr;
  for (const XmlElement& child : element.children) {
    if (child.name != name) continue;
    if (first != nullptr) {
      values_.error(child, fmt::format("<{}> stands twice in <{}>", name, printable(element.name)),
                    fmt::format("the first is on line {}", first->position.line));
    }
    if (first == nullptr) first = &child;
  }
  return first;
}

}  // namespace dyngen
