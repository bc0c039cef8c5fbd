// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "gen/program/block_functions.h"
#include "gen/program/program.h"
#include "gen/program/scalar_functions.h"

namespace dyngen {
namespace {

constexpr std::size_t kCache = 24 * 1024;  // bytes of registers that stay in the first cache
constexpr std::size_t kLeastBlock = 16, kMostBlock = 256;  // samples at once

/// How many samples are evaluated at once, a multiple of 16.
std::size_t block_of(const Program& program) {
  const std::size_t of_sample = sizeof(double) * static_cast<std::size_t>(program.register_count);
  const std::size_t fit = kCache / std::max<std::size_t>(of_sample, 1) / kLeastBlock * kLeastBlock;
  return std::clamp(fit, kLeastBlock, kMostBlock);
}

template <class Array>
const Array& find_array(const std::vector<Array>& arrays, const std::string& name,
                        std::size_t wanted) {
  for (const Array& array : arrays) {
    if (array.name != name) continue;
    if (array.values.size() >= wanted) return array;
    throw std::invalid_argument("evaluate(): " + name + " has " +
                                std::to_string(array.values.size()) +
                                " values, expected at least " + std::to_string(wanted));
  }
  throw std::invalid_argument("evaluate(): there is no array " + name);
}

/// Where the values of each input and result of a program stand, all checked.
struct Places {
  std::vector<const double*> inputs;
  std::vector<double*> results;
};

Places find_places(const Program& program, std::size_t samples,
                   const std::vector<InputArray>& inputs, const std::vector<OutputArray>& outputs) {
  Places places;
  for (const Program::Input& input : program.inputs) {
    const std::size_t index = static_cast<std::size_t>(input.index);
    const std::size_t per_element = input.shared ? 1 : samples;
    const InputArray& array = find_array(inputs, input.array, (index + 1) * per_element);
    places.inputs.push_back(array.values.data() + index * per_element);
  }
  for (const Program::Result& result : program.results) {
    const std::size_t index = static_cast<std::size_t>(result.index);
    const OutputArray& array = find_array(outputs, result.array, (index + 1) * samples);
    places.results.push_back(array.values.data() + index * samples);
  }
  return places;
}

/// What a processor does to several numbers at once; a target may be an operand of its own.
template <typename Operation>
inline void together(double* target, const double* a, const double* b, std::size_t count,
                     Operation operation) {
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) target[k] = operation(a[k], b[k]);
}

/// All instructions over one block. @param width  from one register to the next
DYNGEN_WIDE void run(const Instruction* instruction, const Instruction* end, double* registers,
                     std::size_t width, std::size_t count) {
  using Op = Instruction::Op;
  for (; instruction != end; ++instruction) {
    double* target = registers + static_cast<std::size_t>(instruction->target) * width;
    const double* a = registers + static_cast<std::size_t>(instruction->a) * width;
    const double* b = registers + static_cast<std::size_t>(instruction->b) * width;
    switch (instruction->op) {
      case Op::kAdd:
        together(target, a, b, count, [](double x, double y) { return x + y; });
        break;
      case Op::kSubtract:
        together(target, a, b, count, [](double x, double y) { return x - y; });
        break;
      case Op::kMultiply:
        together(target, a, b, count, [](double x, double y) { return x * y; });
        break;
      case Op::kDivide:
        together(target, a, b, count, [](double x, double y) { return x / y; });
        break;
      case Op::kNegate:
        together(target, a, b, count, [](double x, double) { return -x; });
        break;
      case Op::kAbs:
        together(target, a, b, count, [](double x, double) { return std::abs(x); });
        break;
      case Op::kSign:
        together(target, a, b, count, [](double x, double) { return scalar::sign(x); });
        break;
      case Op::kMin:
        together(target, a, b, count, [](double x, double y) { return scalar::min(x, y); });
        break;
      case Op::kMax:
        together(target, a, b, count, [](double x, double y) { return scalar::max(x, y); });
        break;
      case Op::kSqrt:
        together(target, a, b, count, [](double x, double) { return std::sqrt(x); });
        break;
      case Op::kSin:
        block::sines(a, target, count);
        break;
      case Op::kCos:
        block::cosines(a, target, count);
        break;
      default:
        for (std::size_t k = 0; k < count; ++k) {
          target[k] = scalar::called(instruction->op, a[k], b[k]);
        }
    }
  }
}

}  // namespace

void evaluate(const Program& program, std::size_t samples, const std::vector<InputArray>& inputs,
              const std::vector<OutputArray>& outputs) {
  const Places places = find_places(program, samples, inputs, outputs);
  const std::size_t width = block_of(program);
  std::vector<double> registers(static_cast<std::size_t>(program.register_count) * width, 0.0);
  const auto at = [&](int reg) { return registers.data() + static_cast<std::size_t>(reg) * width; };
  for (const Program::Constant& constant : program.constants) {
    std::fill_n(at(constant.reg), width, constant.value);
  }
  for (std::size_t start = 0; start < samples; start += width) {
    const std::size_t count = std::min(width, samples - start);
    for (std::size_t i = 0; i < program.inputs.size(); ++i) {
      double* reg = at(program.inputs[i].reg);
      if (program.inputs[i].shared) {
        std::fill_n(reg, count, *places.inputs[i]);
      } else {
        std::copy_n(places.inputs[i] + start, count, reg);
      }
    }
    run(program.instructions.data(), program.instructions.data() + program.instructions.size(),
        registers.data(), width, count);
    for (std::size_t i = 0; i < program.results.size(); ++i) {
      std::copy_n(at(program.results[i].reg), count, places.results[i] + start);
    }
  }
}

}  // namespace dyngen
