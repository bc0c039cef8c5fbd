// SPDX-License-Identifier: MIT
#include "runtime/effects/model_triangles.h"

#include <gtest/gtest.h>

#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::known;

constexpr double kTriangleSampleTime = 0.005;

class ModelTrianglesTest : public testing::Test {
 protected:
  ModelTrianglesTest()
      : data_(effect_recordings(test::planar_arm(), test::planar_arm_tangents(),
                                test::measured({test::sines(20, kTriangleSampleTime),
                                                test::sines(15, kTriangleSampleTime, 0.9, 0.4)},
                                               test::planar_arm_values(), {}, 0.1, 0.5, 1),
                                {1, -1})),
        signals_(data_) {}

  /// Triangles of both ways over all parameters of the effects, as far as least squares see them:
  /// R'R and the numbers of equations.
  void expect_the_same(const std::vector<EffectInstance>& effects, ModelTriangles& triangles) {
    const EffectPoint point = at_rest(data_, test::planar_arm_values(), effects);
    EffectUnknowns unknowns = base_unknowns(point);
    for (std::vector<int>& places : unknowns.parameters) {
      for (int& place : places) place = unknowns.size++;
    }
    const EffectEquations equations = linearised(data_, signals_, point, unknowns);
    const TorqueFactor whole = factor_of(equations.source(), equations.columns, unknowns.size);
    const TorqueFactor kept = triangles.at(signals_, point, unknowns);
    EXPECT_EQ(kept.columns, whole.columns);
    EXPECT_EQ(kept.parameters, whole.parameters);
    ASSERT_EQ(kept.joints.size(), whole.joints.size());
    for (std::size_t j = 0; j < whole.joints.size(); ++j) {
      EXPECT_EQ(kept.joints[j].rows, whole.joints[j].rows);
      const MatrixXd& A = whole.joints[j].R;
      const MatrixXd& B = kept.joints[j].R;
      ASSERT_EQ(A.rows(), B.rows());
      EXPECT_GE(B.diagonal().minCoeff(), 0);
      EXPECT_TRUE(B.isUpperTriangular(0));
      // columns of unit length: what is left is rounding of some thousand equations
      const VectorXd length = A.colwise().norm().cwiseMax(1e-300).transpose();
      const MatrixXd scaled_a = A * length.cwiseInverse().asDiagonal();
      const MatrixXd scaled_b = B * length.cwiseInverse().asDiagonal();
      const MatrixXd difference = scaled_a.transpose() * scaled_a - scaled_b.transpose() * scaled_b;
      EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-13) << "joint " << j + 1;
    }
  }

  EffectRecordings data_;
  EffectSignals signals_;
};

TEST_F(ModelTrianglesTest, AJointWithoutEffectsKeepsItsTriangle) {
  ModelTriangles triangles(data_);
  expect_the_same({}, triangles);
  expect_the_same({known(test::stribeck_law(), 1, {4.2, 0.11})}, triangles);
  expect_the_same({}, triangles);
}

TEST_F(ModelTrianglesTest, ColumnsOfEffectsAreThoseBesideTheModel) {
  ModelTriangles triangles(data_);
  expect_the_same({known(test::stribeck_law(), 0, {4.2, 0.11})}, triangles);
  expect_the_same(
      {known(test::stribeck_law(), 0, {3.0, 0.05}), known(test::ripple_law(), 0, {0.3, -0.2, 37.3}),
       known(test::spring_law(), 1, {2.0})},
      triangles);
  expect_the_same({known(test::tilt_law(), -1, {0.15, 0.05})}, triangles);
}

TEST_F(ModelTrianglesTest, EffectsThatChangeColumnsOfTheModelAreTriangulatedWhole) {
  ModelTriangles triangles(data_);
  expect_the_same({known(test::load_friction_law(), 1, {0.06})}, triangles);
  expect_the_same({known(test::delay_law(), -1, {0.004})}, triangles);
  expect_the_same({known(test::lag_law(), -1, {0.004}), known(test::spring_law(), 0, {2.0})},
                  triangles);
}

TEST_F(ModelTrianglesTest, FewerEquationsThanColumnsHaveTriangles) {
  for (EffectRun& run : data_.runs) {
    run.rows.Y = run.rows.Y.topRows(3).eval();
    run.rows.tau = run.rows.tau.topRows(3).eval();
    run.rows.counted = run.rows.counted.topRows(3).eval();
  }
  ModelTriangles triangles(data_);
  const EffectPoint point = at_rest(data_, test::planar_arm_values(), {});
  const TorqueFactor kept = triangles.at(signals_, point, base_unknowns(point));
  EXPECT_EQ(kept.joints.front().rows, 6);
  EXPECT_TRUE(kept.joints.front().R.allFinite());
}

}  // namespace
}  // namespace dyngen::runtime
