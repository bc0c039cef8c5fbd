// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/mass_matrix/determinacy.h"

#include <vector>

#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/mass_matrix/mass_matrix.h"
#include "gen/base_parameters/numeric_regressor.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Of 60 digits this many may be lost before a pivot is nothing but rounding.
constexpr const char* kRounding = "1e-30";

/// The elements [i][j], i <= j, at random inputs and parameters.
UpperTriangle random_mass_elements(const CodeModel& code) {
  Trace trace(&code.inputs);
  CodeModel named = code;
  named.links = with_named_parameters(trace, code);
  UpperTriangle M = write_mass_elements(trace, named, write_frames(trace, named));
  RandomStream random(1);
  GiNaC::exmap values;
  for (const SymbolTable* table : {&code.inputs, &trace.symbols()}) {
    for (const SymbolInfo& info : table->own()) {
      if (info.kind == SymbolKind::kConstant) {
        values[info.symbol] = info.value.evalf();
      } else if (info.kind != SymbolKind::kIntermediate) {
        values[info.symbol] = random.next();
      }
    }
  }
  for (const Assignment& assignment : trace.assignments()) {
    values[assignment.target] = assignment.value.subs(values).evalf();
  }
  for (std::vector<ex>& row : M) {
    for (ex& element : row) element = element.subs(values).evalf();
  }
  return M;
}

/// The link that a coordinate moves.
int link_of(const CodeModel& code, std::size_t coordinate) {
  for (int j = 1; j <= code.size(); ++j) {
    if (code.link(j).coordinate == static_cast<int>(coordinate)) return j;
  }
  return 0;
}

}  // namespace

int undetermined_joint(const CodeModel& code) {
  const PrecisionScope precision;
  const UpperTriangle M = random_mass_elements(code);
  UpperTriangle H = M;
  // M = L^T D L from the tips to the base
  for (std::size_t k = H.size(); k-- > 0;) {
    const ex rounding = GiNaC::abs(M[k][k]) * GiNaC::numeric(kRounding);
    const bool singular =
        GiNaC::ex_to<GiNaC::numeric>(GiNaC::abs(H[k][k])) <= GiNaC::ex_to<GiNaC::numeric>(rounding);
    if (singular) return link_of(code, k);
    for (std::size_t i = 0; i < k; ++i) {
      const ex factor = H[i][k] / H[k][k];
      for (std::size_t j = 0; j <= i; ++j) H[j][i] -= factor * H[j][k];
    }
  }
  return 0;
}

}  // namespace dyngen
