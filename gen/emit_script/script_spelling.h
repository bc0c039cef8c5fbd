// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gen/functions/functions.h"
#include "gen/trace/form.h"

namespace dyngen {

/// How a language without declarations spells a program. Values are numbers or arrays of one number
/// per sample.
struct ScriptLanguage {
  std::string multiply, divide;                              ///< of elements: " * ", " ./ "
  std::string comment;                                       ///< begins one: "# "
  std::string continued;                                     ///< ends a line that goes on
  std::string end_of_statement;                              ///< ";" or nothing
  std::size_t most_letters = 0;                              ///< of a name
  std::function<std::string(const Argument&, int)> element;  ///< "q[2]", "q(3, :)"
  std::map<std::string, std::string> calls;  ///< by their names in a Form; others are themselves
};

/// The statements of a function in such a language.
class ScriptBody {
 public:
  /// All must outlive the body.
  ScriptBody(const ScriptLanguage& language, const Trace& trace,
             const std::vector<Argument>& arguments);

  /// Named numbers, then statements under the titles of their sections. @param indent  of each line
  [[nodiscard]] std::string text(const std::string& indent) const;
  [[nodiscard]] std::string expression(const GiNaC::ex& value) const;
  /// Calls of the program, as Form names them.
  [[nodiscard]] const std::set<std::string>& calls() const { return calls_; }

 private:
  [[nodiscard]] std::string form(const Form& form) const;
  [[nodiscard]] std::string joined(const Form& form) const;
  [[nodiscard]] std::string name(const GiNaC::ex& symbol) const;
  void collect(const Form& form);

  const ScriptLanguage& language_;
  const Trace& trace_;
  const std::vector<Argument>& arguments_;
  std::set<std::string> calls_;
  std::set<int> read_;  ///< places of symbols that are read
};

/// Breaks a statement after operators and commas so that lines stay within 100 columns.
std::string wrap_script(const std::string& statement, const std::string& indent,
                        const std::string& continued);

/// A comment of wrapped lines.
std::string script_comment(const std::string& text, const std::string& begin);

/// The name of the robot file, without folders.
std::string source_name(const CodeModel& code);

}  // namespace dyngen
