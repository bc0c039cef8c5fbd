// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gen/program/program.h"

namespace dyngen {

/// A program for one sample at a time, with a workspace that is kept: no allocation, no search for
/// names. evaluate() is the faster way for many samples.
///
///     ProgramEvaluator id(lower(trace), {"q", "dq", "ddq"}, "tau");
///     id.run({q, dq, ddq}, tau);
///
/// A copy has a workspace of its own; one thread at a time for each.
class ProgramEvaluator {
 public:
  /// @param inputs  names of the arrays in the order of run(); there may be some that the program
  ///                does not read
  /// @throws std::invalid_argument  if the program reads an array that is not among inputs, or
  ///         writes another one than output
  ProgramEvaluator(Program program, const std::vector<std::string>& inputs,
                   const std::string& output);

  /// @param inputs  the arrays, in the order of the names     @param output  every element is
  /// written
  void run(std::initializer_list<const double*> inputs, double* output) noexcept;

 private:
  struct Read {
    int array = 0, index = 0, reg = 0;
  };
  std::shared_ptr<const Program> program_;
  std::vector<Read> reads_;
  std::vector<double> registers_;
};

}  // namespace dyngen
