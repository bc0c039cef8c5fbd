// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <vector>

#include "gen/program/program.h"

namespace dyngen {

Program with_results(const Program& program,
                     const std::function<bool(const Program::Result&)>& wanted) {
  Program part = program;
  std::erase_if(part.results, [&](const Program::Result& result) { return !wanted(result); });
  // from the end: whether a later step, or a result, reads what a register holds
  std::vector<bool> read(static_cast<std::size_t>(program.register_count), false);
  const auto is_read = [&](int reg) { return read[static_cast<std::size_t>(reg)]; };
  const auto set = [&](int reg, bool value) { read[static_cast<std::size_t>(reg)] = value; };
  for (const Program::Result& result : part.results) set(result.reg, true);
  part.instructions.clear();
  for (auto step = program.instructions.rbegin(); step != program.instructions.rend(); ++step) {
    if (!is_read(step->target)) continue;
    set(step->target, false);
    set(step->a, true);
    if (step->has_two_operands()) set(step->b, true);
    part.instructions.push_back(*step);
  }
  std::reverse(part.instructions.begin(), part.instructions.end());
  std::erase_if(part.inputs, [&](const Program::Input& input) { return !is_read(input.reg); });
  std::erase_if(part.constants,
                [&](const Program::Constant& constant) { return !is_read(constant.reg); });
  return part;
}

}  // namespace dyngen
