// SPDX-License-Identifier: MIT
// Least squares against numpy's lstsq on the same matrices.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>

#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/rows.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class Numpy : public testing::TestWithParam<const char*> {};

TEST_P(Numpy, SolvesTheSameEquationsAlike) {
  const std::string python = DYNGEN_PYTHON_WITH_NUMPY;
  if (python.empty()) GTEST_SKIP() << "numpy (python3-numpy) is not here";
  const DescribedRobot robot =
      describe_robot(std::string(DYNGEN_SOURCE_DIR "/") + GetParam(), OpenParameters::kAbsentRows);
  const LinearModel& model = robot.linear;
  const Recording recording =
      test::multisine(model, test::plausible_beta(model, 3),
                      {.seconds = 4, .sample_time = 0.02, .torque_noise = 1, .seed = 3});
  RowBlock block;
  model.regressor(recording.q, recording.dq, recording.ddq, block.Y);
  block.tau = recording.tau;
  TorqueFactor factor = empty_factor(model.columns, model.size());
  absorb(factor, block);

  const std::string path = test::temporary_path("lstsq.csv");
  FILE* file = std::fopen(path.c_str(), "w");
  for (Index j = 0; j < recording.tau.cols(); ++j) {
    for (Index k = 0; k < recording.samples(); ++k) {
      for (int c = 0; c < model.size(); ++c) {
        std::fprintf(file, "%.17g,", block.Y(k, j * model.size() + c));
      }
      std::fprintf(file, "%.17g\n", block.tau(k, j));
    }
  }
  std::fclose(file);
  FILE* pipe =
      popen((python + " " DYNGEN_SOURCE_DIR "/tests/runtime/dynid/lstsq.py " + path).c_str(), "r");
  VectorXd wanted(model.size());
  for (double& value : wanted) ASSERT_EQ(std::fscanf(pipe, "%lf", &value), 1);
  ASSERT_EQ(pclose(pipe), 0);

  for (const Decomposition decomposition : {Decomposition::kQr, Decomposition::kSvd}) {
    const VectorXd beta =
        least_squares(factor, VectorXd::Ones(model.joints()), {.decomposition = decomposition})
            .beta;
    EXPECT_LT((beta - wanted).cwiseAbs().maxCoeff(), 1e-9 * wanted.cwiseAbs().maxCoeff());
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, Numpy,
                         testing::Values("tests/studies/robots/puma3.robot",
                                         "tests/studies/robots/ur10e.robot",
                                         "tests/studies/robots/panda.robot", "robots/tx40.robot"));

}  // namespace
}  // namespace dyngen::runtime
