// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>

namespace dyngen::runtime {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: null.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json numbers(const Eigen::VectorXd& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(number(value));
  return array;
}

}  // namespace dyngen::runtime
