// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/diagnosis/scans/hypothesis.h"
#include "runtime/tools/dynid/excite/excite_report.h"
#include "runtime/tools/dynid/excite/excite_values.h"
#include "runtime/tools/dynid/excite/separation_report.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

std::string numbers_text(const EffectInstance& effect) {
  std::string text;
  for (int p = 0; p < effect.law.size(); ++p) {
    text += fmt::format(" {}={:.4g}", effect.law.parameters[static_cast<std::size_t>(p)].name,
                        effect.parameters[p]);
  }
  return text;
}

std::string joint_text(int joint) {
  return joint < 0 ? "all joints" : fmt::format("joint {}", joint + 1);
}

std::string head(const SeparationReport& report) {
  std::string text = fmt::format("{}: separate {} from {} ({}:{})\n", report.robot.linear.name,
                                 report.finding.family, fmt::join(report.rivals, " and "),
                                 short_name(report.effect), numbers_text(report.effect));
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  for (const std::string& rival : report.designed.left_out) {
    text += fmt::format("  left out, since a planned motion does not say: {}\n", rival);
  }
  text += fmt::format("  noise of a torque sample: {}:", report.noise_from);
  for (Index j = 0; j < report.noise.size(); ++j) text += fmt::format(" {:.3g}", report.noise[j]);
  return text + fmt::format("; seed {}\n", report.options.seed);
}

std::string menu(const SeparationReport& report) {
  std::string text = fmt::format("\nseparation after {} periods of {:.6g} s, chi-square\n",
                                 report.periods, report.duration);
  const auto row = [&](double least, const std::string& what) {
    text += fmt::format("{:>12.4g}  {}\n", report.periods * least, what);
  };
  if (report.designed.random.rivals.empty()) {
    text += fmt::format("{:>12}  random motions do not keep the limits\n", "-");
  } else {
    row(report.designed.random.least, fmt::format("random motion, the middle one of five (seed {})",
                                                  report.designed.random_seed));
  }
  for (const ArchetypeScore& score : report.designed.scores) {
    const std::string& motion = words_of(score.archetype).motion;
    const bool all = score.archetype == Archetype::kAllJoints;
    row(score.least, all ? motion : fmt::format("{}: {}", joint_text(score.joint), motion));
  }
  return text;
}

std::string outcome(const SeparationReport& report) {
  const SeparatingTrajectory& designed = report.designed;
  const int periods = report.periods;
  const double least = periods * designed.separation.least;
  std::string text = fmt::format("{:>12.4g}  this one, refined from: {}\n", least,
                                 words_of(designed.archetype).motion);
  if (designed.random.least > 0) {
    text += fmt::format("{:>12.3g}  times the random motion\n",
                        designed.separation.least / designed.random.least);
  }
  text +=
      fmt::format("\n{:<22}{:>12}{:>12}  {}\n", "rival", "random", "this one", "at its nearest");
  const auto before = nearest_rivals(designed.random);
  for (const auto& [family, rival] : nearest_rivals(designed.separation)) {
    const auto own = before.find(family);
    text += fmt::format("{:<22}{:>12.4g}{:>12.4g}  {}\n", family,
                        own == before.end() ? 0 : periods * own->second.lambda,
                        periods * rival.lambda, short_name(rival.rival));
  }
  text += fmt::format("the finding itself, beside the model alone: {:.4g}\n",
                      periods * designed.separation.visible);
  if (least < kSeparated) {
    text += fmt::format(
        "names are apart from {:.0f} on: record {:.0f} periods, or let it be longer (--duration)\n",
        kSeparated, std::ceil(kSeparated / designed.separation.least));
  }
  return text;
}

}  // namespace

std::map<std::string, RivalSeparation> nearest_rivals(const Separation& separation) {
  std::map<std::string, RivalSeparation> nearest;
  for (const RivalSeparation& rival : separation.rivals) {
    const auto [own, first] = nearest.try_emplace(rival.rival.law.family, rival);
    if (!first && rival.lambda < own->second.lambda) own->second = rival;
  }
  return nearest;
}

std::string instruction_of(const SeparationReport& report) {
  const ArchetypeWords& first = archetype_for(report.finding.aliases);
  if (first.instruction.empty() || first.archetype == report.designed.archetype) {
    return first.instruction;
  }
  return fmt::format("What also tells them apart: {}. {}", first.motion, first.instruction);
}

std::string recording_advice(const SeparationReport& report) {
  return fmt::format(
      "record this file ({} periods of {:.6g} s) at {:.6g} Hz or a multiple, and diagnose it "
      "together with the recordings of before",
      report.periods, report.duration, report.samples / report.duration);
}

std::string separation_text(const SeparationReport& report) {
  std::string text = head(report) + menu(report);
  if (!report.designed.found) {
    return text + "\nno trajectory: " + report.designed.message + "\n";
  }
  text += outcome(report) +
          limits_table(report.robot.linear, report.limits, report.designed.shares) + "\n" +
          recording_advice(report) + "\n";
  const std::string instruction = instruction_of(report);
  return instruction.empty() ? text : text + instruction + "\n";
}

}  // namespace dyngen::runtime
