// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"

namespace dyngen::test {

/// Robot files and recordings in a folder of the test's own, and ways through dynid and back.
class RoundTrip : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  /// @return  its path
  [[nodiscard]] std::string written(const std::string& name, const std::string& text) const;
  [[nodiscard]] nlohmann::json json(const std::string& name) const;

  /// A recording whose torque has noise, of a robot with any parameters that the file allows.
  [[nodiscard]] std::string record(const std::string& name, const runtime::DescribedRobot& robot,
                                   const Eigen::VectorXd& beta,
                                   const MultisineOptions& options) const;

  /// Fit, identified file, check. @return  what is wrong; empty: nothing
  [[nodiscard]] std::string go_round(const std::string& robot, const std::string& recording,
                                     const std::string& options = "") const;

 private:
  std::filesystem::path folder_;
};

/// Largest difference between a file's torque, as an independent recursion sees it, and that of
/// fitted parameters, beside the largest torque.
double judged_difference(const std::string& identified, const runtime::LinearModel& linear,
                         const Eigen::VectorXd& beta);

/// Standard parameters of bodies and rotors that could exist, (14 links).
Eigen::VectorXd bodily_standard(const runtime::DescribedRobot& robot, std::uint64_t seed);
/// Their base parameters, as far as the file leaves them open.
Eigen::VectorXd bodily_beta(const runtime::DescribedRobot& robot, std::uint64_t seed);

}  // namespace dyngen::test
