// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gen/program/program.h"

namespace dyngen {

/// A program for one sample at a time, with a workspace that is kept: no allocation, no search for
/// names. evaluate() is the faster way for many samples.
///
///     ProgramEvaluator id(lower(trace), {"q", "dq", "ddq"}, "tau");
///     id.run({q, dq, ddq}, tau);
///     ProgramEvaluator gradient(lower(other), {"q", "dq", "ddq", "A"}, {"g_q", "g_dq", "g_ddq"});
///     gradient.run({q, dq, ddq, A}, {g_q, g_dq, g_ddq});
///
/// A copy has a workspace of its own; one thread at a time for each.
class ProgramEvaluator {
 public:
  /// @param inputs  names of the arrays in the order of run(); there may be some that the program
  ///                does not read
  /// @throws std::invalid_argument  if the program reads an array that is not among inputs, or
  ///         writes one that is not among outputs
  ProgramEvaluator(Program program, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs);
  ProgramEvaluator(Program program, const std::vector<std::string>& inputs,
                   const std::string& output)
      : ProgramEvaluator(std::move(program), inputs, std::vector<std::string>{output}) {}

  /// Writes every element that the program computes. All inputs are read before the first is
  /// written.
  /// @param inputs, outputs  the arrays, in the order of the names
  void run(std::initializer_list<const double*> inputs,
           std::initializer_list<double*> outputs) noexcept;
  void run(std::initializer_list<const double*> inputs, double* output) noexcept {
    run(inputs, {output});
  }

 private:
  struct Element {
    int array = 0, index = 0, reg = 0;
  };
  std::shared_ptr<const Program> program_;
  std::vector<Element> reads_, writes_;
  std::vector<double> registers_;
};

}  // namespace dyngen
