// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gen/trace/form.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Text between formulas: what LaTeX would take as a command is escaped.
std::string latex_text(std::string_view text);

/// "kg m^2"
std::string latex_unit(std::string_view unit);

/// "0.45", "1.2 \cdot 10^{-5}"
std::string latex_number(const std::string& decimal);

/// A name of letters and digits in parts that '_' separates: "W1_3" is W_{1,3}, "ZZR2"
/// \mathit{ZZR}_{2}.
std::string latex_name(const std::string& name);

/// A formula of grouping_formula(): "d3^2 (M3 + M4)".
std::string latex_formula(const std::string& formula);

/// left = right as lines of align*: the right side is broken before its signs where it gets long.
/// @param terms  of the right side, each with its sign in front but for a positive first one
std::string latex_equation(const std::string& left, const std::vector<std::string>& terms);

/// The terms of a formula as latex_formula() spells them, cut at the signs outside of brackets.
std::vector<std::string> latex_terms(const std::string& formula);

/// The names of one program in formulas. Two names never look alike: what would is spelled letter
/// by letter.
class LatexSpelling {
 public:
  explicit LatexSpelling(const Trace& trace);  ///< the trace must outlive it

  [[nodiscard]] std::string symbol(const GiNaC::ex& symbol) const;
  /// The terms of the value with their signs.
  [[nodiscard]] std::vector<std::string> terms(const GiNaC::ex& value) const;

 private:
  [[nodiscard]] std::string form(const Form& form) const;
  [[nodiscard]] std::string call(const Form& form) const;

  const Trace& trace_;
  std::map<int, std::string> names_;  ///< by place
};

}  // namespace dyngen
