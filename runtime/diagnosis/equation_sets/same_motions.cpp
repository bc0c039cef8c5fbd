// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/same_motions.h"

#include <cmath>

#include "runtime/recordings/motion_mismatch.h"
#include "runtime/signals/interpolation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool comparable(const Motion& a, const Motion& b, const EquationRules& rules) {
  if (a.period > 0 || b.period > 0) return false;
  const auto samples = static_cast<double>(std::min(a.samples(), b.samples()));
  return std::abs(a.sample_time - b.sample_time) * samples < rules.period_mismatch * a.sample_time;
}

/// The first motion of each group, and where a motion stands in it.
struct Place {
  std::size_t first = 0;
  double lag = 0;  ///< s: time t of the motion is t + lag of the first one
};

std::vector<Place> places_of(const std::vector<std::optional<EarlierRun>>& earlier) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    if (!earlier[i]) {
      places.push_back({i, 0});
    } else {
      const Place& before = places[earlier[i]->run];
      places.push_back({before.first, before.lag + earlier[i]->lag});
    }
  }
  return places;
}

/// Adds rows of another motion where it has them. @param lag  samples: row k is the other's row k +
/// lag
void add(const MatrixXd& other, double lag, MatrixXd& sum, VectorXd& count) {
  const auto whole = static_cast<Index>(std::llround(lag));
  const double part = lag - static_cast<double>(whole);
  MatrixXd moved(other.rows(), other.cols());
  for (Index j = 0; j < other.cols(); ++j) moved.col(j) = shifted(other.col(j), part);
  const Index reach = part == 0 ? 0 : kSincReach;
  for (Index k = 0; k < sum.rows(); ++k) {
    const Index at = k + whole;
    if (at < reach || at >= other.rows() - reach) continue;
    sum.row(k) += moved.row(at);
    count[k] += 1;
  }
}

MatrixXd mean_or(const MatrixXd& own, const MatrixXd& sum, const VectorXd& count) {
  MatrixXd mean = own;
  for (Index k = 0; k < own.rows(); ++k) {
    if (count[k] > 0) mean.row(k) = sum.row(k) / count[k];
  }
  return mean;
}

}  // namespace

std::vector<std::optional<EarlierRun>> earlier_motions(const std::vector<const Motion*>& motions,
                                                       const EquationRules& rules) {
  std::vector<std::optional<EarlierRun>> earlier(motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (std::size_t other = i; other-- > 0 && !earlier[i];) {
      if (!comparable(*motions[i], *motions[other], rules)) continue;
      const SameMotion same = compare_motions(motions[other]->q, motions[i]->q);
      if (same.mismatch <= kJustRepeats)
        earlier[i] = EarlierRun{other, same.lag * motions[i]->sample_time};
    }
  }
  return earlier;
}

void find_same_motions(EffectRecordings& data, const EquationRules& rules) {
  std::vector<const Motion*> motions;
  for (const EffectRun& run : data.runs) motions.push_back(&run.motion);
  const auto earlier = earlier_motions(motions, rules);
  for (std::size_t r = 0; r < earlier.size(); ++r) data.runs[r].earlier = earlier[r];
}

std::vector<std::optional<Motion>> of_same_motions(const std::vector<const Motion*>& motions,
                                                   const EquationRules& rules) {
  const std::vector<Place> places = places_of(earlier_motions(motions, rules));
  std::vector<std::optional<Motion>> result(motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    std::vector<std::size_t> others;
    for (std::size_t m = 0; m < motions.size(); ++m) {
      if (m != i && places[m].first == places[i].first) others.push_back(m);
    }
    if (static_cast<double>(others.size() + 1) < rules.fewest_periods || others.empty()) continue;
    Motion mean = *motions[i];
    for (MatrixXd Motion::*part : {&Motion::q, &Motion::dq, &Motion::ddq}) {
      MatrixXd sum = MatrixXd::Zero(mean.samples(), (mean.*part).cols());
      VectorXd count = VectorXd::Zero(mean.samples());
      for (const std::size_t m : others) {
        add(motions[m]->*part, (places[i].lag - places[m].lag) / mean.sample_time, sum, count);
      }
      mean.*part = mean_or(mean.*part, sum, count);
    }
    result[i] = std::move(mean);
  }
  return result;
}

}  // namespace dyngen::runtime
