// SPDX-License-Identifier: MIT
// What dynid writes dyngen reads, and it leaves the residual that the fit printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gen/robot_file/robot_file.h"
#include "runtime/recordings/gzip.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/random_robot_text.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::VectorXd;
using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;

/// How many random robots go round; DYNGEN_ROUND_TRIPS asks for more.
int round_trips() {
  constexpr int kDefault = 40;
  const char* asked = std::getenv("DYNGEN_ROUND_TRIPS");
  return asked == nullptr ? kDefault : std::atoi(asked);
}

class RoundTrip : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("round_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  [[nodiscard]] Json json(const std::string& name) const {
    return Json::parse(content(path(name)));
  }

  /// A recording whose torque has noise, of a robot with any parameters that the file allows.
  std::string record(const std::string& name, const DescribedRobot& robot, const VectorXd& beta,
                     const test::MultisineOptions& options) const {
    Recording recording = test::multisine(robot.linear, beta, options);
    recording.dq.resize(0, 0);
    recording.ddq.resize(0, 0);
    write_recording(recording, path(name));
    return path(name);
  }

  /// Fit, identified file, check. @return  what is wrong; empty: nothing
  std::string go_round(const std::string& robot, const std::string& recording) const {
    const Outcome fit = dynid("fit " + robot + " " + recording + " -o " + path("id.robot") +
                              " --json " + path("fit.json"));
    if (fit.exit_code != 0 && fit.exit_code != 3) return "fit: " + fit.out;
    const Outcome check =
        dynid("check " + path("id.robot") + " " + recording + " --json " + path("check.json"));
    if (check.exit_code != 0) return "check: " + check.out;
    const Json residual = json("fit.json")["residual"];
    const Json checked = json("check.json")["recordings"][0]["rms"];
    for (std::size_t j = 0; j < residual.size(); ++j) {
      // both sums of squares are rounded
      const double fitted = residual[j]["rms"], left = checked[j];
      if (std::abs(fitted - left) > 1e-6 * fitted + 1e-9) {
        return "joint " + std::to_string(j + 1) + ": the fit leaves " + std::to_string(fitted) +
               ", the file " + std::to_string(left);
      }
    }
    return "";
  }

  fs::path folder_;
};

/// Largest difference between a file's torque, as an independent recursion sees it, and that of
/// fitted parameters, beside the largest torque.
double judged_difference(const std::string& identified, const LinearModel& linear,
                         const VectorXd& beta) {
  const RobotModel model = test::parse_model(identified);
  const test::NumericRobot numeric = test::numeric_robot(model);
  double worst = 0, largest = 1e-3;
  for (const test::MotionSample& sample : test::random_samples(linear.joints(), 6, 5)) {
    const auto row = [](const std::vector<double>& values) {
      return Eigen::MatrixXd(
          Eigen::RowVectorXd::Map(values.data(), static_cast<Index>(values.size())));
    };
    const Eigen::MatrixXd tau = linear.torque(row(sample.q), row(sample.dq), row(sample.ddq), beta);
    const std::vector<double> wanted = test::judge(model, numeric, "id", sample);
    for (Index j = 0; j < tau.cols(); ++j) {
      worst = std::max(worst, std::abs(tau(0, j) - wanted[static_cast<std::size_t>(j)]));
      largest = std::max(largest, std::abs(tau(0, j)));
    }
  }
  return worst / largest;
}

TEST_F(RoundTrip, AnyRobotsIdentifiedFileLeavesTheResidualOfItsFit) {
  const int wanted = round_trips();
  int done = 0;
  for (std::uint64_t seed = 1; done < wanted; ++seed) {
    const std::string text = test::random_robot_text(seed);
    const std::string robot = written("arm.robot", text);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    const DescribedRobot described = describe_robot(robot, OpenParameters::kAbsentRows);
    if (described.linear.size() == 0) continue;  // nothing is open
    ++done;
    VectorXd beta = test::plausible_beta(described.linear, seed);
    if (seed % 2 == 0) beta = -beta;  // what a turned sign makes of inertia and friction
    const std::string recording = record(
        "run.csv", described, beta,
        {.seconds = 4, .sample_time = 0.004, .period = 4, .torque_noise = 0.05, .seed = seed});
    const std::string fault = go_round(robot, recording);
    ASSERT_EQ(fault, "") << content(path("id.robot"));
    const Json parameters = json("fit.json")["parameters"];
    ASSERT_EQ(parameters.size(), static_cast<std::size_t>(described.linear.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      beta[static_cast<Index>(i)] = parameters[i]["value"];
    }
    ASSERT_LT(judged_difference(content(path("id.robot")), described.linear, beta), 1e-9)
        << content(path("id.robot"));
  }
  RecordProperty("robots", done);
}

TEST_F(RoundTrip, StandardDhArmWithAnElbow) {
  if (!gzip_available()) GTEST_SKIP() << "built without zlib";
  const std::string folder = DYNGEN_SOURCE_DIR "/tests/data/cases/standard_dh/";
  EXPECT_EQ(go_round(folder + "ur5std.robot", folder + "run.csv.gz"), "");
  const RobotFile file = read_robot_file(path("id.robot"));
  EXPECT_EQ(file.parameters, ParameterMeaning::kBase);
}

TEST_F(RoundTrip, EffectsSeeTheLoadThatTheFitSaw) {
  // rotors that are known, and that base parameters join with the links
  std::string text = content(DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot");
  const std::size_t row = text.find("\nIA ");
  text.replace(row, text.find('\n', row + 1) - row, "\nIA 0.7 0.5 0.2");
  text.insert(text.rfind("stop"), "effect load_friction joint=2\neffect stribeck joint=1\n");
  const std::string robot = written("geared.robot", text);
  const DescribedRobot described = describe_robot(robot, OpenParameters::kAbsentRows);
  const std::string recording = record(
      "run.csv", described, test::plausible_beta(described.linear, 4), {.torque_noise = 0.3});
  EXPECT_EQ(go_round(robot, recording), "") << content(path("id.robot"));
}

/// Arms whose fit is apt to end in negative rotor inertia, mass or friction.
struct PlainArm {
  const char* name;
  const char* rows;
};

class DiagnoseAnswers : public RoundTrip, public testing::WithParamInterface<PlainArm> {};

TEST_P(DiagnoseAnswers, AndItsFileIsRead) {
  const std::string robot = written("arm.robot", GetParam().rows);
  const DescribedRobot described = describe_robot(robot, OpenParameters::kAbsentRows);
  for (const std::uint64_t seed : {1U, 2U}) {
    SCOPED_TRACE(seed);
    VectorXd beta = test::plausible_beta(described.linear, seed);
    for (Index i = 0; i < beta.size(); ++i) {  // no rotor, no friction
      const ParameterKind kind = described.linear.parameters[static_cast<std::size_t>(i)].kind;
      if (kind != ParameterKind::kInertial) beta[i] = 0;
    }
    const std::string recording =
        record("run.csv", described, beta,
               {.seconds = 12, .sample_time = 0.01, .torque_noise = 0.1, .seed = seed});
    const Outcome run = dynid("diagnose " + robot + " " + recording + " --json " + path("d.json") +
                              " --report " + path("d.html") + " -o " + path("d.robot"));
    ASSERT_EQ(run.exit_code, 0) << run.out;
    EXPECT_EQ(test::schema_faults(json("d.json")), std::vector<std::string>{});
    EXPECT_EQ(test::page_fault(content(path("d.html"))), "");
    const Outcome check = dynid("check " + path("d.robot") + " " + recording);
    EXPECT_EQ(check.exit_code, 0) << check.out;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Arms, DiagnoseAnswers,
    testing::Values(PlainArm{"planar",
                             "number_link 2\nsigma 0 0\nal pi/2 0\nd 0 0.5\nth 0 0\n"
                             "r 0 0\nIA * *\ngz 9.81\nstop\n"},
                    PlainArm{"gantry",
                             "number_link 2\nsigma 1 1\nal 0 pi/2\nd 0 0\nth 0 0\n"
                             "r 0 0\ngz 9.81\nstop\n"},
                    PlainArm{"standard",
                             "number_link 2\ndh standard\nsigma 0 0\nal pi/2 0\n"
                             "d 0 0.4\nth 0 0\nr 0.1 0\ngz 9.81\nstop\n"}),
    [](const auto& entry) { return std::string(entry.param.name); });

}  // namespace
}  // namespace dyngen::runtime
