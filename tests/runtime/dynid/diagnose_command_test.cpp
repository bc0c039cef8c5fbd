// SPDX-License-Identifier: MIT
// dynid diagnose as its users call it, on recordings whose truth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/shared_data.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;

class Diagnose : public testing::Test {
 protected:
  static constexpr const char* kRobot = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";

  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("diagnose_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// The robot file with further rows, and with `friction` in place of its row Fs.
  std::string robot(const std::string& name, const std::string& rows,
                    const std::string& friction = {}) const {
    std::string text = content(kRobot);
    if (!friction.empty()) {
      const std::size_t row = text.find("\nFs ") + 1;
      text.replace(row, text.find('\n', row) - row, friction);
    }
    text.insert(text.rfind("stop"), rows);
    std::ofstream(path(name)) << text;
    return path(name);
  }

  /// A motion of all joints with the torque of a plant that has further rows, and noise.
  Recording motion(const std::string& rows, std::uint64_t seed, double seconds,
                   const std::string& friction = {}) const {
    const DescribedRobot plant =
        describe_robot(robot("plant.robot", rows, friction), OpenParameters::kAsWritten);
    Recording recording = test::multisine(
        plant.linear, plant.grouping * plant.standard,
        {.seconds = seconds, .sample_time = 0.005, .period = seconds, .size = 1.5, .seed = seed});
    recording.tau =
        recorded_torque(plant, effect_instances(plant.model, EffectCatalogue()), recording);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, 0.3);
    for (Index k = 0; k < recording.tau.size(); ++k) recording.tau.data()[k] += noise(random);
    recording.dq.resize(0, 0);
    recording.ddq.resize(0, 0);
    return recording;
  }
  std::string record(const std::string& name, const std::string& rows, std::uint64_t seed,
                     double seconds = 20) const {
    write_recording(motion(rows, seed, seconds), path(name));
    return path(name);
  }

  [[nodiscard]] Outcome diagnose(const std::string& arguments) const {
    return dynid("diagnose " + std::string(kRobot) + " " + arguments + " --json " + path("d.json") +
                 " --report " + path("d.html") + " -o " + path("d.robot"));
  }
  [[nodiscard]] Json json() const { return Json::parse(content(path("d.json"))); }

  fs::path folder_;
};

TEST_F(Diagnose, NamesFrictionThatTheModelLeavesOut) {
  const std::string rows = "effect load_friction joint=3 mu=0.12\n";
  const std::string train = record("a.csv", rows, 1), test = record("b.csv", rows, 2);
  const Outcome run = diagnose(train + " --holdout " + test);
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  EXPECT_EQ(json()["verdict"], "explained") << run.out;
  ASSERT_EQ(json()["findings"].size(), 1u) << run.out;
  const Json finding = json()["findings"][0];
  EXPECT_EQ(finding["family"], "load_friction") << run.out;
  EXPECT_EQ(finding["joint"], 3) << run.out;
  const Json heldout = json()["heldout"];
  EXPECT_LT(heldout["rms_after"][2].get<double>(), 0.95 * heldout["rms_before"][2].get<double>());
  EXPECT_EQ(test::page_fault(content(path("d.html"))), "");
  EXPECT_NE(run.out.find("of joint 3, probability"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("written: " + path("d.html")), std::string::npos) << run.out;
  // the file that it writes leaves less of the recordings, and compiles
  const auto left = [&](const std::string& file) {
    const Outcome check = dynid("check " + file + " " + test + " --json " + path("check.json"));
    EXPECT_EQ(check.exit_code, 0) << check.out;
    return Json::parse(content(path("check.json")))["recordings"][0]["rms"][2].get<double>();
  };
  EXPECT_LT(left(path("d.robot")), 0.8 * left(kRobot));
  // it is known then: taken off, and there is nothing left to find
  const Outcome again = dynid("diagnose " + path("d.robot") + " " + train + " --holdout " + test +
                              " --json " + path("again.json"));
  ASSERT_EQ(again.exit_code, 0) << again.out;
  EXPECT_EQ(Json::parse(content(path("again.json")))["verdict"], "clean") << again.out;
}

TEST_F(Diagnose, FindsNothingWhereNothingIs) {
  const Outcome run = diagnose(record("a.csv", "", 3));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(json()["verdict"], "clean") << run.out;
  EXPECT_EQ(json()["findings"].size(), 0u);
  EXPECT_GT(json()["certificate"].size(), 50u);
  EXPECT_GT(json()["undecidable"].size(), 0u);
  // friction of every form would be seen if it were large enough
  int friction = 0;
  const Json certificate = json()["certificate"];
  for (const Json& line : certificate) {
    for (const char* family :
         {"nonlinear_viscous", "quadratic_drag", "stribeck", "thermal_drift"}) {
      if (line["family"] != family) continue;
      ++friction;
      EXPECT_TRUE(line["smallest_detectable"].is_number()) << line;
    }
  }
  EXPECT_GT(friction, 24);
  // all parameters are those of a fit
  EXPECT_EQ(dynid("check " + path("d.robot") + " " + path("a.csv")).exit_code, 0);
}

TEST_F(Diagnose, SaysTheSameTwice) {
  const std::string train = record("a.csv", "effect stribeck joint=2 Fs=14 vs=0.1\n", 4, 12);
  ASSERT_EQ(diagnose(train).exit_code, 0);
  const std::string json = content(path("d.json")), page = content(path("d.html")),
                    file = content(path("d.robot"));
  ASSERT_EQ(diagnose(train).exit_code, 0);
  EXPECT_EQ(content(path("d.json")), json);
  EXPECT_EQ(content(path("d.html")), page);
  EXPECT_EQ(content(path("d.robot")), file);
}

TEST_F(Diagnose, ExplainsWhatAnotherSimulatorLeaves) {
  Recording recording = motion("", 5, 20);
  const std::string call = path("sim.csv") + " --residual-only";
  write_recording(recording, path("sim.csv"));
  const Outcome without = diagnose(call);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.out.find("there are no columns tausim1 .. tausim3"), std::string::npos)
      << without.out;
  // a simulator that knows all but a cable on joint 1
  recording.tau_sim = recording.tau;
  std::mt19937_64 random(8);
  std::normal_distribution<double> noise(0, 0.3);
  for (Index k = 0; k < recording.tau.size(); ++k) recording.tau_sim.data()[k] += noise(random);
  recording.tau_sim.col(0).array() -= 1.5 * recording.q.col(0).array().cube();
  write_recording(recording, path("sim.csv"));
  const Outcome run = diagnose(call);
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  ASSERT_GE(json()["findings"].size(), 1u) << run.out;
  EXPECT_EQ(json()["findings"][0]["joint"], 1) << run.out;
  // the file keeps its own parameters
  EXPECT_NE(content(path("d.robot")).find("\nFs       5.9  8.1  4.4\n"), std::string::npos);
}

TEST_F(Diagnose, FindsWhatChangedSinceTheReference) {
  const std::string now = "effect coulomb_asymmetry joint=2 dF=2\n";
  const std::string call = record("a.csv", now, 11) + " --holdout " + record("b.csv", now, 12);
  ASSERT_EQ(diagnose(call).exit_code, 0);
  EXPECT_EQ(json()["findings"].size(), 0u);  // no recording alone shows it
  const Outcome run =
      diagnose(call + " --reference " + record("c.csv", "", 13) + " " + record("d.csv", "", 14));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  ASSERT_EQ(json()["findings"].size(), 1u) << run.out;
  const Json finding = json()["findings"][0];
  const std::vector<std::string> aliases = finding["aliases"];
  EXPECT_NE(std::find(aliases.begin(), aliases.end(), "coulomb_asymmetry"), aliases.end());
  EXPECT_EQ(finding["joint"], 2);
  for (const char* key : {"variable", "from", "to", "share"}) {
    EXPECT_TRUE(finding["where"][key].is_null()) << key;
  }
  EXPECT_NE(run.out.find("1 change since the reference recordings"), std::string::npos) << run.out;
  // condition of all four
  const std::string page = content(path("d.html"));
  for (const char* name : {"a.csv", "b.csv", "c.csv", "d.csv"}) {
    EXPECT_NE(page.find(path(name)), std::string::npos) << name;
  }
  EXPECT_NE(page.find("a sample every 5 ms (200 Hz)"), std::string::npos);
}

/// Friction of a day: each session has its own.
TEST_F(Diagnose, NamesFrictionAndALoadThatChanged) {
  std::string before, after, loaded;
  for (int s = 0; s < 3; ++s) {
    const double day = 0.05 * (s - 1);
    const auto record_with = [&](const std::string& name, const std::string& rows, double second,
                                 std::uint64_t seed) {
      const std::string friction = "Fs " + std::to_string(5.9 * (1 + day)) + " " +
                                   std::to_string(second * (1 - day)) + " 4.4";
      write_recording(motion(rows, seed, 20, friction), path(name));
      return path(name) + " ";
    };
    const std::string number = std::to_string(s) + ".csv";
    before += record_with("before" + number, "", 8.1, 31 + static_cast<std::uint64_t>(s));
    after += record_with("after" + number, "", 5.4, 41 + static_cast<std::uint64_t>(s));
    loaded += record_with("loaded" + number,
                          "effect payload XX=0 XY=0 XZ=0 YY=0.09 YZ=0 ZZ=0.09 MX=0.3 MY=0 MZ=0 "
                          "M=1\n",
                          8.1, 51 + static_cast<std::uint64_t>(s));
  }
  const Outcome run = diagnose(after + "--reference " + before);
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  ASSERT_EQ(json()["findings"].size(), 1u) << run.out;
  const Json friction = json()["findings"][0];
  EXPECT_EQ(friction["family"], "friction_change");
  EXPECT_EQ(friction["joint"], 2);
  EXPECT_EQ(friction["since_reference"], true);
  EXPECT_FALSE(friction["parameters"].contains("Fv"));
  EXPECT_GT(friction["probability"].get<double>(), 0.9);
  EXPECT_NEAR(friction["parameters"]["Fc"]["value"].get<double>(), -2.7,
              4 * friction["parameters"]["Fc"]["std"].get<double>());
  // before is the reference: its friction fits the later torque worse
  const Json heldout = json()["heldout"];
  EXPECT_GT(heldout["rms_before"][1].get<double>(), 1.5 * heldout["rms_after"][1].get<double>());
  EXPECT_NE(run.out.find("sessions: 3 sessions of the reference, 3 after it"), std::string::npos)
      << run.out;
  EXPECT_EQ(test::page_fault(content(path("d.html"))), "");
  // the improved file has the later friction
  EXPECT_EQ(dynid("check " + path("d.robot") + " " + path("after1.csv")).exit_code, 0);

  const Outcome load = diagnose(loaded + "--reference " + before);
  ASSERT_EQ(load.exit_code, 0) << load.out;
  ASSERT_EQ(json()["findings"].size(), 1u) << load.out;
  const Json payload = json()["findings"][0];
  EXPECT_EQ(payload["family"], "payload");
  EXPECT_EQ(payload["joint"], 0);
  EXPECT_NEAR(payload["parameters"]["M"]["value"].get<double>(), 1,
              4 * payload["parameters"]["M"]["std"].get<double>());
  EXPECT_LT(payload["parameters"]["M"]["std"].get<double>(), 0.2);
}

/// Drives that cancel a part of their own friction: masses and rotors are the same. Sessions of the
/// reference differ by several times the noise in all parameters, so that no other change is told.
TEST_F(Diagnose, AccusesNoLoadRotorOrGainOfARealPendulum) {
  std::string reference;
  const auto compensated = test::shared_data("dfki_friction/compensated.csv.gz");
  for (const char* name : {"off_1", "off_2", "off_3"}) {
    const std::string file = std::string("dfki_friction/") + name + ".csv.gz";
    const auto own = test::shared_data(file);
    if (!own || !compensated) GTEST_SKIP() << test::skip_sentence(file);
    reference += " " + *own;
  }
  const Outcome run = dynid("diagnose " DYNGEN_SOURCE_DIR "/tests/blind/real/dfki_a.robot " +
                            *compensated + " --reference" + reference + " --json " +
                            path("d.json"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  EXPECT_NE(run.out.find("3 sessions of the reference, 1 after it"), std::string::npos) << run.out;
  const Json findings = json()["findings"];
  for (const Json& finding : findings) {
    const Json& family = finding["family"];
    if (family != "payload" && family != "rotor_inertia" && family != "torque_gain") continue;
    EXPECT_LT(finding["probability"].get<double>(), 0.5) << run.out;
  }
}

TEST_F(Diagnose, SaysWhatWasNotSearchedWhereItsEffortIsBounded) {
  const Outcome run = diagnose(record("a.csv", "", 10, 12) + " --effort 0.001");
  EXPECT_EQ(run.exit_code, 3) << run.out;
  EXPECT_NE(run.out.find("not searched:\n  further effects"),
            std::string::npos)
      << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  EXPECT_EQ(json()["verdict"], "insufficient_data");
  EXPECT_EQ(json()["effort"]["limit"], 0.001);
  EXPECT_EQ(json()["effort"]["not_searched"], Json::array({"further effects"}));
  EXPECT_NE(content(path("d.html")).find("Not searched"), std::string::npos);
  EXPECT_EQ(diagnose(path("a.csv") + " --effort -1").exit_code, 2);
}

TEST_F(Diagnose, SaysWhatIsWrong) {
  const std::string train = record("a.csv", "", 6, 3);
  const auto expect = [](const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.out;
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
  };
  expect(dynid("diagnose " + std::string(kRobot)), 2, "there is no recording");
  // all that follows --holdout is held out
  expect(diagnose("--holdout " + train + " " + train), 2, "there is no recording");
  expect(diagnose(train + " --false-alarm 0.7"), 2, "--false-alarm");
  expect(diagnose(path("missing.csv")), 1, "missing.csv");
  expect(dynid("diagnose " + std::string(DYNGEN_SOURCE_DIR "/robots/planar2r.robot ") + train), 1,
         "joints");
  expect(dynid("diagnose " + robot("e.robot", "effect stribeck joint=2 Fs=*\n") + " " + train), 1,
         "effect 'stribeck' has no numbers");
  expect(diagnose(train + " --effects " + path("nowhere")), 1, "nowhere");
  EXPECT_FALSE(fs::exists(path("d.json")));
}

TEST_F(Diagnose, RefusesToAnswerFromTooLittle) {
  const Outcome run = diagnose(record("a.csv", "", 7, 8) + " --holdout " +
                               record("b.csv", "", 8, 8) + " --decimate 30");
  EXPECT_EQ(run.exit_code, 3) << run.out;
  EXPECT_NE(run.out.find("too few"), std::string::npos) << run.out;
  EXPECT_EQ(json()["verdict"], "insufficient_data");
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  EXPECT_EQ(test::page_fault(content(path("d.html"))), "");
  EXPECT_FALSE(fs::exists(path("d.robot")));
}

TEST_F(Diagnose, RefusesToAnswerFromASecondOrTwo) {
  const std::string whole = record("whole.csv", "", 9, 20);
  std::istringstream lines(content(whole));
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(line);
  // too short for a joint state, for the parallel filter of the held-out fifth, for the parameters
  for (const std::size_t samples : {20U, 100U, 400U}) {
    std::ofstream file(path("part.csv"));
    file << rows[0] << "\n";
    for (std::size_t k = 0; k < samples; ++k) file << rows[1000 + k] << "\n";
    file.close();
    const Outcome run = diagnose(path("part.csv") + " --cutoff 8");
    EXPECT_EQ(run.exit_code, 3) << samples << ": " << run.out;
    EXPECT_EQ(json()["verdict"], "insufficient_data");
    EXPECT_EQ(json()["findings"].size(), 0u);
    EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
    EXPECT_EQ(test::page_fault(content(path("d.html"))), "");
    EXPECT_FALSE(fs::exists(path("d.robot")));
  }
}

}  // namespace
}  // namespace dyngen::runtime
