// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/posterior/effect_posterior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd normal(Index rows, Index columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> one;
  return MatrixXd::NullaryExpr(rows, columns, [&](Index, Index) { return one(random); });
}

std::vector<Candidate> candidates(const std::vector<Index>& columns, double log_odds) {
  std::vector<Candidate> all;
  for (const Index count : columns) all.push_back({count, all.size(), log_odds});
  return all;
}

SetEvidence evidence(const MatrixXd& X, const VectorXd& y, std::vector<Candidate> all,
                     double slab = 200) {
  return {X.transpose() * X, X.transpose() * y, std::move(all), slab};
}

// the density of y with the coefficients integrated out, over that of noise alone
TEST(SetEvidence, IsTheRatioOfDensitiesOfTheTorque) {
  const MatrixXd X = normal(40, 3, 1).householderQr().householderQ() * MatrixXd::Identity(40, 3);
  const VectorXd y = 3 * X.col(0) - X.col(2) + normal(40, 1, 2);
  const double slab = 7;
  const SetEvidence one = evidence(X, y, candidates({2, 1}, -1.5), slab);
  const MatrixXd covariance = MatrixXd::Identity(40, 40) + slab * X * X.transpose();
  const double expected = -0.5 * y.dot(covariance.inverse() * y) + 0.5 * y.squaredNorm() -
                          0.5 * std::log(covariance.determinant()) - 2 * 1.5;
  EXPECT_NEAR(one.of({0, 1}), expected, 1e-9);
  EXPECT_EQ(one.of({}), 0);
}

TEST(SetEvidence, DoesNotDependOnUnitsNorOnDependentColumns) {
  const MatrixXd X = normal(60, 4, 3);
  const VectorXd y = X * VectorXd::Ones(4) + normal(60, 1, 4);
  const SetEvidence plain = evidence(X, y, candidates({2, 2}, -3));
  MatrixXd other(60, 5);
  other << 1e6 * (X.col(0) - 3 * X.col(1)), 1e-6 * X.col(1), X.col(0), X.rightCols(2);
  const SetEvidence same = evidence(other, y, candidates({3, 2}, -3));
  EXPECT_NEAR(plain.of({0, 1}), same.of({0, 1}), 1e-6 * std::abs(plain.of({0, 1})));
}

TEST(SetEvidence, OfASetWithEachIsThatOfTheLargerSet) {
  const MatrixXd X = normal(50, 9, 5);
  const VectorXd y = X.col(1) + X.col(6) + normal(50, 1, 6);
  const SetEvidence all = evidence(X, y, candidates({1, 2, 1, 3, 2}, -2));
  for (const CandidateSet& set : {CandidateSet{}, CandidateSet{1}, CandidateSet{1, 3}}) {
    const VectorXd with = all.with_each(set);
    for (std::size_t place = 0; place < all.size(); ++place) {
      CandidateSet more = set;
      more.push_back(place);
      std::sort(more.begin(), more.end());
      const double expected = all.of(more);
      if (std::isinf(expected)) {
        EXPECT_EQ(with[static_cast<Index>(place)], expected);
      } else {
        EXPECT_NEAR(with[static_cast<Index>(place)], expected, 1e-9);
      }
    }
  }
}

TEST(SetEvidence, OfTwoFormsOfOneHypothesisIsNone) {
  const MatrixXd X = normal(30, 2, 7);
  std::vector<Candidate> forms = candidates({1, 1}, -2);
  forms[1].hypothesis = forms[0].hypothesis;
  const SetEvidence all = evidence(X, X.col(0), forms);
  EXPECT_EQ(all.of({0, 1}), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(all.with_each({0})[1], -std::numeric_limits<double>::infinity());
}

TEST(SetEvidence, RefusesOtherShapes) {
  EXPECT_THROW(SetEvidence(MatrixXd::Identity(3, 3), VectorXd::Zero(3), candidates({2}, 0), 1),
               std::invalid_argument);
  EXPECT_THROW(SetEvidence(MatrixXd::Identity(2, 2), VectorXd::Zero(2), candidates({2}, 0), 0),
               std::invalid_argument);
}

TEST(EffectPosterior, IsThatOfAllSetsWhereTheyCanBeCounted) {
  MatrixXd X = normal(80, 7, 8);
  X.col(4) = X.col(1) + 0.3 * X.col(4);  // alike
  const VectorXd y = 0.5 * X.col(1) + 0.35 * X.col(3) + normal(80, 1, 9);
  const SetEvidence all = evidence(X, y, candidates({1, 1, 1, 1, 1, 1, 1}, -3));
  VectorXd share = VectorXd::Zero(7);
  double sum = 0;
  for (unsigned bits = 0; bits < 128; ++bits) {
    CandidateSet set;
    for (std::size_t i = 0; i < 7; ++i) {
      if ((bits >> i) & 1U) set.push_back(i);
    }
    const double weight = std::exp(all.of(set));
    sum += weight;
    for (const std::size_t i : set) share[static_cast<Index>(i)] += weight;
  }
  const EffectPosterior posterior = effect_posterior(all);
  for (std::size_t i = 0; i < 7; ++i) {
    const double found = posterior.probability([&](std::size_t place) { return place == i; });
    EXPECT_NEAR(found, share[static_cast<Index>(i)] / sum, 1e-3) << i;
  }
  double whole = 0;
  for (const WeightedSet& each : posterior.sets) whole += each.probability;
  EXPECT_NEAR(whole, 1, 1e-12);
}

TEST(EffectPosterior, FindsTwoThatShowOnlyTogether) {
  MatrixXd X = normal(400, 30, 10);
  // each hides the other: their sum is small
  X.col(1) = -X.col(0) + 0.3 * X.col(1);
  const VectorXd y = 1.6 * (X.col(0) + X.col(1)) + normal(400, 1, 11);
  const SetEvidence all =
      evidence(X, y, candidates(std::vector<Index>(30, 1), std::log(0.02 / 30)));
  ASSERT_LT(all.of({0}), 1);
  ASSERT_LT(all.of({1}), 1);
  const EffectPosterior posterior = effect_posterior(all);
  EXPECT_EQ(posterior.sets.front().set, (CandidateSet{0, 1}));
  EXPECT_GT(posterior.any(), 0.99);
}

// Forms of a family share its probability: a near one takes none of it away.
TEST(EffectPosterior, OfAFamilyIsThatOfItsFormsTogether) {
  MatrixXd X = normal(300, 20, 12);
  const VectorXd truth = X.col(5);
  X.col(6) = X.col(5) + 0.02 * X.col(6);
  const VectorXd y = 0.6 * truth + normal(300, 1, 13);
  const SetEvidence all =
      evidence(X, y, candidates(std::vector<Index>(20, 1), std::log(0.02 / 20)));
  const EffectPosterior posterior = effect_posterior(all);
  const auto of = [&](std::size_t first, std::size_t last) {
    return posterior.probability(
        [&](std::size_t place) { return place >= first && place <= last; });
  };
  EXPECT_LT(of(5, 5), 0.9);
  EXPECT_GT(of(5, 6), 0.99);
}

// 0.02 effects are expected on a recording: noise alone is accused about as rarely
TEST(EffectPosterior, OfNoiseHasNothing) {
  constexpr int kDraws = 200;
  int accused = 0;
  double any = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const MatrixXd X = normal(200, 25, 1000 + static_cast<std::uint64_t>(draw));
    const VectorXd y = normal(200, 1, 5000 + static_cast<std::uint64_t>(draw));
    PosteriorOptions options;
    options.steps = 200;
    const EffectPosterior posterior = effect_posterior(
        evidence(X, y, candidates(std::vector<Index>(25, 1), std::log(0.02 / 25))), options);
    any += posterior.any();
    accused += posterior.any() > 0.5 ? 1 : 0;
  }
  EXPECT_LE(accused, 2) << "of " << kDraws;
  EXPECT_LT(any / kDraws, 0.03);
}

TEST(EffectPosterior, IsTheSameForOneSeed) {
  const MatrixXd X = normal(100, 40, 14);
  const VectorXd y = X.col(3) + 0.3 * X.col(9) + normal(100, 1, 15);
  const SetEvidence all = evidence(X, y, candidates(std::vector<Index>(40, 1), -6));
  const EffectPosterior one = effect_posterior(all), again = effect_posterior(all);
  ASSERT_EQ(one.sets.size(), again.sets.size());
  for (std::size_t i = 0; i < one.sets.size(); ++i) {
    EXPECT_EQ(one.sets[i].set, again.sets[i].set);
    EXPECT_EQ(one.sets[i].probability, again.sets[i].probability);
  }
}

TEST(EffectPosterior, OfNoCandidatesIsEmpty) {
  const SetEvidence none(MatrixXd(0, 0), VectorXd(0), {}, 1);
  EXPECT_EQ(effect_posterior(none).any(), 0);
}

}  // namespace
}  // namespace dyngen::runtime
