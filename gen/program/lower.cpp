// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/program/program.h"
#include "gen/symbols/exact.h"
#include "gen/trace/trace.h"

namespace dyngen {
namespace {

using Op = Instruction::Op;

Op operation_of(const std::string& call) {
  static const std::map<std::string, Op> kOperations = {{"sin", Op::kSin},
                                                        {"cos", Op::kCos},
                                                        {"sign", Op::kSign},
                                                        {"exp", Op::kExp},
                                                        {"log", Op::kLog},
                                                        {"tanh", Op::kTanh},
                                                        {"abs", Op::kAbs},
                                                        {"min", Op::kMin},
                                                        {"max", Op::kMax},
                                                        {"sqrt", Op::kSqrt},
                                                        {"pow", Op::kPower},
                                                        {"phi", Op::kDecayMean},
                                                        {"dphi", Op::kDecayMeanSlope}};
  const auto found = kOperations.find(call);
  DYNGEN_ASSERT(found != kOperations.end(), "there is no operation for " + call);
  return found->second;
}

/// Lowers forms to instructions on registers that are written once.
class Lowering {
 public:
  explicit Lowering(const SymbolTable& symbols) : symbols_(symbols) {}

  void assign(const GiNaC::symbol& target, const GiNaC::ex& value) {
    registers_[target.get_name()] = lower_form(canonical_form(value, symbols_));
  }
  int value(const GiNaC::ex& value) { return lower_form(canonical_form(value, symbols_)); }

  Program program;

 private:
  int new_register() { return program.register_count++; }

  int number(double value) {
    const auto [it, added] = numbers_.emplace(value, 0);
    if (added) {
      it->second = new_register();
      program.constants.push_back({value, it->second});
    }
    return it->second;
  }

  int symbol(const GiNaC::ex& symbol) {
    const SymbolInfo& info = symbols_.info(symbol);
    if (info.kind == SymbolKind::kConstant) return number(to_double(info.value));
    if (const auto it = registers_.find(info.name); it != registers_.end()) return it->second;
    DYNGEN_ASSERT(info.kind != SymbolKind::kIntermediate,
                  info.name + " is read before it is written");
    const int reg = new_register();
    program.inputs.push_back({info.array, info.index, reg, info.shared});
    registers_.emplace(info.name, reg);
    return reg;
  }

  int emit(Op op, int a, int b = 0) {
    const int target = new_register();
    program.instructions.push_back({op, target, a, b});
    return target;
  }

  int lower_form(const Form& form) {
    switch (form.kind) {
      case Form::Kind::kNumber:
        return number(to_double(form.leaf));
      case Form::Kind::kSymbol:
        return symbol(form.leaf);
      case Form::Kind::kCall: {
        const int first = lower_form(form.parts[0]);
        const int second = form.parts.size() > 1 ? lower_form(form.parts[1]) : 0;
        return emit(operation_of(form.call), first, second);
      }
      case Form::Kind::kProduct: {
        int result = lower_form(form.parts[0]);
        for (std::size_t i = 1; i < form.parts.size(); ++i) {
          result = emit(Op::kMultiply, result, lower_form(form.parts[i]));
        }
        return result;
      }
      case Form::Kind::kQuotient: {
        const int numerator = lower_form(form.parts[0]);
        return emit(Op::kDivide, numerator, lower_form(form.parts[1]));
      }
      case Form::Kind::kSum: {
        int result = lower_form(form.parts[0]);
        if (form.negative[0]) result = emit(Op::kNegate, result);
        for (std::size_t i = 1; i < form.parts.size(); ++i) {
          const int term = lower_form(form.parts[i]);
          result = emit(form.negative[i] ? Op::kSubtract : Op::kAdd, result, term);
        }
        return result;
      }
    }
    return 0;
  }

  const SymbolTable& symbols_;
  std::unordered_map<std::string, int> registers_;
  std::map<double, int> numbers_;
};

/// Gives each temporary the place of one that is not needed any more.
void reuse_registers(Program& program) {
  constexpr int kForever = -1;
  std::vector<int> last_use(static_cast<std::size_t>(program.register_count), 0);
  for (std::size_t i = 0; i < program.instructions.size(); ++i) {
    const Instruction& instruction = program.instructions[i];
    last_use[static_cast<std::size_t>(instruction.a)] = static_cast<int>(i);
    if (instruction.has_two_operands()) {
      last_use[static_cast<std::size_t>(instruction.b)] = static_cast<int>(i);
    }
  }
  for (const auto& input : program.inputs) last_use[static_cast<std::size_t>(input.reg)] = kForever;
  for (const auto& constant : program.constants) {
    last_use[static_cast<std::size_t>(constant.reg)] = kForever;
  }
  for (const auto& result : program.results)
    last_use[static_cast<std::size_t>(result.reg)] = kForever;

  std::vector<int> place(static_cast<std::size_t>(program.register_count), -1);
  std::vector<int> free;
  int count = 0;
  const auto place_of = [&](int reg) -> int& { return place[static_cast<std::size_t>(reg)]; };
  for (auto& input : program.inputs) input.reg = place_of(input.reg) = count++;
  for (auto& constant : program.constants) constant.reg = place_of(constant.reg) = count++;
  for (std::size_t i = 0; i < program.instructions.size(); ++i) {
    Instruction& instruction = program.instructions[i];
    const auto release = [&](int reg) {
      if (last_use[static_cast<std::size_t>(reg)] == static_cast<int>(i)) {
        free.push_back(place_of(reg));
        last_use[static_cast<std::size_t>(reg)] = kForever;  // a square frees its operand once
      }
    };
    const int a = instruction.a, b = instruction.b;
    instruction.a = place_of(a);
    if (instruction.has_two_operands()) instruction.b = place_of(b);
    release(a);
    if (instruction.has_two_operands()) release(b);
    int& target = place_of(instruction.target);
    if (free.empty()) {
      target = count++;
    } else {
      target = free.back();
      free.pop_back();
    }
    instruction.target = target;
  }
  for (auto& result : program.results) result.reg = place_of(result.reg);
  program.register_count = count;
}

}  // namespace

Program lower(const Trace& trace) {
  Lowering lowering(trace.symbols());
  for (const Assignment& assignment : trace.assignments()) {
    lowering.assign(assignment.target, assignment.value);
  }
  for (const Output& output : trace.outputs()) {
    const int reg = lowering.value(output.value);
    lowering.program.results.push_back({output.array, output.index, reg});
  }
  reuse_registers(lowering.program);
  return std::move(lowering.program);
}

bool same_steps(const Program& a, const Program& b) {
  const auto same_element = [](const Program::Result& x, const Program::Result& y) {
    return x.index == y.index && x.reg == y.reg;
  };
  return a.inputs == b.inputs && a.constants == b.constants && a.instructions == b.instructions &&
         std::equal(a.results.begin(), a.results.end(), b.results.begin(), b.results.end(),
                    same_element);
}

}  // namespace dyngen
