// SPDX-License-Identifier: MIT
#include "runtime/plausibility/readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

namespace dyngen::runtime {

Reading Reading::plain(int joints) {
  Reading reading;
  const auto n = static_cast<std::size_t>(joints);
  reading.position_factor = reading.torque_factor = Eigen::VectorXd::Ones(joints);
  reading.position_from.resize(n);
  std::iota(reading.position_from.begin(), reading.position_from.end(), 0);
  reading.torque_from = reading.position_from;
  reading.position_lag.assign(n, 0);
  return reading;
}

std::vector<NamedReading> other_units(const LinearModel& model, const Reading& base) {
  std::vector<NamedReading> all;
  const auto scaled = [&](bool revolute, double factor, const char* what, const char* cure) {
    NamedReading reading{revolute ? "degrees" : "position_unit", 0, what, cure, base};
    bool any = false;
    for (std::size_t j = 0; j < model.revolute.size(); ++j) {
      if (model.revolute[j] != revolute) continue;
      reading.reading.position_factor[static_cast<Eigen::Index>(j)] *= factor;
      any = true;
    }
    if (any) all.push_back(std::move(reading));
  };
  scaled(true, std::numbers::pi / 180, "positions of revolute joints look like degrees",
         "multiply them by pi/180");
  scaled(true, 2 * std::numbers::pi, "positions of revolute joints look like turns",
         "multiply them by 2 pi");
  scaled(false, 1e-3, "positions of prismatic joints look like millimetres", "divide them by 1000");
  return all;
}

std::vector<NamedReading> turned_signs(const Reading& base, const std::vector<bool>& judged) {
  std::vector<NamedReading> all;
  for (Eigen::Index j = 0; j < base.torque_factor.size(); ++j) {
    if (!judged[static_cast<std::size_t>(j)]) continue;
    const int joint = static_cast<int>(j) + 1;
    Reading torque = base, position = base;
    torque.torque_factor[j] *= -1;
    position.position_factor[j] *= -1;
    Reading both = torque;
    both.position_factor[j] *= -1;
    all.push_back({"torque_sign", joint, fmt::format("the sign of tau{} looks turned", joint),
                   fmt::format("multiply tau{} by -1", joint), std::move(torque)});
    all.push_back(
        {"position_sign", joint, fmt::format("the sign of q{} looks turned", joint),
         fmt::format("multiply q{} by -1, or turn the joint's axis in the robot file", joint),
         std::move(position)});
    all.push_back(
        {"position_sign", joint,
         fmt::format("q{0} and tau{0} look as if the joint turned about the opposite axis", joint),
         fmt::format("multiply both by -1, or turn the joint's axis in the robot file"),
         std::move(both)});
  }
  return all;
}

std::vector<NamedReading> swapped_columns(const Reading& base, int joint,
                                          const std::vector<bool>& with) {
  std::vector<NamedReading> all;
  const auto i = static_cast<std::size_t>(joint);
  for (std::size_t k = 0; k < base.position_from.size(); ++k) {
    if (k == i || !with[k]) continue;
    const auto named = [&](const char* columns, bool position, bool torque) {
      NamedReading reading{"swapped", 0, {}, {}, base};
      reading.what = fmt::format("{} of joints {} and {} look swapped", columns, std::min(i, k) + 1,
                                 std::max(i, k) + 1);
      reading.cure = "exchange the columns' names in the header";
      if (position) std::swap(reading.reading.position_from[i], reading.reading.position_from[k]);
      if (torque) std::swap(reading.reading.torque_from[i], reading.reading.torque_from[k]);
      all.push_back(std::move(reading));
    };
    named("positions", true, false);
    named("torques", false, true);
    named("positions and torques", true, true);
  }
  return all;
}

}  // namespace dyngen::runtime
