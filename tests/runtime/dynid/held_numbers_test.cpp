// SPDX-License-Identifier: MIT
// dynid fit --hold: numbers of the robot file that are kept.
#include "runtime/tools/dynid/robot/held_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "gen/diagnostic/diagnostic.h"
#include "gen/symbols/exact.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/recordings/gzip.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/model_bridge.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;
using Words = std::vector<std::string>;

constexpr const char* kHalfKnownArm =
    "number_link 2\nsigma 0 0\nal 0 pi/2\nd 0 0.3\nm 1 *\nmX 0.5 0.2\nmY 0 0\nIA 0.1 *\nFs * 2\n"
    "joints base elbow\ngz 9.81\nstop\n";

Words held(const Words& words) {
  return held_numbers(test::parse_model(kHalfKnownArm), words).names;
}

std::string refusal(const Words& words) {
  try {
    held(words);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

TEST(HeldNumbers, AreNamedByLinksJointsRowsAndThemselves) {
  EXPECT_EQ(held({}), Words{});
  EXPECT_EQ(held({"all"}), (Words{"mX1", "m1", "IA1", "mX2", "Fs2"}));
  EXPECT_EQ(held({"links=1"}), (Words{"mX1", "m1"}));
  EXPECT_EQ(held({"joints=elbow,1"}), (Words{"mX1", "m1", "IA1", "mX2", "Fs2"}));
  EXPECT_EQ(held({"joints=2"}), (Words{"mX2", "Fs2"}));
  EXPECT_EQ(held({"rows=MX,fs"}), (Words{"mX1", "mX2", "Fs2"}));
  EXPECT_EQ(held({"numbers=MX2,m1", "rows=IA"}), (Words{"m1", "IA1", "mX2"}));
}

TEST(HeldNumbers, AreNamedWithoutAKey) {
  EXPECT_EQ(held({"ALL"}), held({"all"}));
  EXPECT_EQ(held({"link1"}), (Words{"mX1", "m1"}));
  EXPECT_EQ(held({"link=1"}), (Words{"mX1", "m1"}));
  EXPECT_EQ(held({"link:1"}), (Words{"mX1", "m1"}));
  EXPECT_EQ(held({"link1,link2"}), (Words{"mX1", "m1", "mX2"}));
  EXPECT_EQ(held({"links=1-2"}), (Words{"mX1", "m1", "mX2"}));
  EXPECT_EQ(held({"links"}), (Words{"mX1", "m1", "mX2"}));
  EXPECT_EQ(held({"joint2"}), (Words{"mX2", "Fs2"}));
  EXPECT_EQ(held({"elbow"}), (Words{"mX2", "Fs2"}));
  EXPECT_EQ(held({"2"}), (Words{"mX2", "Fs2"}));
  EXPECT_EQ(held({"MX"}), (Words{"mX1", "mX2"}));
  EXPECT_EQ(held({"mx1,m1"}), (Words{"mX1", "m1"}));
  EXPECT_EQ(held({"links=1,rows=Fs"}), (Words{"mX1", "m1", "Fs2"}));
}

TEST(HeldNumbers, HaveStandardDeviations) {
  const RobotModel model = test::parse_model(kHalfKnownArm);
  EXPECT_EQ(held_numbers(model, {"all"}).deviations.size(), 0);
  const HeldNumbers held = held_numbers(model, {"links=1+-10%", "mX2+-0.02", "Fs2"});
  const auto deviation = [&](Chi kind, std::size_t link) {
    return held.deviations[static_cast<Eigen::Index>(index(kind) + kChiCount * (link - 1))];
  };
  EXPECT_DOUBLE_EQ(deviation(Chi::kM, 1), 0.1);
  EXPECT_DOUBLE_EQ(deviation(Chi::kMX, 1), 0.05);
  EXPECT_DOUBLE_EQ(deviation(Chi::kMX, 2), 0.02);
  EXPECT_EQ(deviation(Chi::kFS, 2), 0);
  EXPECT_NE(refusal({"MX1+-"}).find("expected a standard deviation behind +-"), std::string::npos);
}

TEST(HeldNumbers, SayWhatThereIs) {
  EXPECT_NE(refusal({"everything"}).find("there is no 'everything'"), std::string::npos);
  EXPECT_NE(refusal({"ZZR1"}).find("Base parameters are sums"), std::string::npos);
  EXPECT_NE(refusal({"links="}).find("expected all"), std::string::npos);
  EXPECT_NE(refusal({"colour=1"}).find("expected all"), std::string::npos);
  EXPECT_NE(refusal({""}).find("expected all"), std::string::npos);
  for (const char* word : {"links=3", "link3", "joint3", "MX3", "7"}) {
    EXPECT_NE(refusal({word}).find("expected 1 to 2, or one of base, elbow"), std::string::npos)
        << word << ": " << refusal({word});
  }
  EXPECT_NE(refusal({"rows=MX,Fc"}).find("there is no row 'Fc': expected one of XX XY"),
            std::string::npos);
  EXPECT_NE(refusal({"numbers=Fs1"})
                .find("no number there to hold: '*' and absent rows are estimated. It has mX1 m1"),
            std::string::npos);
  EXPECT_NE(refusal({"numbers=MX"}).find("there is no link or joint ''"), std::string::npos);
  // what is open beside what is known is no error
  const HeldNumbers some = held_numbers(test::parse_model(kHalfKnownArm), {"rows=IA,Fv"});
  EXPECT_EQ(some.names, Words{"IA1"});
  ASSERT_EQ(some.notes.size(), 1U);
  EXPECT_NE(some.notes[0].find("row Fv"), std::string::npos);
}

TEST(HeldNumbers, LeaveTheRestToItsOwnBaseParameters) {
  const std::string path = test::temporary_path("held.robot");
  std::ofstream(path) << "number_link 1\nal pi/2\nmX 1.2\nZZ 0.4\nIA *\nFs *\ngz 9.81\nstop\n";
  const DescribedRobot all = describe_robot(path, OpenParameters::kAsWritten);
  const DescribedRobot rest =
      describe_robot(path, OpenParameters::kAsWritten, {.hold = {"rows=ZZ"}});
  ASSERT_EQ(all.linear.size(), 3);  // ZZR1 MX1 FS1
  ASSERT_EQ(rest.linear.size(), 3);
  EXPECT_EQ(rest.linear.parameters[0].formula, "IA1; beside held ZZ1");
  const Recording motion =
      test::multisine(all.linear, Eigen::Vector3d(0.4 + 0.3, 1.2, 2), {.seconds = 1});
  const Eigen::MatrixXd sum =
      rest.linear.torque(motion.q, motion.dq, motion.ddq, Eigen::Vector3d(0.3, 1.2, 2));
  EXPECT_LT((sum - motion.tau).cwiseAbs().maxCoeff(), 1e-12 * motion.tau.cwiseAbs().maxCoeff());
}

TEST(HeldNumbers, AreSeenByEffectsAsPartsOfTheModel) {
  const std::string path = test::temporary_path("load.robot");
  std::ofstream(path) << "number_link 2\nsigma 0 0\nal pi/2 0\nd 0 0.5\nm 3 2\nmX 0.6 0.4\n"
                         "ZZ 0.4 0.2\nIA 0.3 0.1\nFs 2 1\nFv 1 0.5\ngz 9.81\nstop\n";
  const DescribedRobot all = describe_robot(path, OpenParameters::kAsWritten);
  Recording recording = test::multisine(all.linear, all.grouping * all.standard, {.seconds = 2});
  const std::string file = test::temporary_path("load.csv");
  write_recording(recording, file);
  const MotionSource source = motion_of_file(file, {});
  // what effects read of a model is the same, whichever numbers are in beta
  EffectInstance effect;
  effect.joint = 0;
  effect.other = 1;
  effect.law.name = "reads";
  effect.law.variables = {"tau_load", "tau_load_other", "torque", "torque_rate", "Fc", "Fv"};
  effect.law.scope = EffectScope::kPair;
  std::vector<Eigen::MatrixXd> seen;
  for (const Words& words :
       {Words{}, Words{"links=1"}, Words{"joints=2"}, Words{"rows=IA,Fs"}, Words{"all"}}) {
    const DescribedRobot robot = describe_robot(path, OpenParameters::kAsWritten, {.hold = words});
    const EffectRecordings data =
        effect_recordings(robot.linear, effect_robot(robot), {source}, {});
    EffectSignals signals(data);
    signals.set_beta(robot.grouping * robot.standard);
    seen.push_back(signals.variables(0, effect, 0));
    EXPECT_LT((seen.back() - seen.front()).cwiseAbs().maxCoeff(), 1e-9)
        << (words.empty() ? "" : words.front());
  }
  EXPECT_GT(seen.front().cwiseAbs().maxCoeff(), 1);
}

class Hold : public testing::Test {
 protected:
  void SetUp() override {
    if (!gzip_available()) GTEST_SKIP() << "built without zlib";
  }
  static std::string case_file(const std::string& name) {
    return std::string(DYNGEN_SOURCE_DIR "/tests/data/cases/") + name;
  }
  Outcome fit(const std::string& arguments) const {
    return dynid("fit " + arguments + " -o " + id_ + " --json " + json_);
  }
  [[nodiscard]] Json json() const { return Json::parse(content(json_)); }
  [[nodiscard]] double value(const std::string& name) const {
    const Json answer = json();
    for (const Json& parameter : answer["parameters"]) {
      if (parameter["name"] == name) return parameter["value"];
    }
    return NAN;
  }
  /// Of the first effect, by name.
  [[nodiscard]] std::map<std::string, double> effect_numbers() const {
    const Json answer = json();
    std::map<std::string, double> found;
    for (const Json& parameter : answer["effects"]["list"][0]["parameters"]) {
      found[parameter["name"]] = parameter["value"];
    }
    return found;
  }
  const std::string id_ = test::temporary_path("id.robot");
  const std::string json_ = test::temporary_path("fit.json");
};

TEST_F(Hold, KeepsANumberThatTheFileKnows) {
  const std::string files =
      case_file("known_number/pk.robot") + " " + case_file("known_number/pend.csv.gz");
  const Outcome free = fit(files);
  EXPECT_LT(value("MX1"), 0.7) << free.out;  // 0.601: numbers are where a fit begins
  const Outcome run = fit(files + " --hold numbers=MX1");
  EXPECT_EQ(test::parse_model(content(id_)).joint(1).chi[index(Chi::kMX)].value,
            GiNaC::numeric(6, 5))
      << run.out;
  EXPECT_TRUE(std::isnan(value("MX1")));
  EXPECT_NE(run.out.find("held: mX1"), std::string::npos) << run.out;
  // all that the file knows
  const Outcome all = fit(files + " --hold all");
  EXPECT_NE(all.out.find("beside held ZZ1"), std::string::npos) << all.out;
  EXPECT_NE(
      all.out.find("ZZR1 is IA1 and came out below 0: what is held beside it is too large (ZZ1)"),
      std::string::npos)
      << all.out;
  const RobotModel model = test::parse_model(content(id_));
  EXPECT_EQ(model.joint(1).chi[index(Chi::kZZ)].value, GiNaC::numeric(23, 50));
}

TEST_F(Hold, TheResidualIsThatOfTheFile) {
  const std::string recording = case_file("known_number/pend.csv.gz");
  ASSERT_NE(fit(case_file("known_number/pk.robot") + " " + recording + " --hold links=1").exit_code,
            1);
  const std::string check = test::temporary_path("check.json");
  ASSERT_EQ(dynid("check " + id_ + " " + recording + " --json " + check).exit_code, 0);
  const double fitted = json()["residual"][0]["rms"];
  const double left = Json::parse(content(check))["recordings"][0]["rms"][0];
  EXPECT_NEAR(left, fitted, 1e-9 * fitted);
}

TEST_F(Hold, FindsThePayloadOfAKnownArm) {
  const std::string files = case_file("payload_on_known_arm/pay.robot") + " " +
                            case_file("payload_on_known_arm/pay.csv.gz");
  const Outcome run = fit(files + " --hold links=1,2,3");
  std::map<std::string, double> found = effect_numbers();
  EXPECT_NEAR(found["M"], 1.5, 0.02) << run.out;
  EXPECT_NEAR(found["MX"], 0.075, 0.01) << run.out;
  EXPECT_NEAR(found["MY"], -0.45, 0.01) << run.out;
  EXPECT_NEAR(found["MZ"], 0.03, 0.02) << run.out;  // +- 0.006
  // the last link itself, where the file leaves it open
  std::string text = content(case_file("payload_on_known_arm/pay.robot"));
  for (const char* row : {"m ", "mX ", "mY ", "mZ ", "XX ", "XY ", "XZ ", "YY ", "YZ ", "ZZ "}) {
    const std::size_t begin = text.find("\n" + std::string(row)) + 1;
    const std::size_t end = text.find('\n', begin);
    const std::size_t last = text.rfind(' ', end);
    text.replace(last, end - last, " *");
  }
  text.erase(text.find("effect payload"), std::string("effect payload\n").size());
  const std::string open = test::temporary_path("open.robot");
  std::ofstream(open) << text;
  const std::string recording = case_file("payload_on_known_arm/pay.csv.gz");
  const Outcome offered = fit(open + " " + recording);
  EXPECT_NE(offered.out.find("links 1, 2 have numbers, and link 3 is unknown"), std::string::npos)
      << offered.out;
  const Outcome last = fit(open + " " + recording + " --hold links=1,2");
  EXPECT_NEAR(value("MX3"), 0.05 + 0.075, 0.01) << last.out;
  EXPECT_NEAR(value("MY3"), -0.3 - 0.45, 0.01) << last.out;
}

TEST_F(Hold, FindsThePayloadWhereNothingElseIsLeft) {
  const std::string robot = case_file("payload_on_known_arm/pay.robot");
  const std::string recording = case_file("payload_on_known_arm/pay.csv.gz");
  const std::string page = test::temporary_path("all.html");
  const Outcome run = fit(robot + " " + recording + " --hold all --report " + page);
  ASSERT_NE(run.exit_code, 1) << run.out;
  std::map<std::string, double> found = effect_numbers();
  EXPECT_EQ(json()["parameters"].size(), 0U);
  EXPECT_NEAR(found["M"], 1.5, 0.01) << run.out;
  EXPECT_NEAR(found["MX"], 0.075, 0.005) << run.out;
  EXPECT_NEAR(found["MY"], -0.45, 0.005) << run.out;
  EXPECT_NEAR(found["MZ"], 0.03, 0.02) << run.out;
  EXPECT_EQ(test::page_fault(content(page)), "");
  const RobotModel before = test::parse_model(content(robot));
  const RobotModel after = test::parse_model(content(id_));
  for (int link = 1; link <= before.size(); ++link) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      EXPECT_EQ(to_double(after.joint(link).chi[k].value),
                to_double(before.joint(link).chi[k].value))
          << chi_name(static_cast<Chi>(k), link);
    }
  }
  const std::string check = test::temporary_path("all_check.json");
  ASSERT_EQ(dynid("check " + id_ + " " + recording + " --json " + check).exit_code, 0);
  const Json left = Json::parse(content(check))["recordings"][0]["rms"];
  for (std::size_t j = 0; j < left.size(); ++j) {
    const double fitted = json()["residual"][j]["rms"];
    EXPECT_NEAR(left[j].get<double>(), fitted, 1e-6 * fitted) << j;
  }
  // without an effect nothing is left at all
  std::string text = content(robot);
  text.erase(text.find("effect payload"), std::string("effect payload\n").size());
  const std::string plain = test::temporary_path("plain.robot");
  std::ofstream(plain) << text;
  const Outcome none = fit(plain + " " + recording + " --hold all");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.out.find("Hold fewer numbers"), std::string::npos) << none.out;
}

TEST_F(Hold, GoesWithEffectsThatReadTheLoad) {
  const std::string path = test::temporary_path("geared.robot");
  const std::string bodies =
      "number_link 2\nsigma 0 0\nal pi/2 0\nd 0 0.5\nm 3 2\nmX 0.6 0.4\nZZ 0.4 0.2\n"
      "IA 0.3 0.1\nFs * *\nFv * *\ngz 9.81\neffect load_friction joint=1\nstop\n";
  std::ofstream(path) << bodies;
  const DescribedRobot robot = describe_robot(path, OpenParameters::kAsWritten);
  Recording recording = test::multisine(robot.linear, test::plausible_beta(robot.linear, 3),
                                        {.seconds = 10, .torque_noise = 0.05});
  StandardParameters truth = robot.standard;
  for (Eigen::Index i = 0; i < truth.size(); ++i) {
    if (std::isnan(truth[i])) truth[i] = 1.5;
  }
  const auto torque = [&](const StandardParameters& standard) {
    return robot.linear.torque(recording.q, recording.dq, recording.ddq, robot.grouping * standard);
  };
  StandardParameters load = truth;
  for (Eigen::Index i = 0; i < load.size(); ++i) {
    if (i % static_cast<Eigen::Index>(kChiCount) >= static_cast<Eigen::Index>(kInertialCount)) {
      load[i] = 0;
    }
  }
  constexpr double kFriction = 0.08;
  recording.tau = torque(truth);
  recording.tau.col(0).array() +=
      kFriction * torque(load).col(0).array().abs() * recording.dq.col(0).array().sign();
  const std::string file = test::temporary_path("geared.csv");
  write_recording(recording, file);
  const Outcome run = fit(path + " " + file + " --hold links=1,2 --hold IA");
  ASSERT_NE(run.exit_code, 1) << run.out;
  EXPECT_NEAR(effect_numbers()["mu"], kFriction, 0.01) << run.out;
  EXPECT_NEAR(value("FS1"), 1.5, 0.1) << run.out;
}

TEST_F(Hold, StatedDeviationsOfNumbersComeToThoseOfTheRest) {
  const std::string path = test::temporary_path("pair.robot");
  std::ofstream(path) << "number_link 1\nal pi/2\nmX 1.2\nmY 0\nZZ 0.4\nIA *\nFs *\nFv *\n"
                         "off *\ngz 9.81\nstop\n";
  const DescribedRobot robot = describe_robot(path, OpenParameters::kAsWritten);
  const Recording recording = test::multisine(robot.linear, test::plausible_beta(robot.linear, 2),
                                              {.seconds = 8, .torque_noise = 0.1});
  const std::string file = test::temporary_path("pair.csv");
  write_recording(recording, file);
  const auto deviation = [&](const std::string& hold) {
    const Outcome run = fit(path + " " + file + " --hold " + hold);
    EXPECT_NE(run.exit_code, 1) << run.out;
    const Json answer = json();
    for (const Json& parameter : answer["parameters"]) {
      const std::string formula = parameter["formula"];
      if (formula.find("beside held ZZ1") == std::string::npos) continue;
      return parameter["std"].get<double>();
    }
    return double{NAN};
  };
  // ZZ1 moves the joint as IA1 does: its error is all the row's
  const double exact = deviation("ZZ1"), stated = deviation("ZZ1+-0.05");
  EXPECT_GT(exact, 0);
  EXPECT_NEAR(stated, std::hypot(exact, 0.05), 1e-6 * stated);
  EXPECT_EQ(json()["held"][0]["std"], 0.05);
  EXPECT_EQ(json()["held"][0]["value"], 0.4);
}

TEST_F(Hold, IsOfDiagnosesToo) {
  const std::string path = test::temporary_path("pair2.robot");
  std::ofstream(path) << "number_link 2\nsigma 0 0\nal pi/2 0\nd 0 0.5\nm 3 *\nmX 0.6 *\n"
                         "mY 0.1 *\nZZ 0.4 *\nXX 0 0\nXY 0 0\nXZ 0 0\nYY 0 0\nYZ 0 0\nmZ 0 0\n"
                         "IA 0.3 0.1\nFs * *\nFv * *\noff 0 0\ngz 9.81\nstop\n";
  const DescribedRobot robot = describe_robot(path, OpenParameters::kAsWritten);
  StandardParameters truth = robot.standard;
  for (Eigen::Index i = 0; i < truth.size(); ++i) {
    if (std::isnan(truth[i])) truth[i] = 0.7;
  }
  const Recording recording =
      test::multisine(robot.linear, robot.grouping * truth,
                      {.seconds = 20, .sample_time = 0.01, .torque_noise = 0.1});
  const std::string file = test::temporary_path("pair2.csv");
  write_recording(recording, file);
  const Outcome run = dynid("diagnose " + path + " " + file + " --hold links=1 --hold IA -o " +
                            id_ + " --json " + json_);
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.out.find("held: ZZ1 mX1 mY1 m1 IA1 IA2"), std::string::npos) << run.out;
  EXPECT_EQ(json()["verdict"], "clean") << run.out;
  const Json answer = json();
  for (const Json& rms : answer["heldout"]["rms_after"]) EXPECT_NEAR(rms, 0.1, 0.02);
  const RobotModel before = test::parse_model(content(path));
  const RobotModel after = test::parse_model(content(id_));
  for (const Chi kind : {Chi::kM, Chi::kMX, Chi::kMY, Chi::kZZ, Chi::kIA}) {
    EXPECT_EQ(after.joint(1).chi[index(kind)].value, before.joint(1).chi[index(kind)].value)
        << chi_name(kind, 1);
  }
  EXPECT_EQ(after.joint(2).chi[index(Chi::kIA)].value, GiNaC::numeric(1, 10));
  const Outcome refused = dynid("diagnose " + path + " " + file + " --hold m1+-0.1");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.out.find("dynid fit"), std::string::npos) << refused.out;
}

TEST_F(Hold, IsOfferedWhereTheFileLooksLikeIt) {
  const Outcome run = fit(case_file("payload_on_known_arm/pay.robot") + " " +
                          case_file("payload_on_known_arm/pay.csv.gz"));
  EXPECT_NE(run.out.find("links 1, 2, 3 have numbers, and the payload is unknown"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("--hold links=1,2,3"), std::string::npos) << run.out;
}

TEST_F(Hold, RefusesWhatItCannotGoWith) {
  const std::string files =
      case_file("known_number/pk.robot") + " " + case_file("known_number/pend.csv.gz");
  EXPECT_EQ(fit(files + " --hold links=2").exit_code, 1);
  const Outcome run = fit(files + " --hold all --consistent");
  EXPECT_EQ(run.exit_code, 1) << run.out;
}

}  // namespace
}  // namespace dyngen::runtime
