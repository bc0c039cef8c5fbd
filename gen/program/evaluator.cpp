// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/program/evaluator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace dyngen {

ProgramEvaluator::ProgramEvaluator(Program program, const std::vector<std::string>& inputs,
                                   const std::string& output)
    : registers_(static_cast<std::size_t>(program.register_count)) {
  for (const Program::Input& input : program.inputs) {
    const auto found = std::find(inputs.begin(), inputs.end(), input.array);
    if (found == inputs.end()) {
      throw std::invalid_argument("ProgramEvaluator: the program reads " + input.array +
                                  ", which is not among the inputs");
    }
    reads_.push_back({static_cast<int>(found - inputs.begin()), input.index, input.reg});
  }
  for (const Program::Result& result : program.results) {
    if (result.array == output) continue;
    throw std::invalid_argument("ProgramEvaluator: the program writes " + result.array +
                                ", expected " + output);
  }
  for (const Program::Constant& constant : program.constants) {
    registers_[static_cast<std::size_t>(constant.reg)] = constant.value;
  }
  program_ = std::make_shared<const Program>(std::move(program));
}

void ProgramEvaluator::run(std::initializer_list<const double*> inputs, double* output) noexcept {
  using Op = Instruction::Op;
  double* const r = registers_.data();
  for (const Read& read : reads_) r[read.reg] = inputs.begin()[read.array][read.index];
  for (const Instruction& step : program_->instructions) {
    switch (step.op) {
      case Op::kAdd:
        r[step.target] = r[step.a] + r[step.b];
        break;
      case Op::kSubtract:
        r[step.target] = r[step.a] - r[step.b];
        break;
      case Op::kMultiply:
        r[step.target] = r[step.a] * r[step.b];
        break;
      case Op::kDivide:
        r[step.target] = r[step.a] / r[step.b];
        break;
      case Op::kNegate:
        r[step.target] = -r[step.a];
        break;
      case Op::kSin:
        r[step.target] = std::sin(r[step.a]);
        break;
      case Op::kCos:
        r[step.target] = std::cos(r[step.a]);
        break;
      case Op::kSign:
        r[step.target] = static_cast<double>((r[step.a] > 0.0) - (r[step.a] < 0.0));
        break;
    }
  }
  for (const Program::Result& result : program_->results) output[result.index] = r[result.reg];
}

}  // namespace dyngen
