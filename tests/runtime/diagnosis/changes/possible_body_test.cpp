// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/possible_body.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace dyngen::runtime {
namespace {

BodyEvidence evidence_of(const BodyVector& truth, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd A(40, kBodyParameters);
  for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = normal(random);
  A.leftCols(6) *= 20;  // units that differ
  A.col(9) *= 0.1;
  BodyEvidence evidence;
  evidence.G = A.transpose() * A;
  evidence.b = evidence.G * truth;
  return evidence;
}

TEST(PossibleBody, IsTheBodyWhereItExists) {
  PointMass point{1.5, {0.1, -0.2, 0.3}};
  BodyVector box = point.parameters();
  box[0] += 0.01;
  box[3] += 0.012;
  box[5] += 0.015;
  for (const double sign : {1.0, -1.0}) {
    const PossibleBody found = possible_body(evidence_of(sign * box, 3));
    EXPECT_LT(found.worse, 1e-4);
    EXPECT_LT((found.parameters - sign * box).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(PossibleBody, IsWorseThanNumbersThatAreNoBody) {
  BodyVector none = BodyVector::Zero();
  none[6] = 1;  // a first moment without mass
  const BodyEvidence evidence = evidence_of(none, 4);
  const PossibleBody found = possible_body(evidence);
  EXPECT_GT(found.worse, 1);
  EXPECT_NEAR(found.worse, evidence.chi_square(found.parameters) - evidence.chi_square(none), 1e-6);
}

/// An arm in a plane shows four of the ten: a body with these and its mass all to one side exists.
TEST(PossibleBody, IsFoundWhereMostOfItIsNotSeenWhateverChiSquare) {
  const PointMass point{0.5, {0.3, 0.05, 0}};
  BodyVector truth = point.parameters();
  truth[5] += 0.002;
  for (const double strength : {1.0, 1e3, 1e5, 1e7}) {
    BodyEvidence evidence = evidence_of(truth, 6);
    for (const int hidden : {0, 1, 2, 3, 4, 8}) {
      evidence.G.row(hidden).setZero();
      evidence.G.col(hidden).setZero();
    }
    evidence.G *= strength;
    evidence.b = evidence.G * truth;
    EXPECT_LT(possible_body(evidence).worse, 1e-3) << strength;
  }
}

/// Chi-square is convex over bodies: from the body found every way to another body leads up.
TEST(PossibleBody, IsTheBestOfThoseNearIt) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  BodyVector none = PointMass{0.5, {0.3, 0.05, 0}}.parameters();
  none[5] += 0.02;  // more about one axis than about the two others: no body
  const BodyEvidence evidence = evidence_of(none, 4);
  const PossibleBody found = possible_body(evidence);
  const double least = evidence.chi_square(found.parameters);
  for (int trial = 0; trial < 1000; ++trial) {
    const PointMass other{std::abs(normal(random)),
                          {normal(random), normal(random), normal(random)}};
    const BodyVector way = other.parameters() - found.parameters;
    EXPECT_GT(evidence.chi_square(found.parameters + 1e-2 * way), least - 1e-3);
  }
}

TEST(PossibleBody, FindsAPointOfMass) {
  const PointMass truth{0.7, {0.2, 0.05, -0.1}};
  const PointMass found = point_mass(evidence_of(truth.parameters(), 5),
                                     possible_body(evidence_of(truth.parameters(), 5)).parameters);
  EXPECT_NEAR(found.mass, truth.mass, 1e-4);
  EXPECT_LT((found.place - truth.place).norm(), 1e-4);
  // its tangents are its derivatives
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < 4; ++i) {
    PointMass moved = truth;
    (i == 0 ? moved.mass : moved.place[i - 1]) += kStep;
    const BodyVector slope = (moved.parameters() - truth.parameters()) / kStep;
    EXPECT_LT((slope - truth.tangents().col(i)).cwiseAbs().maxCoeff(), 1e-5);
  }
}

}  // namespace
}  // namespace dyngen::runtime
