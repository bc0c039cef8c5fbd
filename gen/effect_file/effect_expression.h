// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <string>
#include <vector>

#include "gen/diagnostic/diagnostic.h"

namespace dyngen {

/// An expression of an effect file as written: names are not yet given a meaning.
struct EffectExpression {
  enum class Kind {
    kNumber,
    kName,
    kNegate,
    kSum,
    kDifference,
    kProduct,
    kQuotient,
    kPower,
    kCall
  };
  Kind kind = Kind::kNumber;
  std::string name{};    ///< of kName and kCall
  GiNaC::ex number = 0;  ///< of kNumber: exact
  double value = 0;      ///< of kNumber: the nearest double, which any thread may read
  std::vector<EffectExpression> operands{};
  SourcePosition position{};  ///< of the number, the name or the operator
  int length = 1;
};

/// sin, cos, exp, log, tanh, sqrt, abs, sign, min, max: calls that an effect file may hold, with
/// how many arguments each has. `pi` is the only constant with a name.
int effect_call_arguments(const std::string& name);  ///< 0: there is none of this name

/// A piece of a row's text with its place; an expression may go on over several lines.
struct EffectText {
  std::string text;
  SourcePosition position;
};

/// Reads an expression: numbers, names, + - * / ^ ( ), calls.
/// @param row  the keyword, for messages
/// @return     0 where it is wrong, which is reported
EffectExpression parse_effect_expression(const std::vector<EffectText>& pieces,
                                         const std::string& row, Diagnostics& diagnostics);

/// Names in an expression, each once, in the order in which they first stand.
std::vector<std::string> names_in(const EffectExpression& expression);

/// The expression in symbols. sign(qd) of the joint's own velocity asks for the name "sign_qd", so
/// that a caller can say what it is where the velocity is zero or not certain.
/// @param value_of  what stands for a name
GiNaC::ex to_algebra(const EffectExpression& expression,
                     const std::function<GiNaC::ex(const std::string&)>& value_of);

/// The expression in numbers; not finite where it has no value there.
double evaluate(const EffectExpression& expression,
                const std::function<double(const std::string&)>& value_of);

/// "(Fs - Fc)*exp(-(qd/vs)^2)": one spelling, for documents.
std::string spell(const EffectExpression& expression);

}  // namespace dyngen
