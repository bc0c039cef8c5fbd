// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/trace/angles.h"

#include <algorithm>
#include <set>
#include <string>

#include "gen/symbols/calls.h"

namespace dyngen {

bool is_sin_or_cos(const GiNaC::ex& value) {
  const std::string name = call_name(value);
  return name == "sin" || name == "cos";
}

bool reads_arguments_alone(const GiNaC::ex& value, const SymbolTable& symbols) {
  for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it) && symbols.info(*it).kind == SymbolKind::kIntermediate) {
      return false;
    }
  }
  return true;
}

std::vector<GiNaC::ex> find_angles(const Trace& trace) {
  std::vector<GiNaC::ex> angles;
  std::set<std::string> plain;  // statements that read no other one
  for (const Assignment& assignment : trace.assignments()) {
    const GiNaC::ex& value = assignment.value;
    if (!is_sin_or_cos(value)) {
      if (call_name(value).empty() && reads_arguments_alone(value, trace.symbols())) {
        plain.insert(assignment.target.get_name());
      }
      continue;
    }
    const GiNaC::ex angle = value.op(0);
    const bool known = GiNaC::is_a<GiNaC::symbol>(angle) &&
                       (reads_arguments_alone(angle, trace.symbols()) ||
                        plain.contains(GiNaC::ex_to<GiNaC::symbol>(angle).get_name()));
    if (known && !is_one_of(angles, angle)) angles.push_back(angle);
  }
  return angles;
}

bool is_one_of(const std::vector<GiNaC::ex>& angles, const GiNaC::ex& symbol) {
  return std::any_of(angles.begin(), angles.end(),
                     [&](const GiNaC::ex& angle) { return angle.is_equal(symbol); });
}

}  // namespace dyngen
