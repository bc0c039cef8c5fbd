// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dyngen {

class Trace;

/// One operation on registers.
struct Instruction {
  enum class Op {
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kMin,
    kMax,
    kPower,
    kNegate,
    kSin,
    kCos,
    kSign,
    kExp,
    kLog,
    kTanh,
    kAbs,
    kSqrt,
    kDecayMean,      ///< phi: see decay_mean()
    kDecayMeanSlope  ///< dphi
  };
  Op op = Op::kAdd;
  int target = 0;
  int a = 0;
  int b = 0;  ///< of the operations with two operands

  [[nodiscard]] bool has_two_operands() const { return op <= Op::kPower; }
  bool operator==(const Instruction&) const = default;
};

/// A function as a flat list of operations: evaluated without a compiler, over many samples at
/// once.
///
/// The operations and their order are those of the emitted C, so both round alike.
struct Program {
  /// A register that is filled before the first instruction.
  struct Input {
    std::string array;  ///< "q", "chi"
    int index = 0;
    int reg = 0;
    bool shared = false;  ///< one value for all samples

    bool operator==(const Input&) const = default;
  };
  struct Constant {
    double value = 0;
    int reg = 0;

    bool operator==(const Constant&) const = default;
  };
  struct Result {
    std::string array;  ///< "tau", "M"
    int index = 0;
    int reg = 0;
  };
  std::vector<Input> inputs;
  std::vector<Constant> constants;
  std::vector<Instruction> instructions;
  std::vector<Result> results;
  int register_count = 0;
};

/// True if both write the same elements in the same steps; the names of the output arrays may
/// differ.
bool same_steps(const Program& a, const Program& b);

/// Lowers a function; registers are used again when their value is not needed any more.
Program lower(const Trace& trace);

/// The same program for some of its results: steps that only the others need are left out.
/// Registers keep their numbers, so that what is left rounds as before.
Program with_results(const Program& program,
                     const std::function<bool(const Program::Result&)>& wanted);

/// A program in two: what does not depend on one of its inputs, for all samples at once, and the
/// rest.
struct SplitProgram {
  Program ahead;   ///< -> "ahead", `carried` values
  Program rest;    ///< the same results; reads the inputs that it needs, and "ahead"
  int carried = 0;
};

/// Both together round as the whole does.
/// @param array  what the part ahead does not read: of a recursion the state
SplitProgram split_ahead_of(const Program& program, std::string_view array);

/// An input array: values[e * samples + k] is element e of sample k; values[e] of what all samples
/// share (chi, gravity, payload).
struct InputArray {
  std::string_view name;
  std::span<const double> values;
};

/// An output array: values[e * samples + k] is element e of sample k.
struct OutputArray {
  std::string_view name;
  std::span<double> values;
};

/// Evaluates all samples; every element of every output is written.
/// @throws std::invalid_argument  if an array that the program reads or writes is missing or too
/// short
void evaluate(const Program& program, std::size_t samples, const std::vector<InputArray>& inputs,
              const std::vector<OutputArray>& outputs);

}  // namespace dyngen
