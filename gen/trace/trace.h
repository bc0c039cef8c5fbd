// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gen/symbols/symbol_table.h"
#include "gen/trace/form.h"

namespace dyngen {

/// One statement of the program: target = value.
struct Assignment {
  GiNaC::symbol target;
  GiNaC::ex value;
  int section = 0;  ///< of Trace::sections()
};

/// One element of an output array.
struct Output {
  std::string array;
  int index = 0;
  GiNaC::ex value;
};

/// The name that an output's value gets where it needs a statement: "tau_1", "z_1" of "s->z".
std::string output_name(const std::string& array, int index);

/// A program being written: ordered assignments to named scalars.
///
/// GiNaC does the algebra inside a value; the order of the statements is the order in which an
/// algorithm makes them. What is zero, one, a copy, a negation, a number or already assigned (up to
/// sign) makes no statement: assign() returns the expression that stands for it.
///
/// Source of the method: Khalil and Kleinfinger, "Minimum operations and minimum parameters of the
/// dynamic models of tree structure robots" (IEEE J. Robotics and Automation, 1987).
class Trace {
 public:
  /// @param inputs  the robot's inputs and parameters; must outlive the trace
  explicit Trace(const SymbolTable* inputs) : symbols_(inputs) { sections_.emplace_back(); }

  /// Statements that follow belong to this section (a comment in the emitted code).
  void section(std::string title);

  /// name = value, unless the value needs no statement. A value of mostly negative terms is stored
  /// with its sign changed, under the name "m" + name.
  GiNaC::ex assign(const std::string& name, const GiNaC::ex& value);

  /// A named number. @return the symbol, or the number itself if it is 0, 1 or -1
  GiNaC::ex constant(const std::string& name, const GiNaC::ex& value, const std::string& unit = {},
                     const std::string& comment = {});

  struct SinCos {
    GiNaC::ex sin, cos;
  };
  /// sin and cos of a sum of inputs and a number; right angles need no call.
  /// @param suffix  the names are "S" + suffix and "C" + suffix
  SinCos sin_cos(const std::string& suffix, const GiNaC::ex& angle);

  void output(const std::string& array, int index, const GiNaC::ex& value);

  /// The output array of this name gets another one.
  void rename_output(const std::string& from, const std::string& to);

  /// Makes the outputs so far intermediate results of a longer program. @return them
  std::vector<Output> take_outputs() { return std::exchange(outputs_, {}); }

  /// The same inputs and sections without a statement: what a pass writes its result into.
  [[nodiscard]] Trace without_statements() const;

  /// name = value as it stands, in one of sections(): for what already is a program.
  GiNaC::symbol append(const std::string& name, const GiNaC::ex& value, int section);

  /// Keeps the statements that the outputs need, and forgets the others: a value that is assigned
  /// again later gets a new statement.
  void drop_dead_code();

  /// A statement in a new order.
  struct Position {
    std::size_t statement = 0;  ///< of assignments()
    int section = 0;
  };
  /// The same statements in another order. @param order  each once, after those it reads
  void rearrange(const std::vector<Position>& order);

  [[nodiscard]] const SymbolTable& symbols() const { return symbols_; }
  [[nodiscard]] const std::vector<Assignment>& assignments() const { return assignments_; }
  [[nodiscard]] const std::vector<std::string>& sections() const { return sections_; }
  [[nodiscard]] const std::vector<Output>& outputs() const { return outputs_; }
  /// Operations of all statements and outputs.
  [[nodiscard]] OperationCount count() const;

 private:
  /// sign * constant(name, value) * rest; the rest alone if there is no name
  struct FoldedTerm {
    GiNaC::ex sign;
    std::string name;
    GiNaC::ex value;
    GiNaC::ex rest;
  };
  [[nodiscard]] FoldedTerm split_term(const GiNaC::ex& term) const;
  GiNaC::ex fold_constants(const GiNaC::ex& value);
  [[nodiscard]] bool is_constant(const GiNaC::ex& value) const;
  [[nodiscard]] GiNaC::ex constant_value(const GiNaC::ex& value) const;

  SymbolTable symbols_;
  std::vector<Assignment> assignments_;
  std::vector<std::string> sections_;
  std::vector<Output> outputs_;
  std::map<GiNaC::ex, GiNaC::ex, GiNaC::ex_is_less> assigned_;  // value -> what stands for it
};

}  // namespace dyngen
