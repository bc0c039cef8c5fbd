// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/blind/cases/case.h"
#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

namespace fs = std::filesystem;

std::ofstream open(const fs::path& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error("cannot write " + path.string());
  return file;
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

void write_recording(const Recording& recording, bool exact, const std::string& path) {
  std::ofstream file = open(path);
  const Index joints = recording.log.q.cols();
  std::string text = "time";
  for (Index j = 0; j < joints; ++j) text += fmt::format(",q{}", j + 1);
  for (Index j = 0; j < joints; ++j) text += fmt::format(",tau{}", j + 1);
  for (Index j = 0; exact && j < joints; ++j) text += fmt::format(",qd{}", j + 1);
  for (Index j = 0; exact && j < joints; ++j) text += fmt::format(",qdd{}", j + 1);
  file << text << '\n';
  for (Index k = 0; k < recording.log.q.rows(); ++k) {
    text = fmt::format("{:.6f}", static_cast<double>(k) / recording.log.rate);
    for (Index j = 0; j < joints; ++j) {
      text += fmt::format(",{:.12g}", recording.log.q(k, j) + recording.encoder_error(k, j));
    }
    for (Index j = 0; j < joints; ++j) {
      text += fmt::format(",{:.9g}", recording.log.recorded(k, j) + recording.torque_noise(k, j));
    }
    for (Index j = 0; exact && j < joints; ++j) {
      text += fmt::format(",{:.12g}", recording.log.dq(k, j));
    }
    for (Index j = 0; exact && j < joints; ++j) {
      text += fmt::format(",{:.12g}", recording.log.ddq(k, j));
    }
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
    if (truth.parameters) {
      entry["truths"].back()["parameters"] = truth.parameters(made.sizes[i]);
      entry["truths"].back()["formula"] = truth.formula;
    }
  }
  return entry;
}

void write_case(const Case& made, const std::string& arms, const std::string& folder) {
  fs::create_directories(folder);
  fs::copy_file(fs::path(arms) / (made.arm + ".robot"), fs::path(folder) / "robot.robot",
                fs::copy_options::overwrite_existing);
  for (std::size_t i = 0; i < made.training.size(); ++i) {
    write_recording(made.training[i], !made.options.noisy,
                    fs::path(folder) / fmt::format("train{}.csv", i + 1));
  }
  for (std::size_t i = 0; i < made.heldout.size(); ++i) {
    write_recording(made.heldout[i], !made.options.noisy,
                    fs::path(folder) / fmt::format("held{}.csv", i + 1));
  }
}

}  // namespace blind
