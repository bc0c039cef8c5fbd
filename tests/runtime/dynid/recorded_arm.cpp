// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/recorded_arm.h"

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "runtime/recordings/trajectory_file.h"

namespace dyngen::test {

using Eigen::Index;

void RecordedArm::SetUp() {
  const testing::TestInfo* own = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = std::filesystem::path(testing::TempDir()) /
            (std::string(own->test_suite_name()) + "_" + own->name());
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
}

std::string RecordedArm::arm(const std::string& name, const std::string& rows,
                             const std::string& friction) const {
  std::ofstream(path(name)) << "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\nth 0 0\n"
                               "r 0 0\nm 8 4\nmX 2 0.8\nmY 0 0\nmZ 0 0\nXX 0.02 0.01\nXY 0 0\n"
                               "XZ 0 0\nYY 0.7 0.25\nYZ 0 0\nZZ 0.7 0.25\nIA 0.5 0.3\nFs "
                            << friction << "\nFv 3 1.5\noff 0 0\ntaumax 400 200\ngy 9.81\n"
                            << rows << "stop\n";
  return path(name);
}

std::string RecordedArm::open_arm() const {
  std::ofstream(path("open.robot"))
      << "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\nth 0 0\nr 0 0\nm * *\nmX * *\n"
         "mY * *\nmZ * *\nXX * *\nXY * *\nXZ * *\nYY * *\nYZ * *\nZZ * *\nIA * *\nFs * *\n"
         "Fv * *\noff * *\ngy 9.81\nstop\n";
  return path("open.robot");
}

void RecordedArm::waves(const std::string& name, double seconds) const {
  constexpr double kStep = 0.004;                                     // s
  constexpr double kAmplitude = 0.25;                                 // rad, of each sine
  constexpr std::array<double, 3> kFrequencies = {0.11, 0.31, 0.73};  // Hz
  constexpr std::array<double, 2> kFaster = {1, 1.37};                // of each joint
  const Index samples = 1 + std::lround(seconds / kStep);
  runtime::Trajectory motion;
  motion.time = Eigen::VectorXd::LinSpaced(samples, 0, seconds);
  for (auto* part : {&motion.q, &motion.dq, &motion.ddq}) part->setZero(samples, 2);
  for (Index j = 0; j < 2; ++j) {
    for (const double hertz : kFrequencies) {
      const double w = 2 * std::numbers::pi * hertz * kFaster[static_cast<std::size_t>(j)];
      const Eigen::ArrayXd angle = w * motion.time.array();
      motion.q.col(j).array() += kAmplitude * (1 - angle.cos());
      motion.dq.col(j).array() += kAmplitude * w * angle.sin();
      motion.ddq.col(j).array() += kAmplitude * w * w * angle.cos();
    }
  }
  write_trajectory(motion, path(name));
}

}  // namespace dyngen::test
