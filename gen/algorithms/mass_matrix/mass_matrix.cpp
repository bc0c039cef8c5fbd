// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/mass_matrix/mass_matrix.h"

#include "gen/algorithms/mass_matrix/composite_search.h"

namespace dyngen {

UpperTriangle write_mass_elements(Trace& trace, const CodeModel& code,
                                  const std::vector<LinkFrame>& frames) {
  DraftLeaves leaves(trace);
  const CompositeRobot robot(leaves, code, frames);
  const CompositeChoices choices = shortest_choices(leaves, robot);
  Draft draft(leaves);
  const auto elements = draft_mass_elements(draft, robot, choices);
  for (int i = 1; i <= code.size(); ++i) {
    for (int j = i; j <= code.size(); ++j) {
      draft.want(elements[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  const std::vector<GiNaC::ex> written = draft.write();
  const std::size_t n = code.coordinate_names.size();
  UpperTriangle M(n, std::vector<GiNaC::ex>(n, 0));
  std::size_t place = 0;
  for (int i = 1; i <= code.size(); ++i) {
    for (int j = i; j <= code.size(); ++j, ++place) {
      const int row = code.link(i).coordinate, column = code.link(j).coordinate;
      if (row < 0 || column < 0) continue;
      M[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = written[place];
    }
  }
  return M;
}

void write_mass_matrix(Trace& trace, const CodeModel& code, const std::string& array) {
  const UpperTriangle M = write_mass_elements(trace, code, write_frames(trace, code));
  const std::size_t n = M.size();
  trace.section("mass matrix");
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      trace.output(array, static_cast<int>(i * n + j), i <= j ? M[i][j] : M[j][i]);
    }
  }
}

}  // namespace dyngen
