// SPDX-License-Identifier: MIT
// `dynid excite --for`: trajectories that tell the names of a finding apart.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "runtime/excitation/limited_trajectory.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "runtime/tools/dynid/excite/separation_report.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using ForJson = nlohmann::ordered_json;
using test::content;
using test::dynid;
using test::Outcome;
using test::temporary_path;

const std::string kSearch = " --evaluations 250 ";

/// A robot file with further rows.
std::string robot(const std::string& source, const std::string& name, const std::string& rows) {
  std::string text = content(std::string(DYNGEN_SOURCE_DIR "/") + source);
  text.insert(text.rfind("stop"), rows);
  std::ofstream(temporary_path(name)) << text;
  return temporary_path(name);
}

std::string small_arm() {
  return robot("robots/planar2r.robot", "arm.robot",
               "qmin -2.5 -2.5\nqmax 2.5 2.5\nvmax 2 3\namax 8 12\ntaumax 60 30\n");
}

/// What dynid diagnose writes of one finding on the small arm.
ForJson findings(const std::string& family, int joint,
              const std::vector<std::pair<std::string, double>>& parameters,
              const std::vector<std::string>& aliases) {
  ForJson numbers = ForJson::object();
  for (const auto& [name, value] : parameters) {
    numbers[name] = {{"value", value}, {"std", nullptr}, {"unit", "1"}};
  }
  return {{"schema", "dynid.diagnosis/1"},
          {"robot", "planar2r"},
          {"joints", 2},
          {"verdict", "explained"},
          {"findings",
           {{{"family", family},
             {"joint", joint},
             {"other_joint", nullptr},
             {"aliases", aliases},
             {"probability", 0.6},
             {"formula", ""},
             {"parameters", numbers}}}},
          {"base_parameters", ForJson::array()},
          {"heldout", {{"noise_floor", {0.3, 0.2}}}}};
}

ForJson stribeck_findings() {
  return findings("stribeck", 2, {{"Fs", 3.3}, {"vs", 0.05}, {"delta", 2}},
                  {"stribeck", "presliding"});
}

std::string written(const std::string& name, const ForJson& json) {
  std::ofstream(temporary_path(name)) << json.dump();
  return temporary_path(name);
}

struct Pair {
  ForJson findings;
  double least_gain;  ///< over a random motion of the same length; in brackets what was seen
};

TEST(ExciteFor, WritesAsManyPeriodsAsNamesTake) {
  const std::string arm = small_arm();
  ExciteOptions options;
  options.findings = written("f.json", stribeck_findings());
  options.evaluations = 20;
  const auto periods_at = [&](double noise) {
    options.noise = {noise};
    const SeparationReport report = make_separation_report(arm, options, {});
    EXPECT_TRUE(report.designed.found) << report.designed.message;
    EXPECT_EQ(report.trajectory.samples(), Eigen::Index{report.periods} * report.samples + 1);
    return std::pair(report.periods, report.designed.separation.least);
  };
  const auto [usual, much] = periods_at(1e-3);
  EXPECT_EQ(usual, 5);
  const auto [most, little] = periods_at(1e3);
  EXPECT_EQ(most, 20);
  EXPECT_LT(20 * little, kSeparated);
  // squares go with 1 / noise^2: here ten periods have half as much again as is needed
  const auto [some, each] = periods_at(1e-3 * std::sqrt(10 * much / (1.5 * kSeparated)));
  EXPECT_NEAR(some, 10, 1);
  EXPECT_GE(some * each, 1.5 * kSeparated);
  options.periods = 3;
  EXPECT_EQ(periods_at(1e3).first, 3);
}

TEST(ExciteFor, SeparatesAliasesBetterThanARandomMotion) {
  const std::vector<Pair> pairs = {
      {stribeck_findings(), 3},  // (4.9)
      {findings("load_friction", 1, {{"mu", 0.05}}, {"load_friction", "position_friction"}),
       4},  // (8.2)
      {findings("load_friction", 1, {{"mu", 0.05}}, {"load_friction", "torque_saturation"}),
       1.8},                                                                                // (2.5)
      {findings("time_delay", 0, {{"T", 0.004}}, {"time_delay", "joint_elasticity"}), 20},  // (93)
  };
  const std::string arm = small_arm();
  for (const Pair& pair : pairs) {
    ExciteOptions options;
    options.findings = written("f.json", pair.findings);
    options.evaluations = 250;
    options.periods = 2;
    const SeparationReport report = make_separation_report(arm, options, {});
    const std::string names = pair.findings["findings"][0]["aliases"].dump();
    ASSERT_TRUE(report.designed.found) << names << report.designed.message;
    EXPECT_GT(report.designed.separation.least, pair.least_gain * report.designed.random.least)
        << names;
    EXPECT_GT(report.designed.random.least, 0) << names;
    // limits at another rate than the one they were checked at, and at the rows
    EXPECT_LE(shares_at_rate(report.robot.linear, report.limits, report.designed.motion.duration,
                             report.designed.motion.at, 7919)
                  .largest(),
              1)
        << names;
    const Trajectory& rows = report.trajectory;
    EXPECT_EQ(rows.samples(), 2 * 2000 + 1);
    EXPECT_LE(
        limit_shares(report.robot.linear, report.limits, {rows.q, rows.dq, rows.ddq}).largest(), 1)
        << names;
    for (const Index end : {Index{0}, Index{2000}, Index{4000}}) {
      EXPECT_LT(rows.dq.row(end).norm() + rows.ddq.row(end).norm(), 1e-9) << names;
      EXPECT_LT((rows.q.row(end) - rows.q.row(0)).norm(), 1e-9) << names;
    }
  }
}

TEST(ExciteFor, WritesTheTrajectoryAndSaysWhatItIsWorth) {
  const std::string command = "excite " + small_arm() + " --for " +
                              written("f.json", stribeck_findings()) + kSearch + "--json " +
                              temporary_path("s.json") + " -o ";
  const Outcome run = dynid(command + temporary_path("a.csv"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  for (const char* part : {"separate stribeck from presliding (stribeck 2: Fs=3.3 vs=0.05 delta=2)",
                           "the noise floor of the findings: 0.3 0.2", "seed 1",
                           "random motion, the middle one", "times the random motion",
                           "joint 2: reversals within reversals", "largest share", "written: "}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << "\n" << run.out;
  }
  const Trajectory trajectory = read_trajectory(temporary_path("a.csv"));
  EXPECT_EQ(trajectory.samples(), 5 * 2000 + 1);
  const ForJson json = ForJson::parse(content(temporary_path("s.json")));
  EXPECT_EQ(json["schema"], "dynid.separation/1");
  EXPECT_TRUE(json["found"]);
  EXPECT_EQ(json["rivals"], ForJson({"presliding"}));
  EXPECT_EQ(json["finding"]["effect"], "stribeck");
  EXPECT_GT(json["separation"].get<double>(), 3 * json["random"].get<double>());
  EXPECT_EQ(json["archetypes"].size(), 8u);
  for (const char* kind : {"position", "speed", "acceleration", "torque"}) {
    for (const auto& share : json["largest_share_of_limits"][kind]) EXPECT_LE(share, 1.0) << kind;
  }
  // the same bytes
  const std::string first = content(temporary_path("s.json"));
  ASSERT_EQ(dynid(command + temporary_path("b.csv")).exit_code, 0);
  EXPECT_EQ(content(temporary_path("a.csv")), content(temporary_path("b.csv")));
}

TEST(ExciteFor, AsksForARunWithAnotherLoadInWords) {
  const Outcome run = dynid("excite " + small_arm() + " --for " +
                            written("f.json", findings("load_friction", 1, {{"mu", 0.05}},
                                                       {"load_friction", "torque_saturation"})) +
                            " --evaluations 60 -o " + temporary_path("a.csv"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.out.find("Run it twice if you can, without and with a payload"), std::string::npos)
      << run.out;
}

class ExciteForWrong : public testing::Test {
 protected:
  /// The message about a file with this text; nothing is written.
  static std::string refused(const std::string& text, int exit_code = 1) {
    std::ofstream(temporary_path("wrong.json")) << text;
    const std::string out = temporary_path("wrong.csv");
    const Outcome run = dynid("excite " + small_arm() + " --for " + temporary_path("wrong.json") +
                              " --evaluations 40 -o " + out);
    EXPECT_EQ(run.exit_code, exit_code) << run.out;
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_NE(run.out.find("wrong.json"), std::string::npos) << run.out;
    return run.out;
  }
  static std::string refused(const ForJson& json) { return refused(json.dump()); }

  static void expect_part(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
};

TEST_F(ExciteForWrong, FilesThatAreNoFindings) {
  const Outcome absent =
      dynid("excite " + small_arm() + " --for absent.json -o " + temporary_path("wrong.csv"));
  EXPECT_EQ(absent.exit_code, 1);
  expect_part(absent.out, "absent.json: it cannot be opened");
  expect_part(refused(std::string("{\n\"schema\": \n")), "not JSON, expected what dynid diagnose");
  expect_part(refused(std::string("[1, 2]")), "the file: found [1,2], expected an object");
  expect_part(refused(std::string("{}")), "schema: found nothing, expected the key of schema");
  ForJson other = stribeck_findings();
  other["schema"] = "dynid.atlas/1";
  expect_part(refused(other), "schema: found \"dynid.atlas/1\", expected \"dynid.diagnosis/1\"");
  other = stribeck_findings();
  other["findings"] = "none";
  expect_part(refused(other), "findings: found \"none\", expected an array");
  other = stribeck_findings();
  other["findings"][0].erase("parameters");
  expect_part(refused(other), "findings[0].parameters: found nothing");
  other = stribeck_findings();
  other["findings"][0]["parameters"]["vs"]["value"] = "fast";
  expect_part(refused(other), "found \"fast\", expected a number or null");
  other = stribeck_findings();
  other["findings"][0]["parameters"]["vs"]["value"] = nullptr;
  expect_part(refused(other), "parameters.vs.value: found null, expected a number");
  other = stribeck_findings();
  other["findings"][0]["joint"] = 1.5;
  expect_part(refused(other), "findings[0].joint: found 1.5, expected a whole number");
}

TEST_F(ExciteForWrong, FindingsThatDoNotFitTheRobotOrTheCatalogue) {
  ForJson other = stribeck_findings();
  other["findings"][0]["joint"] = 3;
  expect_part(refused(other), "findings[0].joint: found 3, expected at most 2, the joints of");
  other = stribeck_findings();
  other["joints"] = 6;
  expect_part(refused(other), "joints: found 6, expected 2");
  other = stribeck_findings();
  other["findings"][0]["aliases"][1] = "witchcraft";
  expect_part(refused(other), "found 'witchcraft', which no effect is of; expected one of");
  other = stribeck_findings();
  other["findings"][0]["family"] = "witchcraft";
  expect_part(refused(other), "no effect of the family witchcraft can be on joint 2");
  other = findings("stribeck", 2, {{"height", 3}}, {"stribeck", "presliding"});
  expect_part(refused(other),
              "no effect of the family stribeck can be on joint 2 with the "
              "parameters height");
}

TEST_F(ExciteForWrong, NothingIsLeftToSeparate) {
  ForJson other = stribeck_findings();
  other["findings"][0]["aliases"] = {"stribeck"};
  expect_part(refused(other), "each of its 1 findings has one name: nothing is left to separate");
  other["findings"] = ForJson::array();
  expect_part(refused(other), "it has no findings: nothing is left to separate");
}

TEST_F(ExciteForWrong, OptionsOfTheOtherDesignAreRefused) {
  const std::string command = "excite " + small_arm() + " --for " +
                              written("f.json", stribeck_findings()) + " -o " +
                              temporary_path("t.csv");
  for (const char* option : {" --criterion d", " --form spline", " --harmonics 4", " --starts 2",
                             " --unit-columns", " --parameters inertial"}) {
    EXPECT_EQ(dynid(command + option).exit_code, 2) << option;
  }
  EXPECT_EQ(dynid("excite " + small_arm() + " --effects . -o " + temporary_path("t.csv")).exit_code,
            2);
}

TEST(ExciteFor, TheFirstFindingWithSeveralNamesIsMeant) {
  ForJson several = findings("load_friction", 1, {{"mu", 0.05}}, {"load_friction"});
  several["findings"].push_back(stribeck_findings()["findings"][0]);
  const OpenFinding finding = read_open_finding(written("f.json", several));
  EXPECT_EQ(finding.number, 2);
  EXPECT_EQ(finding.family, "stribeck");
  EXPECT_EQ(finding.parameters.at("Fs"), 3.3);
  EXPECT_EQ(finding.noise_floor, (std::vector<double>{0.3, 0.2}));
}

/// Speeds whose sign at a sample of rest is that of what follows, or went before: friction that is
/// absent for one sample is none.
Eigen::MatrixXd without_rests(Eigen::MatrixXd speeds) {
  constexpr double kSlowest = 1e-9;  // rad/s
  for (auto speed : speeds.colwise()) {
    for (Eigen::Index at = 0; at < speed.size(); ++at) {
      if (speed[at] != 0) continue;
      Eigen::Index moves = at;
      while (moves < speed.size() && speed[moves] == 0) ++moves;
      const double next = moves < speed.size() ? speed[moves] : at > 0 ? speed[at - 1] : 0;
      if (next != 0) speed[at] = std::copysign(kSlowest, next);
    }
  }
  return speeds;
}

/// The torque of a plant on a motion, with noise.
std::string record(const std::string& name, Recording motion, const DescribedRobot& plant,
                   std::uint64_t seed) {
  constexpr double kNoise = 0.8;  // N m
  motion.run_starts = {0};
  motion.dq = without_rests(std::move(motion.dq));
  motion.tau =
      plant.linear.torque(motion.q, motion.dq, motion.ddq, plant.grouping * plant.standard);
  motion.tau = recorded_torque(plant, effect_instances(plant.model, EffectCatalogue()), motion);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, kNoise);
  for (double& value : motion.tau.reshaped()) value += noise(random);
  motion.dq.resize(0, 0);
  motion.ddq.resize(0, 0);
  write_recording(motion, temporary_path(name));
  return temporary_path(name);
}

TEST(ExciteFor, OneRecordingOfItSpeaksForTheTruth) {
  const std::string source = "tests/studies/robots/puma3.robot";
  const std::string limits = "qmin -2 -2 -2\nqmax 2 2 2\nvmax 2 2 2\namax 8 8 8\n";
  const std::string arm = robot(source, "puma.robot", limits);
  const DescribedRobot plant = describe_robot(
      robot(source, "plant.robot", limits + "effect stribeck joint=2 Fs=9.2 vs=0.1 delta=2\n"),
      OpenParameters::kAsWritten);
  constexpr std::uint64_t kOwnSeed = 3;
  const std::string first =
      record("first.csv",
             test::multisine(plant.linear, plant.grouping * plant.standard,
                             {.seconds = 20, .sample_time = 0.005, .period = 20, .seed = kOwnSeed}),
             plant, kOwnSeed);
  const auto finding = [&](const std::string& recordings) {
    const Outcome run =
        dynid("diagnose " + arm + " " + recordings + " --json " + temporary_path("d.json"));
    EXPECT_EQ(run.exit_code, 0) << run.out;
    const ForJson json = ForJson::parse(content(temporary_path("d.json")));
    EXPECT_EQ(json["findings"].size(), 1u) << run.out;
    return json["findings"].empty() ? ForJson::object() : json["findings"][0];
  };
  const ForJson before = finding(first);
  ASSERT_EQ(before["family"], "stribeck") << before;
  // the motion that would tell it from pre-sliding holds more of it
  ForJson asked = ForJson::parse(content(temporary_path("d.json")));
  asked["findings"][0]["aliases"] = {"stribeck", "presliding"};
  written("d.json", asked);
  const Outcome design = dynid("excite " + arm + " --for " + temporary_path("d.json") +
                               " --periods 2 --evaluations 250 -o " + temporary_path("next.csv"));
  ASSERT_EQ(design.exit_code, 0) << design.out;
  const Trajectory trajectory = read_trajectory(temporary_path("next.csv"));
  Recording motion;
  motion.time = trajectory.time;
  motion.q = trajectory.q;
  motion.dq = trajectory.dq;
  motion.ddq = trajectory.ddq;
  const std::string second = record("second.csv", motion, plant, kOwnSeed + 100);
  const ForJson after = finding(first + " " + second);
  EXPECT_EQ(after["aliases"], ForJson({"stribeck"})) << after;
  const double doubt = 1 - before["probability"].get<double>();
  EXPECT_LT(1 - after["probability"].get<double>(), 0.1 * doubt) << before << after;
  const double lambda = before["evidence"]["lambda"];
  EXPECT_GT(after["evidence"]["lambda"], 1.5 * lambda) << before << after;
}

}  // namespace
}  // namespace dyngen::runtime
