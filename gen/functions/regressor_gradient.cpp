// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/functions/regressor_gradient.h"

#include <vector>

#include "gen/algorithms/regressors/regressor.h"
#include "gen/passes/adjoint.h"
#include "gen/passes/optimise.h"

namespace dyngen {

void write_regressor_gradient(Trace& trace, const CodeModel& code) {
  write_base_regressor(trace, code);
  trace.drop_dead_code();
  std::vector<WeightedOutput> weights;
  for (std::size_t k = 0; k < code.weights.size(); ++k) {
    weights.push_back({"Y", static_cast<int>(k), code.weights[k]});
  }
  std::vector<DerivativeOutput> wanted;
  const auto want = [&](const char* array, GiNaC::ex CodeLink::*input) {
    for (const CodeLink& link : code.links) {
      if (link.coordinate < 0) continue;
      wanted.push_back({GiNaC::ex_to<GiNaC::symbol>(link.*input), array, link.coordinate});
    }
  };
  want("g_q", &CodeLink::q);
  want("g_dq", &CodeLink::dq);
  want("g_ddq", &CodeLink::ddq);
  // what the regressor saves, its gradient saves about four times
  trace = adjoint(optimised(trace, {.patience = 0, .work = 0}), weights, wanted);
}

std::string why_no_regressor_gradient(const CodeModel& code) {
  return code.options.weights ? "" : "its weights A are no input of this code";
}

}  // namespace dyngen
