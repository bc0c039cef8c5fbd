// SPDX-License-Identifier: GPL-2.0-or-later
#include <map>
#include <string>
#include <vector>

#include "gen/program/program.h"

namespace dyngen {
namespace {

/// Where a value stands in one of the two programs.
constexpr int kNowhere = -1;

/// A value of the whole program: every instruction, input and constant makes one.
struct Value {
  bool late = false;  ///< depends on the array
  int ahead = kNowhere, rest = kNowhere;  ///< registers
};

class Splitter {
 public:
  explicit Splitter(const Program& program)
      : program_(program), at_(static_cast<std::size_t>(program.register_count), kNowhere) {}

  SplitProgram run(std::string_view array) {
    for (const Program::Constant& constant : program_.constants) {
      constants_[write(constant.reg, false)] = constant.value;
    }
    for (const Program::Input& input : program_.inputs) {
      const bool late = input.array == array;
      const std::size_t value = write(input.reg, late);
      Program& owner = late ? split_.rest : split_.ahead;
      Program::Input own = input;
      own.reg = (late ? values_[value].rest : values_[value].ahead) = owner.register_count++;
      owner.inputs.push_back(own);
    }
    for (const Instruction& instruction : program_.instructions) add(instruction);
    for (const Program::Result& result : program_.results) {
      split_.rest.results.push_back({result.array, result.index, read_late(of(result.reg))});
    }
    return std::move(split_);
  }

 private:
  std::size_t write(int reg, bool late) {
    at_[static_cast<std::size_t>(reg)] = static_cast<int>(values_.size());
    values_.push_back({late, kNowhere, kNowhere});
    return values_.size() - 1;
  }
  [[nodiscard]] std::size_t of(int reg) const {
    return static_cast<std::size_t>(at_[static_cast<std::size_t>(reg)]);
  }

  void add(const Instruction& instruction) {
    const std::size_t a = of(instruction.a);
    const std::size_t b = instruction.has_two_operands() ? of(instruction.b) : a;
    const bool late = values_[a].late || values_[b].late;
    Instruction own = instruction;
    own.a = late ? read_late(a) : read_ahead(a);
    own.b = instruction.has_two_operands() ? (late ? read_late(b) : read_ahead(b)) : 0;
    Program& owner = late ? split_.rest : split_.ahead;
    own.target = owner.register_count++;
    const std::size_t value = write(instruction.target, late);
    (late ? values_[value].rest : values_[value].ahead) = own.target;
    owner.instructions.push_back(own);
  }

  /// The register of a constant in one of the programs.
  int constant_in(Program& owner, int& place, double value) {
    if (place == kNowhere) {
      place = owner.register_count++;
      owner.constants.push_back({value, place});
    }
    return place;
  }

  int read_ahead(std::size_t value) {
    const auto constant = constants_.find(value);
    if (constant == constants_.end()) return values_[value].ahead;
    return constant_in(split_.ahead, values_[value].ahead, constant->second);
  }

  int read_late(std::size_t value) {
    Value& here = values_[value];
    const auto constant = constants_.find(value);
    if (constant != constants_.end()) {
      return constant_in(split_.rest, here.rest, constant->second);
    }
    if (here.rest == kNowhere) {
      here.rest = split_.rest.register_count++;
      split_.ahead.results.push_back({"ahead", split_.carried, here.ahead});
      split_.rest.inputs.push_back({"ahead", split_.carried, here.rest, false});
      ++split_.carried;
    }
    return here.rest;
  }

  const Program& program_;
  std::vector<int> at_;  // of each register of the whole: the value that stands there now
  std::vector<Value> values_;
  std::map<std::size_t, double> constants_;  // by value
  SplitProgram split_;
};

}  // namespace

SplitProgram split_ahead_of(const Program& program, std::string_view array) {
  return Splitter(program).run(array);
}

}  // namespace dyngen
