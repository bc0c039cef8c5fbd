// SPDX-License-Identifier: MIT
// What the pictures of docs/explanation/proof.md show, as CSV: proof.gnuplot draws them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/blind/score/score.h"
#include "tests/blind/score/shares.h"

namespace blind {

/// Single effects by wanted lambda: the geometric mean of what they have, and the share found.
std::vector<std::pair<double, Share>> detection_steps(const std::vector<const Judged*>& singles);

/// Text by file name:
/// detection.csv  single effects by wanted lambda: found, and family first, with intervals
/// oracle.csv     power of who knows the form, of 1, 2 and 4 parameters, and of 1 at the level of a
///                diagnosis
/// confusion.csv  truth (rows) and first answer (columns), how often; no pairs, no crowds
/// heldout.csv    single effects that were found: held-out rms over the oracle's, before and after
/// concealed.csv  single effects: share absorbed, residual above the floor
/// Rows do not depend on the names of cases. A file that would have no rows is left out.
std::map<std::string, std::string> figures(const std::vector<Judged>& all);

}  // namespace blind
