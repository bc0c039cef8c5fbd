// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "gen/program/program.h"

namespace dyngen {
namespace {

constexpr std::size_t kBlock =
    64;  // samples at once: registers of a 7-joint program stay in the cache

std::span<const double> input_array(const BatchInputs& inputs, const std::string& name) {
  if (name == "q") return inputs.q;
  if (name == "dq") return inputs.dq;
  if (name == "ddq") return inputs.ddq;
  return inputs.chi;
}

void check_sizes(const Program& program, std::size_t samples, const BatchInputs& inputs,
                 std::span<const double> tau) {
  const auto check = [&](const std::string& name, std::size_t size, std::size_t wanted) {
    if (size < wanted) {
      throw std::invalid_argument("evaluate(): " + name + " has " + std::to_string(size) +
                                  " values, expected at least " + std::to_string(wanted));
    }
  };
  for (const Program::Input& input : program.inputs) {
    const std::size_t elements = static_cast<std::size_t>(input.index) + 1;
    check(input.array, input_array(inputs, input.array).size(),
          input.array == "chi" ? elements : elements * samples);
  }
  for (const Program::Result& result : program.results) {
    check("tau", tau.size(), (static_cast<std::size_t>(result.index) + 1) * samples);
  }
}

double sign(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }

void run(const Instruction& instruction, double* registers, std::size_t count) {
  using Op = Instruction::Op;
  double* target = registers + static_cast<std::size_t>(instruction.target) * kBlock;
  const double* a = registers + static_cast<std::size_t>(instruction.a) * kBlock;
  const double* b = registers + static_cast<std::size_t>(instruction.b) * kBlock;
  const auto each = [&](auto operation) {
    for (std::size_t k = 0; k < count; ++k) target[k] = operation(a[k], b[k]);
  };
  switch (instruction.op) {
    case Op::kAdd:
      each([](double x, double y) { return x + y; });
      break;
    case Op::kSubtract:
      each([](double x, double y) { return x - y; });
      break;
    case Op::kMultiply:
      each([](double x, double y) { return x * y; });
      break;
    case Op::kNegate:
      each([](double x, double) { return -x; });
      break;
    case Op::kSin:
      each([](double x, double) { return std::sin(x); });
      break;
    case Op::kCos:
      each([](double x, double) { return std::cos(x); });
      break;
    case Op::kSign:
      each([](double x, double) { return sign(x); });
      break;
  }
}

}  // namespace

void evaluate(const Program& program, std::size_t samples, const BatchInputs& inputs,
              std::span<double> tau) {
  check_sizes(program, samples, inputs, tau);
  std::vector<double> registers(static_cast<std::size_t>(program.register_count) * kBlock, 0.0);
  const auto at = [&](int reg) {
    return registers.data() + static_cast<std::size_t>(reg) * kBlock;
  };
  for (const Program::Constant& constant : program.constants) {
    std::fill_n(at(constant.reg), kBlock, constant.value);
  }
  for (std::size_t start = 0; start < samples; start += kBlock) {
    const std::size_t count = std::min(kBlock, samples - start);
    for (const Program::Input& input : program.inputs) {
      const std::span<const double> array = input_array(inputs, input.array);
      const std::size_t index = static_cast<std::size_t>(input.index);
      if (input.array == "chi") {
        std::fill_n(at(input.reg), count, array[index]);
      } else {
        std::copy_n(array.begin() + static_cast<std::ptrdiff_t>(index * samples + start), count,
                    at(input.reg));
      }
    }
    for (const Instruction& instruction : program.instructions) {
      run(instruction, registers.data(), count);
    }
    for (const Program::Result& result : program.results) {
      std::copy_n(at(result.reg), count,
                  tau.begin() + static_cast<std::ptrdiff_t>(
                                    static_cast<std::size_t>(result.index) * samples + start));
    }
  }
}

}  // namespace dyngen
