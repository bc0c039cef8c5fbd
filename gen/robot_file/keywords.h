// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "gen/robot_file/robot_file.h"

namespace dyngen {

struct Keyword {
  std::string_view spelling;  ///< as the documentation writes it
  Statement statement = Statement::kValues;
  RowKey row = RowKey::kSigma;  ///< of Statement::kValues
};

/// The keyword that a word spells, in any case; null if it spells none.
const Keyword* find_keyword(std::string_view word);

/// What to do about a word that stands where a keyword belongs and is none.
std::string keyword_hint(std::string_view word);

/// Whether '*' may stand in the row.
bool may_be_unknown(RowKey key);

/// qmin qmax vmax amax taumax: '-' says that a joint has no limit.
bool is_limit(RowKey key);

/// cX .. irZ: the CAD form of a body.
bool is_cad_row(RowKey key);

/// Rows of bodies that have two forms: '-' says that a link has the other one.
bool has_other_form(RowKey key);

/// gx, gy, gz: one value in all, not one per joint.
bool is_scalar(RowKey key);

}  // namespace dyngen
