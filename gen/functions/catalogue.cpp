// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/functions/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "gen/functions/function_table.h"

namespace dyngen {

int extent_size(Extent extent, const CodeModel& code) {
  switch (extent) {
    case Extent::kOne:
      return 1;
    case Extent::kThree:
      return 3;
    case Extent::kFour:
      return 4;
    case Extent::kSix:
      return 6;
    case Extent::kJoints:
      return static_cast<int>(code.coordinate_names.size());
    case Extent::kChi:
      return static_cast<int>(code.chi.size());
    case Extent::kBeta:
      return static_cast<int>(code.beta.size());
    case Extent::kFolded:
      return static_cast<int>(code.folded.size());
  }
  return 0;
}

const std::vector<FunctionSpec>& function_catalogue() {
  static const std::vector<FunctionSpec> kCatalogue = function_table();
  return kCatalogue;
}

const FunctionSpec& fold_spec() {
  static const FunctionSpec kFold = {
      .name = "fold",
      .inputs = {},
      .outputs = {{.array = "folded", .rows = Extent::kFolded}},
      .reads = {},
      .summary = "What the other functions read of chi: to be called when chi has changed.",
      .effects = EffectPart::kNone};
  return kFold;
}

std::string FunctionName::text() const {
  return link == 0 ? std::string(spec->name) : fmt::format("{}_{}", spec->name, link);
}

FunctionName parse_function_name(std::string_view name) {
  for (const FunctionSpec& spec : function_catalogue()) {
    if (spec.name == name) return {&spec, 0};
    if (!spec.of_link() || name.size() < spec.name.size() + 2 || !name.starts_with(spec.name) ||
        name[spec.name.size()] != '_') {
      continue;
    }
    const std::string_view digits = name.substr(spec.name.size() + 1);
    int link = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), link);
    // the one spelling of a number: no sign, no zero in front
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (whole && digits[0] >= '1') return {&spec, link};
  }
  return {};
}

const FunctionSpec* find_function(std::string_view name) { return parse_function_name(name).spec; }

std::string catalogue_names() {
  std::string names;
  for (const FunctionSpec& spec : function_catalogue()) {
    names += (names.empty() ? "" : ", ") + std::string(spec.name);
    if (spec.of_link()) names += fmt::format(", {}_LINK", spec.name);
  }
  return names;
}

bool has_state(const FunctionSpec& spec, const CodeModel& code) {
  return spec.effects == EffectPart::kIn && !code.memory.empty();
}

std::vector<Argument> arguments(const FunctionSpec& spec, const CodeModel& code) {
  std::vector<Argument> result;
  if (has_state(spec, code)) {
    result.push_back({.name = std::string(kStateArgument), .state = true});
  }
  const int joints = extent_size(Extent::kJoints, code);
  const auto add = [&](std::string_view name, int size, bool shared) {
    result.push_back({.name = std::string(name), .rows = size, .shared = shared});
  };
  const auto inputs = spec.inputs_of == nullptr ? spec.inputs : spec.inputs_of(code);
  for (const std::string_view name : inputs) add(name, joints, false);
  ExtraInputs reads = spec.reads;
  if (spec.effects == EffectPart::kIn && effects_read(code, {"tau_load"})) reads = kAllInputs;
  if (reads.weights) {
    result.push_back({.name = "A", .rows = joints, .columns = extent_size(Extent::kBeta, code)});
  }
  if (reads.load) add("w", 6, false);
  if (code.options.gravity && reads.gravity) add("gravity", 3, true);
  if (code.options.wrench && reads.wrench) add("wrench", 6, false);
  if (code.options.payload && reads.payload) add("payload", kInertialCount, true);
  if (code.folds() && &spec != &fold_spec()) {
    add("folded", extent_size(Extent::kFolded, code), true);
  } else if (code.takes_chi) {
    add("chi", extent_size(Extent::kChi, code), true);
  }
  for (const OutputSpec& output : spec.outputs) {
    result.push_back({.name = std::string(output.array),
                      .rows = extent_size(output.rows, code),
                      .columns = extent_size(output.columns, code),
                      .output = true});
  }
  return result;
}

}  // namespace dyngen
