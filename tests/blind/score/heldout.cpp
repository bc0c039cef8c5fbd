// SPDX-License-Identifier: MIT
#include "tests/blind/score/heldout.h"

#include <cmath>

namespace blind {

namespace {

using Json = nlohmann::json;

}  // namespace

std::vector<double> in_suite_measure(const Json& truth, const Json& base, const Json& rms) {
  std::vector<double> result;
  const auto own = truth.find("heldout_base");
  const bool known = own != truth.end();
  if (rms.size() != base.size() || (known && own->size() != rms.size())) return result;
  for (std::size_t j = 0; j < rms.size(); ++j) {
    const double here = base[j].get<double>();
    const double factor = known && here > 0 ? (*own)[j].get<double>() / here : 1;
    result.push_back(factor * rms[j].get<double>());
  }
  return result;
}

double over_oracle(const Json& truth, const std::vector<double>& rms) {
  const Json& oracle = truth["heldout_oracle"];
  if (rms.empty() || oracle.size() != rms.size()) return 0;
  double sum = 0;
  for (std::size_t j = 0; j < rms.size(); ++j) {
    sum += std::pow(rms[j] / oracle[j].get<double>(), 2);
  }
  return std::sqrt(sum / static_cast<double>(rms.size()));
}

}  // namespace blind
