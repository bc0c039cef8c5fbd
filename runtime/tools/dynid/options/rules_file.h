// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Rules of a diagnosis with the values of a file. A line is a rule's name and its value; '#'
/// begins a comment. Rules that the file does not name keep their values.
/// @throws ModelError          with file:line:column: no such rule, no finite number, a rule twice
/// @throws std::runtime_error  if the file cannot be read
DecisionRules read_rules(const std::string& path);

/// A file of all rules, each with its unit, meaning and source as a comment.
std::string rules_text(const DecisionRules& rules);

}  // namespace dyngen::runtime
