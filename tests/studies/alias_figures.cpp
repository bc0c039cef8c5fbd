// SPDX-License-Identifier: MIT
#include "tests/studies/alias_figures.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <vector>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/tools/dynid/diagnose/diagnosis_report.h"
#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/excite/separation_report.h"
#include "tests/runtime/dynid/multisine.h"

namespace dyngen::test {
namespace {

namespace fs = std::filesystem;
using namespace runtime;

constexpr double kSeconds = 20, kSampleTime = 0.005;

/// Files of one study.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / "dyngen_alias_figures") {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// @return its path
  [[nodiscard]] std::string written(const std::string& name, const std::string& text) const {
    std::ofstream((path_ / name)) << text;
    return (path_ / name).string();
  }

 private:
  fs::path path_;
};

std::string robot_text(const std::string& rows) {
  std::ifstream file(DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot");
  std::ostringstream text;
  text << file.rdbuf();
  std::string all = text.str();
  all.insert(all.rfind("stop"), "qmin -2 -2 -2\nqmax 2 2 2\nvmax 2 2 2\namax 8 8 8\n" + rows);
  return all;
}

class Laboratory {
 public:
  explicit Laboratory(const AliasCase& asked)
      : asked_(asked),
        robot_path_(folder_.written("arm.robot", robot_text(""))),
        robot_(describe_robot(robot_path_, OpenParameters::kAbsentRows)),
        plant_(describe_robot(folder_.written("plant.robot", robot_text(asked.effect + "\n")),
                              OpenParameters::kAsWritten)) {}

  Recording multisine_of(std::uint64_t seed, double seconds) const {
    return multisine(plant_.linear, plant_.grouping * plant_.standard,
                     {.seconds = seconds,
                      .sample_time = kSampleTime,
                      .period = seconds,
                      .size = asked_.size,
                      .seed = seed});
  }

  MotionSource recorded(Recording motion, std::uint64_t seed) const {
    motion.run_starts = {0};
    motion.tau =
        plant_.linear.torque(motion.q, motion.dq, motion.ddq, plant_.grouping * plant_.standard);
    motion.tau = recorded_torque(plant_, effect_instances(plant_.model, catalogue_), motion);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, asked_.noise);
    for (double& value : motion.tau.reshaped()) value += noise(random);
    motion.dq.resize(0, 0);
    motion.ddq.resize(0, 0);
    MotionOptions options;
    options.average_periods = false;
    return motion_of(std::move(motion), options);
  }

  Diagnosis diagnosed(const std::vector<MotionSource>& recordings) const {
    DiagnosisInput input;
    input.model = robot_.linear;
    input.robot = effect_robot(robot_);
    input.train = recordings;
    input.hypotheses = competing_effects(robot_, catalogue_, recordings);
    return diagnose(input);
  }

  SeparationReport designed(const Diagnosis& diagnosis) const {
    ExciteOptions options;
    options.findings = folder_.written(
        "findings.json", diagnosis_json(diagnosis_report(diagnosis, robot_, catalogue_)));
    constexpr int kPeriods = 2;
    options.periods = kPeriods;
    options.duration = asked_.next / kPeriods;
    options.evaluations = asked_.evaluations;
    return make_separation_report(robot_path_, options, {});
  }

 private:
  AliasCase asked_;
  Folder folder_;
  EffectCatalogue catalogue_;
  std::string robot_path_;
  DescribedRobot robot_, plant_;
};

bool names_alone(const Diagnosis& diagnosis, const std::string& family) {
  return diagnosis.findings.size() == 1 &&
         diagnosis.findings.front().aliases == std::vector<std::string>{family};
}

}  // namespace

AliasFigures alias_figures(const AliasCase& asked) {
  const Laboratory laboratory(asked);
  AliasFigures figures;
  std::vector<double> gains;
  for (int i = 1; i <= asked.seeds; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const MotionSource first = laboratory.recorded(laboratory.multisine_of(seed, kSeconds), seed);
    const Diagnosis before = laboratory.diagnosed({first});
    if (before.findings.size() != 1) continue;
    const std::vector<std::string>& names = before.findings.front().aliases;
    const bool has = std::find(names.begin(), names.end(), asked.family) != names.end();
    if (names.size() < 2 || !has) continue;
    ++figures.several;
    figures.wrong_first += names.front() != asked.family;
    const SeparationReport report = laboratory.designed(before);
    if (!report.designed.found) continue;
    gains.push_back(report.designed.separation.least / report.designed.random.least);
    Recording motion;
    motion.time = report.trajectory.time;
    motion.q = report.trajectory.q;
    motion.dq = report.trajectory.dq;
    motion.ddq = report.trajectory.ddq;
    const std::uint64_t again = seed + 1000;
    figures.designed += names_alone(
        laboratory.diagnosed({first, laboratory.recorded(std::move(motion), again)}), asked.family);
    figures.another += names_alone(
        laboratory.diagnosed(
            {first, laboratory.recorded(laboratory.multisine_of(again, asked.next), again)}),
        asked.family);
  }
  std::sort(gains.begin(), gains.end());
  if (!gains.empty()) figures.median_gain = gains[gains.size() / 2];
  return figures;
}

}  // namespace dyngen::test
