// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <set>
#include <string>

#include "gen/emit_c/emit_c.h"
#include "gen/trace/form.h"

namespace dyngen {

/// The C names of one model: what depends on prefix and scalar.
class CSpelling {
 public:
  /// @param varying  of a function that computes many samples at once: the places of the symbols
  ///                 that differ from sample to sample; null: of a function for one sample
  CSpelling(const EmitOptions& options, const SymbolTable& symbols,
            const std::set<int>* varying = nullptr)
      : options_(options), symbols_(symbols), varying_(varying) {}

  [[nodiscard]] std::string scalar() const;
  /// "9.81", "9.81f"; a leading minus if negative
  [[nodiscard]] std::string number(const GiNaC::ex& value) const;
  [[nodiscard]] std::string symbol(const GiNaC::ex& symbol) const;
  /// "tau[2]"; "s->dt" of what is one number
  [[nodiscard]] static std::string element(const std::string& array, int index);
  [[nodiscard]] std::string expression(const GiNaC::ex& value) const;
  /// Functions of ours that the expression calls, as call_helpers() names them.
  [[nodiscard]] std::set<std::string> helpers(const GiNaC::ex& value) const;

 private:
  [[nodiscard]] std::string form(const Form& form) const;
  [[nodiscard]] std::string call(const Form& form) const;
  [[nodiscard]] bool in_lanes(const Form& form) const;
  void collect_helpers(const Form& form, std::set<std::string>& names) const;

  const EmitOptions& options_;
  const SymbolTable& symbols_;
  const std::set<int>* varying_;
};

/// "PUMA560" of "puma560".
std::string upper_case(std::string text);

/// "PUMA560_FUNCTION": stands before every function that others may call; the user says what it is.
std::string function_macro(const EmitOptions& options);
/// "PUMA560_HELPER": stands before every function that only these call.
std::string helper_macro(const EmitOptions& options);
/// How a table begins: what PUMA560_TABLE says, then "const char *const puma560_joint_names[] = {".
/// @param type  of its elements, const
std::string table_begin(const std::string& type, const std::string& name,
                        const EmitOptions& options);

/// "const double *q": how a function declares an argument. @param array  its name as an array
std::string declared(const Argument& argument, const std::string& array,
                     const EmitOptions& options);

/// Breaks a statement at its operators so that lines stay within 100 columns.
std::string wrap_statement(const std::string& statement);

/// Breaks a declaration at its commas, under the opening bracket.
std::string wrap_arguments(const std::string& declaration);

/// A list of values in brackets, broken at its commas. @param first  "  const double x[2] = {"
std::string wrap_list(const std::string& first, const std::string& list);

/// A comment block of wrapped lines: " * text". @param first  what the first line starts with
std::string wrap_comment(const std::string& text, const std::string& first,
                         const std::string& next);

}  // namespace dyngen
