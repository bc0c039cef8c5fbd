// SPDX-License-Identifier: MIT
// What dynid says of its command line and its input files before it does its work.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;

using test::content;
using test::dynid;
using test::Outcome;

const std::string kCases = DYNGEN_SOURCE_DIR "/tests/data/cases/";

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++count;
  return count;
}

class Input : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("input_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  /// A recording of a planar arm, and its robot file.
  std::string robot() const {
    return write("arm.robot",
                 "number_link 2\nd 0 0.5\ngy 9.81\nqmin -3 -3\nqmax 3 3\nvmax 2 2\n"
                 "amax 9 9\nstop\n");
  }
  std::string record(const std::string& name) const {
    const DescribedRobot arm = describe_robot(robot(), OpenParameters::kAbsentRows);
    Recording recording =
        test::multisine(arm.linear, test::plausible_beta(arm.linear, 1), {.torque_noise = 0.1});
    write_recording(recording, path(name));
    return path(name);
  }

  fs::path folder_;
};

/// Every command that reads a robot file, each with inputs that are not there.
std::vector<std::string> calls(const std::string& robot, const std::string& out) {
  return {"fit " + robot + " none.csv",
          "check " + robot + " none.csv",
          "accumulate " + robot + " none.csv -o " + out,
          "atlas " + robot + " none.csv",
          "diagnose " + robot + " none.csv",
          "simulate " + robot + " --trajectory none.csv -o " + out,
          "excite " + robot + " --evaluations 1 -o " + out};
}

TEST_F(Input, ARecordingInTheRobotsPlaceIsNamed) {
  const std::string robot = kCases + "gap/arm2.robot", run = kCases + "gap/run.csv.gz";
  const std::string turned = run + " " + robot, written = " -o " + path("out");
  for (const std::string& call :
       {"fit " + turned + written, "check " + turned, "diagnose " + turned + written,
        "accumulate " + turned + written, "atlas " + turned, "excite " + turned + written,
        "excite " + run + " --prior " + robot + written, "simulate " + turned + written,
        "simulate " + run + " --trajectory " + robot + written,
        "import --guess --robot " + turned}) {
    const Outcome outcome = dynid(call);
    EXPECT_EQ(outcome.exit_code, 2) << call << "\n" << outcome.out;
    EXPECT_EQ(count_of(outcome.out, "where the robot stands"), 1U) << call << "\n" << outcome.out;
  }
}

TEST_F(Input, ARecordingThatStandsTwiceIsNamed) {
  const std::string robot = kCases + "gap/arm2.robot", run = kCases + "gap/run.csv.gz";
  fs::copy_file(run, path("copy.csv.gz"), fs::copy_options::overwrite_existing);
  const Outcome twice = dynid("fit " + robot + " " + run + " " + path("copy.csv.gz"));
  EXPECT_EQ(count_of(twice.out, "again: its equations count twice"), 1U) << twice.out;
  const Outcome heldout = dynid("fit " + robot + " " + run + " --holdout " + run);
  EXPECT_EQ(count_of(heldout.out, "is held out and fitted"), 1U) << heldout.out;
  const Outcome both = dynid("diagnose " + robot + " " + run + " --reference " + run);
  EXPECT_EQ(count_of(both.out, "is on both sides of the comparison"), 1U) << both.out;
  const Outcome right = dynid("fit " + robot + " " + run);
  EXPECT_EQ(count_of(right.out, "twice") + count_of(right.out, "held out"), 0U) << right.out;
}

TEST_F(Input, EveryCommandGivesTheWarningsOfTheRobotFileOnce) {
  const std::string nog = kCases + "no_gravity_row/nog.robot";
  for (const std::string& call : calls(nog, path("out"))) {
    const Outcome outcome = dynid(call);
    EXPECT_EQ(count_of(outcome.out,
                       "nog.robot:23:1: warning: no row gx, gy or gz stands above: "
                       "gravity is zero"),
              1U)
        << call << "\n"
        << outcome.out;
  }
  const std::string com = kCases + "inertia_at_com/com.robot";
  for (const std::string& call : calls(com, path("out"))) {
    const std::string out = dynid(call).out;
    EXPECT_EQ(count_of(out,
                       "com.robot:8:9: warning: 'ZZ' of link 2 is 0.02, below the moment of "
                       "its mass at its centre, (mX^2 + mY^2)/m = 0.18"),
              1U)
        << call << "\n"
        << out;
  }
  const std::string mm = kCases + "millimetres/mm.robot";
  for (const std::string& call : calls(mm, path("out"))) {
    EXPECT_EQ(count_of(dynid(call).out, "a length of 450 m"), 1U) << call;
  }
}

TEST_F(Input, AFitGivesThemBesideItsAnswer) {
  const std::string folder = kCases + "no_gravity_row/";
  const Outcome fit = dynid("fit " + folder + "nog.robot " + folder + "run2_0.csv.gz");
  EXPECT_EQ(count_of(fit.out, "gravity is zero"), 1U) << fit.out;
}

TEST_F(Input, ThePlantsFileIsWarnedOfToo) {
  const Outcome simulate = dynid("simulate " + robot() + " --plant " + kCases +
                                 "millimetres/mm.robot --trajectory none.csv -o " + path("x.csv"));
  EXPECT_NE(simulate.out.find("a length of 450 m"), std::string::npos) << simulate.out;
  // absent rows are zero where a robot is simulated, unknown where it is fitted
  EXPECT_NE(simulate.out.find("joints 1, 2 carry neither mass nor inertia"), std::string::npos);
  EXPECT_EQ(dynid("fit " + robot() + " none.csv").out.find("neither mass"), std::string::npos);
}

TEST_F(Input, RequirementsOfEffectsAreCheckedOnTheRow) {
  const std::string arm = write("arm.robot",
                                "number_link 1\nm 1\nmX 0.1\nZZ 1\nFs 2\ngy 9.81\n"
                                "effect stribeck joint=1 Fs=1 vs=0.1\nstop\n");
  for (const char* command : {"fit", "check", "diagnose", "atlas"}) {
    const std::string out = dynid(std::string(command) + " " + arm + " none.csv").out;
    EXPECT_EQ(count_of(out,
                       "arm.robot:7:28: warning: effect 'stribeck' of joint 1: Fc = 2, Fs = 1: "
                       "expected Fc <= Fs"),
              1U)
        << out;
  }
}

TEST_F(Input, MistakesOfEffectsAreReportedWithAllOthers) {
  const std::string arm = write("arm.robot",
                                "number_link 2\nsigma 0 2\nd 0 L\nFs 1 1\ngy 9.81\n"
                                "effect stribek joint=1 Fs=2\neffect stribeck joint=5\nstop\n");
  for (const char* command : {"fit", "check", "diagnose", "atlas"}) {
    const Outcome outcome = dynid(std::string(command) + " " + arm + " none.csv");
    EXPECT_EQ(outcome.exit_code, 1);
    for (const char* message :
         {"arm.robot:3:5: error: unknown symbol 'L'", "arm.robot:4:6: error: 'Fs' of joint 2",
          "arm.robot:6:8: error: unknown effect 'stribek'",
          "arm.robot:7:23: error: '5' is no joint"}) {
      EXPECT_EQ(count_of(outcome.out, message), 1U) << command << "\n" << outcome.out;
    }
  }
}

TEST_F(Input, NoInputIsWrittenOver) {
  const std::string arm = robot(), run = record("run.csv");
  const std::string robot_text = content(arm), run_text = content(run);
  fs::create_symlink(arm, path("link.robot"));
  fs::create_hard_link(run, path("hard.csv"));
  const std::vector<std::string> refused = {
      "fit " + arm + " " + run + " -o " + arm,
      "fit " + arm + " " + run + " -o " + path("link.robot"),
      "fit " + arm + " " + run + " -o " + path("../") + folder_.filename().string() + "/arm.robot",
      "fit " + arm + " " + run + " --json " + path("hard.csv"),
      "fit " + arm + " " + run + " --holdout " + path("hard.csv") + " --report " + path("hard.csv"),
      "fit " + arm + " " + run + " -o " + path("same") + " --json " + path("same"),
      "check " + arm + " " + run + " --json " + run,
      "accumulate " + arm + " " + run + " -o " + run,
      "atlas " + arm + " " + run + " --json " + arm,
      "diagnose " + arm + " " + run + " -o " + arm,
      "diagnose " + arm + " " + run + " --reference " + path("hard.csv") + " --json " +
          path("hard.csv"),
      "excite " + arm + " -o " + arm,
      "simulate " + arm + " --trajectory " + run + " -o " + run,
      "simulate " + arm + " --trajectory " + run + " -o " + path("o.csv") + " --truth " +
          path("o.csv")};
  for (const std::string& call : refused) {
    const Outcome outcome = dynid(call);
    EXPECT_EQ(outcome.exit_code, 2) << call << "\n" << outcome.out;
    EXPECT_NE(outcome.out.find("are the same file"), std::string::npos) << outcome.out;
  }
  EXPECT_EQ(content(arm), robot_text);
  EXPECT_EQ(content(run), run_text);
  EXPECT_FALSE(fs::exists(path("same")));
  // merge may replace what it merges
  const std::string part = path("part.qr");
  ASSERT_EQ(dynid("accumulate " + arm + " " + run + " -o " + part).exit_code, 0);
  EXPECT_EQ(dynid("merge " + part + " -o " + part).exit_code, 0);
}

TEST_F(Input, MisspeltCommandsAndOptionsAreCorrected) {
  const auto says = [](const std::string& call, const std::string& text) {
    const Outcome outcome = dynid(call);
    EXPECT_EQ(outcome.exit_code, 2) << call;
    EXPECT_NE(outcome.out.find(text), std::string::npos) << call << "\n" << outcome.out;
  };
  says("fitt a.robot a.csv", "unknown command 'fitt'; did you mean 'fit'?");
  says("Fit a.robot a.csv", "did you mean 'fit'?");
  says("diagnoze a.robot", "did you mean 'diagnose'?");
  says("identify a.robot", "unknown command 'identify'; expected fit, check,");
  says("fit a.robot a.csv --jsno x", "unknown option '--jsno'; did you mean '--json'?");
  says("fit a.robot a.csv --hold-out=b.csv", "did you mean '--holdout'?");
  says("fit a.robot a.csv -json x", "did you mean '--json'?");
  says("simulate a.robot --trajectry t.csv -o x.csv", "did you mean '--trajectory'?");
  says("excite a.robot --harmonic 3 -o x.csv", "did you mean '--harmonics'?");
  says("--versoin", "did you mean '--version'?");
  says("fit a.robot a.csv --quite-different", "--quite-different");
}

TEST_F(Input, RepairsAreToldAlsoWhereTheRunFails) {
  const std::string arm = robot();
  std::string rows = "\xEF\xBB\xBFtime,q1,q2,tau1,tau2\n\n";
  for (int k = 0; k < 12; ++k) rows += "0.0" + std::to_string(k + 10) + ",0,0,1,1\n";
  const std::string short_run = write("short.csv", rows);
  const std::string bad = write("bad.csv", rows + "0.023,0,x,1,1\n0.024,0,0,1,1\n");
  for (const char* command : {"fit", "check", "atlas", "diagnose"}) {
    for (const std::string& file : {short_run, bad}) {
      const Outcome outcome = dynid(std::string(command) + " " + arm + " " + file);
      EXPECT_NE(outcome.exit_code, 0);
      EXPECT_EQ(count_of(outcome.out, file + ":2:1: warning: found a blank line; skipped"), 1U)
          << command << "\n"
          << outcome.out;
    }
  }
  const Outcome simulate =
      dynid("simulate " + arm + " --trajectory " + bad + " -o " + path("x.csv"));
  EXPECT_NE(simulate.out.find("found a blank line"), std::string::npos) << simulate.out;
}

/// Samples that were taken evenly and stamped late: positions tell.
TEST_F(Input, AJitteredRecordingGetsAClockAndNobodyIsAskedTo) {
  const std::string arm = robot();
  Recording recording = test::multisine(
      describe_robot(arm, OpenParameters::kAbsentRows).linear,
      test::plausible_beta(describe_robot(arm, OpenParameters::kAbsentRows).linear, 1), {});
  for (Eigen::Index k = 1; k + 1 < recording.samples(); k += 3) recording.time[k] += 4e-4;
  write_recording(recording, path("jitter.csv"));
  const Outcome fit = dynid("fit " + arm + " " + path("jitter.csv"));
  EXPECT_NE(fit.out.find("the clock is rebuilt"), std::string::npos) << fit.out;
  EXPECT_EQ(fit.out.find("resample before"), std::string::npos);
}

}  // namespace
}  // namespace dyngen::runtime
