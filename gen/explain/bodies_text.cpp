// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/bodies_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

/// Ten numbers, in the order of chi.
using BodyNumbers = std::array<double, kInertialCount>;

/// What rounding has left of zero beside other numbers of its kind is zero.
template <std::size_t N>
std::string number_list(std::array<double, N> values) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::fabs(value));
  std::string text;
  constexpr double kRounding = 1e-15;
  for (const double value : values) {
    text += fmt::format(" {:.6g}", std::fabs(value) <= kRounding * size ? 0.0 : value);
  }
  return text;
}

std::string body_lines(const BodyNumbers& n, int link, const std::string& name) {
  const double m = n[index(Chi::kM)];
  const std::array<double, 3> first = {n[6], n[7], n[8]};
  std::array<double, 6> about_origin{};
  std::copy_n(n.begin(), 6, about_origin.begin());
  std::string text = fmt::format("  {:>2} {}: m {:.6g} kg\n", link, name, m);
  text += "       mX mY mZ" + number_list(first) + " kg m\n";
  text += "       XX XY XZ YY YZ ZZ" + number_list(about_origin) + " kg m^2\n";
  if (m == 0) return text;
  const std::array<double, 3> c = {first[0] / m, first[1] / m, first[2] / m};
  const std::array<double, 6> central = {n[0] - m * (c[1] * c[1] + c[2] * c[2]),
                                         n[1] + m * c[0] * c[1],
                                         n[2] + m * c[0] * c[2],
                                         n[3] - m * (c[0] * c[0] + c[2] * c[2]),
                                         n[4] + m * c[1] * c[2],
                                         n[5] - m * (c[0] * c[0] + c[1] * c[1])};
  text += "       cX cY cZ" + number_list(c) + " m\n";
  return text + "       IXX IXY IXZ IYY IYZ IZZ" + number_list(central) + " kg m^2\n";
}

}  // namespace

std::string bodies_text(const RobotModel& model) {
  if (model.parameters == ParameterMeaning::kBase) return "";
  std::string text;
  for (int j = 1; j <= model.size(); ++j) {
    const JointModel& joint = model.joint(j);
    BodyNumbers numbers{};
    bool known = true, any = false;
    for (std::size_t k = 0; k < kInertialCount; ++k) {
      known = known && !joint.chi[k].unknown;
      any = any || !joint.chi[k].known_zero();
      if (known) numbers[k] = to_double(joint.chi[k].value);
    }
    if (known && any) text += body_lines(numbers, j, joint.name);
  }
  if (text.empty()) return "";
  return "\nBodies, in the axes of their links' frames: about the origin, and about the centre of "
         "mass\n" +
         text;
}

}  // namespace dyngen
