// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <set>
#include <string>
#include <vector>

#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/emit_c.h"

namespace dyngen {

/// The statements of a function: of one sample, or of as many samples at once as a register holds.
///
/// In lanes every value that depends on a sample has the type <prefix>_lanes; what depends on
/// shared arguments alone stays a number.
class Body {
 public:
  enum class Width { kOne, kLanes };

  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
  /// All must outlive the body.
  Body(const Trace& trace, const std::vector<Argument>& arguments, const EmitOptions& options,
       Width width = Width::kOne);

  [[nodiscard]] bool reads(const std::string& array) const { return arrays_.contains(array); }
  /// True if the value differs from sample to sample.
  [[nodiscard]] bool varies(const GiNaC::ex& value) const;
  /// Named numbers that the statements read.
  [[nodiscard]] std::string constants() const;
  /// Functions of ours that the statements call, as call_helpers() names them.
  [[nodiscard]] std::set<std::string> helpers() const;
  /// Of an output.
  [[nodiscard]] std::string expression(const GiNaC::ex& value) const {
    return spelling_.expression(value);
  }
  /// All but the outputs.
  [[nodiscard]] std::string statements() const;

 private:
  [[nodiscard]] std::string type(const GiNaC::ex& value) const;
  [[nodiscard]] std::string statement(const Assignment& assignment) const;
  [[nodiscard]] std::string gathered_angles() const;
  [[nodiscard]] std::string gathered_value(const GiNaC::ex& value) const;

  const Trace& trace_;
  const EmitOptions& options_;
  Width width_;
  std::set<std::string> arrays_;   ///< that the statements read
  std::set<int> constant_places_;  ///< named numbers that the statements read
  std::set<int> varying_places_;   ///< symbols that differ from sample to sample
  CSpelling spelling_;
  std::vector<GiNaC::ex> angles_;  ///< whose sines and cosines are computed at once
};

}  // namespace dyngen
