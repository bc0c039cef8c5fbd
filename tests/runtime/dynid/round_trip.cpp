// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/round_trip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>

#include "runtime/recordings/writer.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::VectorXd;
using runtime::DescribedRobot;
using runtime::LinearModel;
using Json = nlohmann::json;

void RoundTrip::SetUp() {
  std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::replace(name.begin(), name.end(), '/', '_');
  folder_ = fs::path(testing::TempDir()) / ("round_" + name);
  fs::remove_all(folder_);
  fs::create_directories(folder_);
}

void RoundTrip::TearDown() {
  if (!HasFailure()) fs::remove_all(folder_);
}

std::string RoundTrip::written(const std::string& name, const std::string& text) const {
  std::ofstream(path(name)) << text;
  return path(name);
}

Json RoundTrip::json(const std::string& name) const { return Json::parse(content(path(name))); }

std::string RoundTrip::record(const std::string& name, const DescribedRobot& robot,
                              const VectorXd& beta, const MultisineOptions& options) const {
  runtime::Recording recording = multisine(robot.linear, beta, options);
  recording.dq.resize(0, 0);
  recording.ddq.resize(0, 0);
  write_recording(recording, path(name));
  return path(name);
}

std::string RoundTrip::go_round(const std::string& robot, const std::string& recording,
                                const std::string& options) const {
  const Outcome fit = dynid("fit " + robot + " " + recording + " --as-recorded " + options +
                            " -o " + path("id.robot") + " --json " + path("fit.json"));
  if (fit.exit_code != 0 && fit.exit_code != 3) return "fit: " + fit.out;
  const Outcome check = dynid("check " + path("id.robot") + " " + recording +
                              " --as-recorded --json " + path("check.json"));
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

double judged_difference(const std::string& identified, const LinearModel& linear,
                         const VectorXd& beta) {
  const RobotModel model = parse_model(identified);
  const NumericRobot numeric = numeric_robot(model);
  double worst = 0, largest = 1e-3;
  for (const MotionSample& sample : random_samples(linear.joints(), 6, 5)) {
    const auto row = [](const std::vector<double>& values) {
      return Eigen::MatrixXd(
          Eigen::RowVectorXd::Map(values.data(), static_cast<Index>(values.size())));
    };
    const Eigen::MatrixXd tau = linear.torque(row(sample.q), row(sample.dq), row(sample.ddq), beta);
    const std::vector<double> wanted = judge(model, numeric, "id", sample);
    for (Index j = 0; j < tau.cols(); ++j) {
      worst = std::max(worst, std::abs(tau(0, j) - wanted[static_cast<std::size_t>(j)]));
      largest = std::max(largest, std::abs(tau(0, j)));
    }
  }
  return worst / largest;
}

VectorXd bodily_standard(const DescribedRobot& robot, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  VectorXd standard = VectorXd::Zero(robot.standard.size());
  for (int link = 1; link <= robot.model.size(); ++link) {
    auto own =
        standard.segment(static_cast<Index>(kChiCount) * (link - 1), static_cast<Index>(kChiCount));
    const double m = between(0.5, 4);
    const Eigen::Vector3d c(between(-0.2, 0.2), between(-0.2, 0.2), between(-0.2, 0.2));
    const Eigen::Vector3d sizes(between(0.05, 0.3), between(0.05, 0.3), between(0.05, 0.3));
    const Eigen::Vector3d squares = m * sizes.cwiseAbs2();
    Eigen::Matrix3d J = (squares.sum() * Eigen::Matrix3d::Identity());
    J.diagonal() -= squares;
    J += m * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
    const std::array<double, 10> ten = {J(0, 0), J(0, 1),   J(0, 2),   J(1, 1),   J(1, 2),
                                        J(2, 2), m * c.x(), m * c.y(), m * c.z(), m};
    for (std::size_t k = 0; k < ten.size(); ++k) own[static_cast<Index>(k)] = ten[k];
    own[static_cast<Index>(Chi::kIA)] = between(0.05, 0.5);
    own[static_cast<Index>(Chi::kFS)] = between(0.5, 3);
    own[static_cast<Index>(Chi::kFV)] = between(0.2, 2);
    own[static_cast<Index>(Chi::kOFF)] = between(-0.3, 0.3);
  }
  return standard;
}

VectorXd bodily_beta(const DescribedRobot& robot, std::uint64_t seed) {
  return robot.grouping * bodily_standard(robot, seed);
}

}  // namespace dyngen::test
