// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "gen/trace/trace.h"

namespace dyngen {

/// True for a sine or cosine alone.
bool is_sin_or_cos(const GiNaC::ex& value);

/// True if nothing that a function works out stands in a value: inputs, parameters and numbers
/// alone.
bool reads_arguments_alone(const GiNaC::ex& value, const SymbolTable& symbols);

/// The angles whose sine or cosine a function takes, in the order in which it first does: those
/// that can be known before everything else, an input or a statement that reads no other statement.
std::vector<GiNaC::ex> find_angles(const Trace& trace);

bool is_one_of(const std::vector<GiNaC::ex>& angles, const GiNaC::ex& symbol);

}  // namespace dyngen
