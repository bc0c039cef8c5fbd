// SPDX-License-Identifier: MIT
#include "tests/blind/dynid/competed.h"

#include "runtime/diagnosis/diagnosis.h"

namespace blind {

void compete_by_default(dyngen::runtime::Search& search) {
  const dyngen::runtime::DiagnosisOptions defaults;
  dyngen::runtime::CompetitionOptions options;
  options.false_alarm = defaults.false_alarm;
  options.most_winners = defaults.most_findings;
  options.seed = defaults.seed;
  search.compete(options, {});
}

}  // namespace blind
