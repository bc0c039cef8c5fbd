// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/program/evaluator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "gen/program/scalar_functions.h"

namespace dyngen {

ProgramEvaluator::ProgramEvaluator(Program program, const std::vector<std::string>& inputs,
                                   const std::vector<std::string>& outputs)
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
    const auto found = std::find(outputs.begin(), outputs.end(), result.array);
    if (found == outputs.end()) {
      throw std::invalid_argument("ProgramEvaluator: the program writes " + result.array +
                                  ", which is not among the outputs");
    }
    writes_.push_back({static_cast<int>(found - outputs.begin()), result.index, result.reg});
  }
  for (const Program::Constant& constant : program.constants) {
    registers_[static_cast<std::size_t>(constant.reg)] = constant.value;
  }
  program_ = std::make_shared<const Program>(std::move(program));
}

void ProgramEvaluator::run(std::initializer_list<const double*> inputs,
                           std::initializer_list<double*> outputs) noexcept {
  using Op = Instruction::Op;
  double* const r = registers_.data();
  for (const Element& read : reads_) r[read.reg] = inputs.begin()[read.array][read.index];
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
      case Op::kAbs:
        r[step.target] = std::abs(r[step.a]);
        break;
      default:
        r[step.target] = scalar::called(step.op, r[step.a], r[step.b]);
    }
  }
  for (const Element& write : writes_) outputs.begin()[write.array][write.index] = r[write.reg];
}

}  // namespace dyngen
