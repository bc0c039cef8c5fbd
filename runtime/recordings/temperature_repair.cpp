// SPDX-License-Identifier: MIT
#include "runtime/recordings/temperature_repair.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr double kZeroCelsius = 273.15;  // K
constexpr double kHottestDrive = 200;    // C: no drive is as hot, none is as cold in K

std::string column_name(const Recording& recording, Index column) {
  return recording.temperature.cols() == 1 ? "temp" : fmt::format("temp{}", column + 1);
}

/// @return how many rows had a value
Index fill_between(const Eigen::VectorXd& time, Eigen::Ref<Eigen::VectorXd> values) {
  Index filled = 0, last = -1;
  for (Index k = 0; k < values.size(); ++k) {
    if (std::isnan(values[k])) continue;
    for (Index i = last + 1; i < k; ++i) {
      const double span = last >= 0 ? time[k] - time[last] : 0;
      const double share = span > 0 ? (time[i] - time[last]) / span : 1;
      values[i] = last >= 0 ? values[last] + share * (values[k] - values[last]) : values[k];
    }
    last = k;
    ++filled;
  }
  if (last >= 0) values.tail(values.size() - last - 1).setConstant(values[last]);
  return filled;
}

}  // namespace

void repair_temperatures(Recording& recording, std::vector<Notice>& notices) {
  const auto tell = [&](const std::string& message) {
    notices.push_back({recording.file_name, 0, 0, message, recording.place_word});
  };
  const Index columns = recording.temperature.cols();
  if (columns == 0 || recording.samples() == 0) return;
  if (columns != 1 && columns != recording.joints()) {
    tell(
        fmt::format("found temperatures temp1 to temp{}, expected one for all joints or one for "
                    "each of {}: whose they are is not known; not used",
                    columns, recording.joints()));
    return;
  }
  for (Index c = 0; c < columns; ++c) {
    auto values = recording.temperature.col(c);
    const Index filled = fill_between(recording.time, values);
    if (filled == 0) {
      tell(fmt::format("found no value in {}, expected one at least: no temperature is used",
                       column_name(recording, c)));
      recording.temperature.resize(0, 0);
      return;
    }
    if (filled < recording.samples()) {
      tell(fmt::format("{} has a value in {} of {} rows; interpolated between them",
                       column_name(recording, c), filled, recording.samples()));
    }
    if (values.mean() > kHottestDrive) {
      tell(fmt::format("{} is {:.4g} in the mean, which is kelvins; converted to degrees Celsius",
                       column_name(recording, c), values.mean()));
      values.array() -= kZeroCelsius;
    }
  }
}

}  // namespace dyngen::runtime
