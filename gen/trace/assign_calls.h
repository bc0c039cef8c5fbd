// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>

#include "gen/trace/trace.h"

namespace dyngen {

/// Writes an expression with every call in a statement of its own, the innermost first, in the
/// order of the expression's form. Parts that are numbers become named numbers, worked out now. The
/// sign of an input needs no statement: it stands where it is read.
///
/// @param name  of the statements: name + "_1", name + "_2" ...; of their arguments: name + "_x1"
///              ...; of numbers: name + "_K1" ...
/// @return      the expression in what stands for its calls
GiNaC::ex assign_calls(Trace& trace, const std::string& name, const GiNaC::ex& expression);

}  // namespace dyngen
