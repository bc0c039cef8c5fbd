// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/evaluate/robot_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <stdexcept>
#include <utility>

#include "gen/diagnostic/diagnostic.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

bool same_word(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

/// A quantity of the robot file with its name: "XX2", "d3", "gz".
struct NamedQuantity {
  std::string name;
  Quantity* quantity = nullptr;
};

std::vector<NamedQuantity> named_quantities(RobotModel& model) {
  std::vector<NamedQuantity> all;
  for (int j = 1; j <= model.size(); ++j) {
    JointModel& joint = model.joints[static_cast<std::size_t>(j - 1)];
    all.push_back({fmt::format("d{}", j), &joint.d});
    all.push_back({fmt::format("r{}", j), &joint.r});
    for (std::size_t k = 0; k < kChiCount; ++k) {
      all.push_back({chi_name(static_cast<Chi>(k), j), &joint.chi[k]});
    }
  }
  constexpr std::array<const char*, 3> kGravity = {"gx", "gy", "gz"};
  for (std::size_t k = 0; k < kGravity.size(); ++k) {
    all.push_back({kGravity[k], &model.gravity[k]});
  }
  return all;
}

/// Puts given numbers in place of unknown ones. @return those that name no quantity of the file
std::vector<GivenValue> insert_given(RobotModel& model, const std::vector<GivenValue>& given) {
  std::vector<GivenValue> others;
  const std::vector<NamedQuantity> all = named_quantities(model);
  for (const GivenValue& value : given) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const NamedQuantity& entry) {
      return same_word(entry.name, value.name);
    });
    if (found == all.end()) {
      others.push_back(value);
      continue;
    }
    if (!found->quantity->unknown) {
      throw ModelError(fmt::format(
          "--eval: error: {} is known: {} gives it as {}; only what is unknown ('*') may be given",
          found->name, model.file_name, to_double(found->quantity->value)));
    }
    found->quantity->value = value.value;
    found->quantity->unknown = false;
  }
  return others;
}

[[noreturn]] void refuse_unknown(const RobotModel& model, const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 12;  // a message that can be read
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) {
    list += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > kMostNames) list += fmt::format(" and {} more", names.size() - kMostNames);
  throw ModelError(fmt::format(
      "{}: error: {} {} unknown; write {} in the file, or give {} to --eval as in {}=0.1\n",
      model.file_name, list, names.size() == 1 ? "is" : "are",
      names.size() == 1 ? "the number" : "the numbers", names.size() == 1 ? "it" : "them",
      names[0]));
}

}  // namespace

RobotNumbers::RobotNumbers(const RobotModel& model, const GeneratorOptions& options,
                           const std::vector<GivenValue>& given)
    : model_(model) {
  const std::vector<GivenValue> others = insert_given(model_, given);
  std::vector<std::string> unknown;
  for (const NamedQuantity& entry : named_quantities(model_)) {
    if (entry.quantity->unknown) unknown.push_back(entry.name);
  }
  GeneratorOptions own;
  own.regroup = false;
  own.effects = options.effects;
  own.catalogue = options.catalogue;
  code_ = std::make_unique<CodeModel>(make_code_model(model_, own));
  std::vector<bool> used(others.size(), false);
  for (const ChiEntry& entry : code_->chi) {
    const auto found = std::find_if(others.begin(), others.end(), [&](const GivenValue& value) {
      return !entry.value && same_word(value.name, entry.name);
    });
    if (found != others.end()) used[static_cast<std::size_t>(found - others.begin())] = true;
    const bool of_file = std::find(unknown.begin(), unknown.end(), entry.name) != unknown.end();
    if (!entry.value && found == others.end() && !of_file) unknown.push_back(entry.name);
    chi_.push_back(entry.value             ? to_double(*entry.value)
                   : found != others.end() ? to_double(found->value)
                                           : 0.0);
  }
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (used[i]) continue;
    throw ModelError(
        fmt::format("--eval: error: '{}' is no unknown number of {}; expected q, dq, ddq or a "
                    "parameter that is '*' there, as in XX2=0.1 or d3=0.4\n",
                    others[i].name, model_.file_name));
  }
  if (!unknown.empty()) refuse_unknown(model_, unknown);
}

bool RobotNumbers::has(const std::string& function) const {
  const FunctionName name = parse_function_name(function);
  if (name.spec == nullptr || name.link > code_->size()) return false;
  return name.spec->why_absent == nullptr || name.spec->why_absent(*code_).empty();
}

const Program& RobotNumbers::program(const std::string& function) {
  const auto known = programs_.find(function);
  if (known != programs_.end()) return known->second;
  if (!has(function)) {
    throw std::invalid_argument(fmt::format("{} has no function {}", model_.name, function));
  }
  const RobotFunction written = write_plain_function(parse_function_name(function), *code_);
  return programs_.emplace(function, lower(written.trace)).first->second;
}

std::vector<double> RobotNumbers::run(const std::string& function, const MotionArrays& motion) {
  const Program& own = program(function);
  const std::size_t n = motion.samples;
  const auto of_samples = [n](std::size_t size) { return std::vector<double>(size * n, 0.0); };
  const EffectMemory& memory = code_->memory;
  std::vector<double> z, last = of_samples(memory.last.size()), step = of_samples(1);
  for (const CodeState& state : memory.states) z.insert(z.end(), n, to_double(state.start));
  // a period that no rate reads, since the step is 0
  const std::vector<double> period(n, 1.0);
  const std::vector<InputArray> inputs = {
      {"q", motion.q},  {"dq", motion.dq},  {"ddq", motion.ddq}, {"chi", chi_},
      {kStateArray, z}, {kLastArray, last}, {kStepArray, step},  {kPeriodArray, period}};
  std::vector<double> z_after = z, last_after = last, step_after = step;
  std::vector<OutputArray> outputs = {
      {kStateArray, z_after}, {kLastArray, last_after}, {kStepArray, step_after}};
  std::vector<std::vector<double>> arrays;
  std::vector<std::string> names;
  for (const Argument& argument : arguments(*parse_function_name(function).spec, *code_)) {
    if (!argument.output) continue;
    arrays.push_back(of_samples(static_cast<std::size_t>(argument.size())));
    names.push_back(argument.name);
  }
  for (std::size_t i = 0; i < arrays.size(); ++i) outputs.push_back({names[i], arrays[i]});
  evaluate(own, n, inputs, outputs);
  return std::move(arrays.front());
}

double RobotNumbers::parameter(int link, Chi kind) const {
  return to_double(model_.joint(link).chi[index(kind)].value);
}

}  // namespace dyngen
