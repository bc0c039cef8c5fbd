// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <string>
#include <vector>

#include "gen/symbols/symbol_table.h"

namespace dyngen {

/// An expression in the one order in which it is written, counted and evaluated.
///
/// A sum lists its terms with their signs, a product its factors, a quotient two forms; operands
/// stand in the order of the symbol table's places, so the same expression has the same form on
/// every run.
struct Form {
  enum class Kind { kNumber, kSymbol, kSum, kProduct, kQuotient, kCall };
  Kind kind = Kind::kNumber;
  GiNaC::ex leaf = 0;          ///< of kNumber (positive, exact) and kSymbol
  std::string call;            ///< of kCall: see call_name()
  std::vector<Form> parts;     ///< terms, factors, numerator and denominator, or the arguments
  std::vector<bool> negative;  ///< of kSum: the sign of each term
};

/// The form of an expression: always a kSum at the top, with one term or more (0 is the number 0).
///
/// The first term is a positive one where there is one, since a leading minus costs an operation;
/// otherwise terms follow the place of the symbol that is ready last, so sums wait as little as
/// they can.
Form canonical_form(const GiNaC::ex& expression, const SymbolTable& symbols);

/// The operands of a sum, product or quotient with the operators and brackets between them: "a * (b
/// - c)".
/// @param spell  text of one operand
std::string join_operands(const Form& form, const std::function<std::string(const Form&)>& spell);

/// Multiplications, additions and calls; signs are free, a square is one multiplication.
struct OperationCount {
  int multiplications = 0;
  int additions = 0;
  int sin_cos_pairs = 0;
  int signs = 0;
  int calls = 0;      ///< of others than sin, cos and sign: shown apart too
  int divisions = 0;  ///< not in total(): shown apart

  OperationCount& operator+=(const OperationCount& other);
  [[nodiscard]] int total() const { return multiplications + additions; }
};
OperationCount count_operations(const Form& form);

}  // namespace dyngen
