// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/sandwich_test.h"

#include <algorithm>

namespace dyngen::runtime {
namespace {

constexpr double kFarLarger = 5;          // times
constexpr Eigen::Index kStretches = 200;  // of a joint's equations
constexpr Eigen::Index kOtherTimes = 7;   // evenly over all of them

}  // namespace

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Sum over stretches of squared inner products; `shift` later in the second one, round about.
double squares_of_stretches(const VectorXd& a, const VectorXd& b, Index shift) {
  const Index n = a.size(), length = std::max<Index>(1, n / kStretches);
  double sum = 0;
  for (Index from = 0; from < n; from += length) {
    double own = 0;
    for (Index k = from; k < std::min(from + length, n); ++k) own += a[k] * b[(k + shift) % n];
    sum += own * own;
  }
  return sum;
}

}  // namespace

bool SandwichTest::refutes() const { return here > kFarLarger * elsewhere; }

SandwichTest sandwich_test(const EvidenceSystem& system, const JointColumns& whitened,
                           const VectorXd& coefficients) {
  SandwichTest scatter;
  for (const int joint : whitened.joints) {
    const VectorXd explained = system.left_of(whitened, joint) * coefficients;
    const VectorXd left = system.rest(joint) - explained;
    scatter.squares += explained.squaredNorm();
    scatter.here += squares_of_stretches(explained, left, 0);
    for (Index i = 1; i <= kOtherTimes; ++i) {
      const Index shift = i * left.size() / (kOtherTimes + 1);
      scatter.elsewhere += squares_of_stretches(explained, left, shift) / kOtherTimes;
    }
  }
  return scatter;
}

bool scatter_refutes(const EffectRecordings& data, EffectSignals& signals,
                     const EvidenceSystem& system, const Hypothesis& hypothesis,
                     const EffectInstance& trial) {
  if (hypothesis.windowed) return false;
  const JointColumns columns = hypothesis_columns(data, signals, system, hypothesis, trial);
  const Score score = score_of(system.products(columns, false), false);
  return sandwich_test(system, columns, score.coefficients).refutes();
}

}  // namespace dyngen::runtime
