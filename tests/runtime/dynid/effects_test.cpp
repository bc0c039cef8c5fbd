// SPDX-License-Identifier: MIT
// dynid fit and dynid atlas with effects, as their users call them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/recordings/trajectory_file.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;

class Effects : public testing::Test {
 protected:
  static constexpr const char* kRobot = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";
  static constexpr double kFs = 13, kVs = 0.15, kMu = 0.06;  // of joints 2 and 3

  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("effects_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    robot_ = describe_robot(kRobot, OpenParameters::kAbsentRows);
    for (const LinearParameter& parameter : robot_.linear.parameters) {
      beta_.conservativeResize(beta_.size() + 1);
      beta_[beta_.size() - 1] = parameter.value.value_or(0);
    }
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// A motion and the robot's torque, with velocities and accelerations.
  Recording without_effects(std::uint64_t seed) const {
    test::MultisineOptions options{
        .seconds = 20, .period = 20, .torque_noise = 0.2, .size = 1.5, .seed = seed};
    return test::multisine(robot_.linear, beta_, options);
  }

  /// Writes positions and torque.
  std::string written(Recording recording, const std::string& name) const {
    recording.dq.resize(0, 0);
    recording.ddq.resize(0, 0);
    write_recording(recording, path(name));
    return path(name);
  }

  /// The torque of the robot and of two effects, written down here apart from their files.
  std::string record(const std::string& name, std::uint64_t seed) {
    Recording recording = without_effects(seed);
    Eigen::VectorXd load_beta = beta_;
    for (Index c = 0; c < beta_.size(); ++c) {
      const auto kind = robot_.linear.parameters[static_cast<std::size_t>(c)].kind;
      if (kind != ParameterKind::kInertial) load_beta[c] = 0;
    }
    const Eigen::MatrixXd load =
        robot_.linear.torque(recording.q, recording.dq, recording.ddq, load_beta);
    for (Index k = 0; k < recording.samples(); ++k) {
      const double v = recording.dq(k, 1), x = v / kVs;
      recording.tau(k, 1) += (kFs - coulomb(2)) * std::exp(-x * x) * (v > 0 ? 1 : -1);
      recording.tau(k, 2) += kMu * std::abs(load(k, 2)) * (recording.dq(k, 2) > 0 ? 1 : -1);
    }
    return written(std::move(recording), name);
  }

  [[nodiscard]] double coulomb(int link) const {
    for (std::size_t c = 0; c < robot_.linear.parameters.size(); ++c) {
      const LinearParameter& parameter = robot_.linear.parameters[c];
      if (parameter.kind == ParameterKind::kCoulomb && parameter.link == link) {
        return beta_[static_cast<Index>(c)];
      }
    }
    return 0;
  }

  /// The robot file with further rows.
  std::string robot(const std::string& name, const std::string& rows) {
    std::string text = content(kRobot);
    text.resize(text.rfind("stop"));
    std::ofstream(path(name)) << text << rows << "stop\n";
    return path(name);
  }

  fs::path folder_;
  DescribedRobot robot_;
  Eigen::VectorXd beta_;
};

TEST_F(Effects, OfARobotFileAreFittedTogetherWithItsParameters) {
  const std::string file =
      robot("e.robot", "effect stribeck joint=2 Fs=* vs=*\neffect load_friction joint=3 mu=*\n");
  const Outcome fit =
      dynid("fit " + file + " " + record("a.csv", 1) + " --period off --holdout " +
            record("b.csv", 2) + " -o " + path("id.robot") + " --json " + path("fit.json"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  const Json json = Json::parse(content(path("fit.json")));
  const Json& effects = json["effects"]["list"];
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0]["name"], "stribeck");
  EXPECT_EQ(effects[0]["joint"], 2);
  EXPECT_EQ(effects[0]["parameters"][0]["unit"], "N m");
  // the position's filter rounds what happens beside standstill
  EXPECT_NEAR(effects[0]["parameters"][0]["value"].get<double>(), kFs, 0.05 * kFs);
  EXPECT_NEAR(effects[0]["parameters"][1]["value"].get<double>(), kVs, 0.1 * kVs);
  EXPECT_TRUE(effects[0]["parameters"][2]["held"].get<bool>());
  EXPECT_NEAR(effects[1]["parameters"][0]["value"].get<double>(), kMu, 0.1 * kMu);
  const Json& heldout = json["effects"]["heldout_rms"];
  const Json& without = json["effects"]["heldout_rms_without"];
  EXPECT_LT(heldout[1].get<double>(), 0.5 * without[1].get<double>());
  EXPECT_NEAR(json["residual"][1]["heldout_rms"].get<double>(), heldout[1].get<double>(), 1e-9);
  // the identified file carries the rows, and is read again
  const std::string identified = content(path("id.robot"));
  EXPECT_NE(identified.find("\neffect stribeck joint=2 Fs="), std::string::npos);
  EXPECT_NE(identified.find("\neffect load_friction joint=3 mu=0.0"), std::string::npos);
  EXPECT_EQ(identified.find("Fs=*"), std::string::npos);
  const Outcome check = dynid("check " + path("id.robot") + " " + path("b.csv") +
                              " --period off --json " + path("check.json"));
  ASSERT_EQ(check.exit_code, 0) << check.out;
  EXPECT_NEAR(Json::parse(content(path("check.json")))["recordings"][0]["rms"][1].get<double>(),
              heldout[1].get<double>(), 1e-6);
  const Outcome open = dynid("check " + file + " " + path("b.csv"));
  EXPECT_EQ(open.exit_code, 1);
  const Outcome again = dynid("fit " + path("id.robot") + " " + path("a.csv") +
                              " --period off --json " + path("again.json"));
  EXPECT_EQ(again.exit_code, 0) << again.out;
  const Json second = Json::parse(content(path("again.json")));
  EXPECT_NEAR(second["effects"]["list"][0]["parameters"][1]["value"].get<double>(),
              effects[0]["parameters"][1]["value"].get<double>(), 1e-4);
}

// Friction that falls over the whole range of speeds, to nothing: hardly a Stribeck effect.
TEST_F(Effects, OfStaticFrictionUsuallyHaveCoulombFrictionToRiseAbove) {
  Recording recording = without_effects(4);
  for (Index k = 0; k < recording.samples(); ++k) {
    const double v = recording.dq(k, 1), x = v / 2;
    recording.tau(k, 1) += (10 * std::exp(-x * x) - coulomb(2)) * (v > 0 ? 1 : -1);
  }
  const Outcome fit =
      dynid("fit " + robot("e.robot", "effect stribeck joint=2\n") + " " +
            written(std::move(recording), "a.csv") + " --period off --json " + path("fit.json"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  EXPECT_NE(fit.out.find("unusual, a larger ratio is curved viscous friction"), std::string::npos)
      << fit.out;
  const Json json = Json::parse(content(path("fit.json")));
  const double Fs = json["effects"]["list"][0]["parameters"][0]["value"].get<double>();
  double Fc = 0;
  for (const Json& parameter : json["parameters"]) {
    if (parameter["name"] == "FS2") Fc = parameter["value"].get<double>();
  }
  EXPECT_GE(Fc, 0);
  EXPECT_GT(Fs, 5 * Fc);
  bool said = false;
  for (const Json& remark : json["effects"]["list"][0]["remarks"]) {
    said = said || remark["kind"] == "unusual";
  }
  EXPECT_TRUE(said);
}

#ifdef DYNGEN_WITH_CERES
TEST_F(Effects, LeaveTheRestToBodiesThatCanExist) {
  const std::string file =
      robot("e.robot", "effect stribeck joint=2\neffect load_friction joint=3\n");
  const std::string call = "fit " + file + " " + record("a.csv", 1) + " --period off";
  const Outcome free = dynid(call + " --json " + path("free.json"));
  const Outcome fit =
      dynid(call + " --consistent -o " + path("id.robot") + " --json " + path("fit.json"));
  ASSERT_EQ(free.exit_code, 0) << free.out;
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  const Json json = Json::parse(content(path("fit.json")));
  const Json freely = Json::parse(content(path("free.json")));
  // effects are those of the free fit; the bodies explain what is left nearly as well
  EXPECT_EQ(json["effects"]["list"], freely["effects"]["list"]);
  ASSERT_FALSE(json["consistent"].is_null());
  const DescribedRobot identified = describe_robot(path("id.robot"), OpenParameters::kAsWritten);
  EXPECT_EQ(identified.model.effects.size(), 2u);
}
#endif

TEST_F(Effects, ThatCannotBeSeenEndInCode3) {
  const std::string file = robot("e.robot", "effect coulomb_asymmetry joint=1\n");
  const Outcome fit = dynid("fit " + file + " " + record("a.csv", 1) + " --period off");
  EXPECT_EQ(fit.exit_code, 3) << fit.out;
  EXPECT_NE(fit.out.find("cannot tell dF of coulomb_asymmetry of joint 1 from OFF1"),
            std::string::npos)
      << fit.out;
}

TEST_F(Effects, AreRefusedWhereSamplesOrConstraintsAreNotKnown) {
  const std::string file = robot("e.robot", "effect stribeck joint=2\n");
  const std::string recording = record("a.csv", 1);
  for (const char* method : {"ridge", "irls", "kalman", "all"}) {
    const Outcome fit = dynid("fit " + file + " " + recording + " --method " + method);
    EXPECT_EQ(fit.exit_code, 1) << method;
    EXPECT_NE(fit.out.find("expected one of --method wls and --method ls"), std::string::npos)
        << fit.out;
  }
  ASSERT_EQ(dynid("accumulate " + std::string(kRobot) + " " + recording + " -o " + path("a.qr"))
                .exit_code,
            0);
  const Outcome summary = dynid("fit " + file + " " + path("a.qr"));
  EXPECT_EQ(summary.exit_code, 1);
  EXPECT_NE(summary.out.find("effects are fitted to samples"), std::string::npos) << summary.out;
  std::ofstream(path("list.txt")) << recording << "\n";
  EXPECT_EQ(dynid("fit " + file + " --list " + path("list.txt")).exit_code, 1);
}

TEST_F(Effects, OfAUsersFolderAreFitted) {
  fs::create_directories(folder_ / "mine");
  std::ofstream(path("mine/my_spring.effect"))
      << "effect my_spring\nfamily gravity_spring\ntitle A spring of mine\nkind algebraic\n"
         "scope joint\nparameter k linear unit=torque/position^3 start=0 typical=5 : stiffness\n"
         "torque k*q^3\nalias cable : the same curve\nhidden Little.\nseparate Slow motion.\n"
         "plot q\n";
  const std::string file = robot("e.robot", "effect my_spring joint=1\n");
  const std::string recording = record("a.csv", 1);
  const Outcome fit =
      dynid("fit " + file + " " + recording + " --period off --effects " + path("mine"));
  EXPECT_EQ(fit.exit_code, 0) << fit.out;
  EXPECT_NE(fit.out.find("my_spring of joint 1"), std::string::npos);
  EXPECT_EQ(dynid("fit " + file + " " + recording).exit_code, 1);
}

TEST_F(Effects, AreListedInAnAtlasOfRecordings) {
  const Outcome atlas = dynid("atlas " + std::string(kRobot) + " " + record("a.csv", 1) +
                              " --json " + path("atlas.json"));
  ASSERT_EQ(atlas.exit_code, 0) << atlas.out;
  const Json json = Json::parse(content(path("atlas.json")));
  EXPECT_EQ(json["schema"], "dynid.atlas/1");
  int theorems = 0, partly = 0;
  for (const Json& effect : json["effects"]) {
    if (effect.contains("missing")) continue;
    if (effect["kind"] == "partly") {
      ++partly;
      EXPECT_GT(effect["smallest_detectable"].get<double>(), 0) << effect["effect"];
      EXPECT_GE(effect["absorbed"].get<double>(), 0);
      EXPECT_LE(effect["enr_left"].get<double>(), effect["enr_before"].get<double>() + 1e-12);
    }
    if (effect["effect"] == "coulomb_asymmetry" || effect["effect"] == "constant_offset" ||
        effect["effect"] == "payload" || effect["effect"] == "global_torque_gain") {
      EXPECT_EQ(effect["kind"], "on_any_data") << effect["effect"];
      ++theorems;
    }
  }
  EXPECT_EQ(theorems, 3 + 3 + 2);
  EXPECT_GT(partly, 100);
  EXPECT_NE(atlas.out.find("smallest detectable"), std::string::npos);
}

TEST_F(Effects, AreListedInAnAtlasOfATrajectory) {
  const Recording motion =
      test::multisine(robot_.linear, beta_, {.seconds = 10, .sample_time = 0.01});
  write_trajectory({motion.time, motion.q, motion.dq, motion.ddq}, path("t.csv"));
  const std::string call = "atlas " + std::string(kRobot) + " --trajectory " + path("t.csv");
  const Outcome atlas = dynid(call);
  ASSERT_EQ(atlas.exit_code, 0) << atlas.out;
  EXPECT_NE(atlas.out.find("1 % of the largest torque"), std::string::npos);
  const Outcome louder = dynid(call + " --noise 5,5,5 --json " + path("loud.json"));
  ASSERT_EQ(louder.exit_code, 0) << louder.out;
  const Outcome loudest = dynid(call + " --noise 10,10,10 --json " + path("louder.json"));
  ASSERT_EQ(loudest.exit_code, 0);
  const Json one = Json::parse(content(path("loud.json"))),
             two = Json::parse(content(path("louder.json")));
  // twice the noise: twice the smallest size
  int compared = 0;
  for (std::size_t i = 0; i < one["effects"].size(); ++i) {
    const Json &a = one["effects"][i], &b = two["effects"][i];
    if (a.contains("missing") || a["kind"] != "partly") continue;
    EXPECT_NEAR(b["smallest_detectable"].get<double>(), 2 * a["smallest_detectable"].get<double>(),
                1e-6 * b["smallest_detectable"].get<double>())
        << a["effect"];
    ++compared;
  }
  EXPECT_GT(compared, 100);
  EXPECT_EQ(dynid(call + " --noise 5,5").exit_code, 1);
  EXPECT_EQ(dynid("atlas " + std::string(kRobot)).exit_code, 2);
}

TEST_F(Effects, AnAtlasOfATrajectoryNeedsNumbers) {
  std::string text = content(kRobot);
  const std::size_t row = text.find("\nFv ");
  text.replace(row, text.find('\n', row + 1) - row, "\nFv * * *");
  std::ofstream(path("open.robot")) << text;
  const Recording motion =
      test::multisine(robot_.linear, beta_, {.seconds = 5, .sample_time = 0.01});
  write_trajectory({motion.time, motion.q, motion.dq, motion.ddq}, path("t.csv"));
  const Outcome atlas = dynid("atlas " + path("open.robot") + " --trajectory " + path("t.csv"));
  EXPECT_EQ(atlas.exit_code, 1);
  EXPECT_NE(atlas.out.find("parameters are unknown ('*'): FV1 FV2 FV3"), std::string::npos)
      << atlas.out;
}

}  // namespace
}  // namespace dyngen::runtime
