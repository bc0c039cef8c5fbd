// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/blind/cases/case.h"
#include "tests/blind/cases/habit.h"
#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

namespace fs = std::filesystem;

std::ofstream open(const fs::path& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error("cannot write " + path.string());
  return file;
}

/// How a case was recorded, where that is not the laboratory's habit.
void add_habit(const Case& made, nlohmann::json& entry) {
  const Habit& habit = habit_of(made.options.habit);
  if (habit.name == habit_of("").name) return;
  entry["habit"] = habit.name;
  entry["allowed"] = habit.allowed;
  const auto list = [](const Eigen::VectorXd& v) {
    return std::vector<double>(v.begin(), v.end());
  };
  entry["recording"] = {{"files", made.training.size()},
                        {"length", made.length},
                        {"periods", made.periods},
                        {"jitter", made.logger.jitter},
                        {"stamp_digit", made.logger.digit},
                        {"late", made.logger.late},
                        {"gain", list(made.logger.gain)},
                        {"disturbance", made.disturbance},
                        {"memory", made.memory},
                        {"compensation", list(made.compensation)}};
}

}  // namespace

std::string colour_name(Colour colour) {
  switch (colour) {
    case Colour::kWhite:
      return "white";
    case Colour::kAutoregressive:
      return "autoregressive";
    case Colour::kMixed:
      return "mixed";
    case Colour::kPink:
      return "pink";
  }
  return "";
}

void write_recording(const Recording& recording, const Logger& logger, bool exact,
                     const std::string& path) {
  std::ofstream file = open(path);
  const Index joints = recording.log.q.cols();
  std::string text = "time";
  for (Index j = 0; j < joints; ++j) text += fmt::format(",q{}", j + 1);
  for (Index j = 0; j < joints; ++j) text += fmt::format(",tau{}", j + 1);
  for (Index j = 0; exact && j < joints; ++j) text += fmt::format(",qd{}", j + 1);
  for (Index j = 0; exact && j < joints; ++j) text += fmt::format(",qdd{}", j + 1);
  file << text << '\n';
  const Columns columns = columns_of(recording, logger);
  for (Index k = 0; k < columns.time.size(); ++k) {
    text = fmt::format("{:.6f}", columns.time[k]);
    for (Index j = 0; j < joints; ++j) text += fmt::format(",{:.12g}", columns.q(k, j));
    for (Index j = 0; j < joints; ++j) text += fmt::format(",{:.9g}", columns.tau(k, j));
    for (Index j = 0; exact && j < joints; ++j) text += fmt::format(",{:.12g}", columns.qd(k, j));
    for (Index j = 0; exact && j < joints; ++j) text += fmt::format(",{:.12g}", columns.qdd(k, j));
    file << text << '\n';
  }
}

nlohmann::json manifest_entry(const Case& made) {
  nlohmann::json entry = {{"kind", made.options.kind},
                          {"seed", made.options.seed},
                          {"wanted_lambda", made.options.lambda},
                          {"wanted_family", made.options.family},
                          {"arm", made.arm},
                          {"engine", made.engine},
                          {"loop", made.loop},
                          {"rate", made.rate},
                          {"noise", colour_name(made.noise.colour)},
                          {"noise_memory", made.noise.memory},
                          {"encoder_bits", made.noise.bits},
                          {"excess", made.excess},
                          {"heldout_oracle", made.heldout_oracle},
                          {"filtered", made.filtered},
                          {"heldout_base", made.heldout_base},
                          {"imitated", made.imitated},
                          {"truths", nlohmann::json::array()}};
  for (std::size_t i = 0; i < made.truths.size(); ++i) {
    const Truth& truth = made.truths[i];
    entry["truths"].push_back({{"family", truth.family},
                               {"form", truth.form},
                               {"joint", truth.joint},
                               {"other_joint", truth.other},
                               {"own_form", truth.own_form},
                               {"size", made.sizes[i]},
                               {"lambda", made.lambdas[i]},
                               {"absorbed", made.absorbed[i]},
                               {"numbers", truth.numbers}});
    if (made.options.kind == "crowd") entry["truths"].back()["wanted_lambda"] = made.wanted[i];
    if (truth.parameters) {
      entry["truths"].back()["parameters"] = truth.parameters(made.sizes[i]);
      entry["truths"].back()["formula"] = truth.formula;
    }
  }
  add_habit(made, entry);
  return entry;
}

void write_case(const Case& made, const std::string& arms, const std::string& folder) {
  fs::create_directories(folder);
  fs::copy_file(fs::path(arms) / (made.arm + ".robot"), fs::path(folder) / "robot.robot",
                fs::copy_options::overwrite_existing);
  for (std::size_t i = 0; i < made.training.size(); ++i) {
    write_recording(made.training[i], made.logger, !made.options.noisy,
                    fs::path(folder) / fmt::format("train{}.csv", i + 1));
  }
  for (std::size_t i = 0; i < made.heldout.size(); ++i) {
    write_recording(made.heldout[i], made.logger, !made.options.noisy,
                    fs::path(folder) / fmt::format("held{}.csv", i + 1));
  }
}

}  // namespace blind
