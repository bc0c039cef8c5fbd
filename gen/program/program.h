// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dyngen {

class Trace;

/// One operation on registers.
struct Instruction {
  enum class Op { kAdd, kSubtract, kMultiply, kNegate, kSin, kCos, kSign };
  Op op = Op::kAdd;
  int target = 0;
  int a = 0;
  int b = 0;  ///< of the operations with two operands
};

/// A function as a flat list of operations: evaluated without a compiler, over many samples at
/// once.
///
/// The operations and their order are those of the emitted C, so both round alike.
struct Program {
  /// A register that is filled before the first instruction.
  struct Input {
    std::string array;  ///< "q", "dq", "ddq", "chi"
    int index = 0;
    int reg = 0;
  };
  struct Constant {
    double value = 0;
    int reg = 0;
  };
  struct Result {
    int index = 0;
    int reg = 0;
  };
  std::vector<Input> inputs;
  std::vector<Constant> constants;
  std::vector<Instruction> instructions;
  std::vector<Result> results;
  int register_count = 0;
};

/// Lowers a function; registers are used again when their value is not needed any more.
Program lower(const Trace& trace);

/// Samples of one input: array[j * samples + k] is element j of sample k. chi has one sample for
/// all.
struct BatchInputs {
  std::span<const double> q, dq, ddq;
  std::span<const double> chi;
};

/// Evaluates all samples. @param tau  tau[j * samples + k], every element is written
/// @throws std::invalid_argument  if an array that the program reads is too short
void evaluate(const Program& program, std::size_t samples, const BatchInputs& inputs,
              std::span<double> tau);

}  // namespace dyngen
