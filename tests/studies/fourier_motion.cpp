// SPDX-License-Identifier: MIT
#include "tests/studies/fourier_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace dyngen::test {

using Eigen::Index;
using Eigen::VectorXd;

FourierMotion::State FourierMotion::at(double time) const {
  State state{centre, VectorXd::Zero(centre.size()), VectorXd::Zero(centre.size())};
  for (std::size_t k = 0; k < frequency.size(); ++k) {
    const double w = frequency[k], s = std::sin(w * time), c = std::cos(w * time);
    const auto a = sine.col(static_cast<Index>(k)), b = cosine.col(static_cast<Index>(k));
    state.q += a * s + b * c;
    state.dq += w * (a * c - b * s);
    state.ddq -= w * w * (a * s + b * c);
  }
  return state;
}

FourierMotion random_motion(const MotionLimits& limits, double base_hz,
                            const std::vector<int>& harmonics, double seconds, unsigned seed) {
  const Index n = limits.centre.size(), terms = static_cast<Index>(harmonics.size());
  FourierMotion motion;
  motion.centre = limits.centre;
  motion.sine.resize(n, terms);
  motion.cosine.resize(n, terms);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (Index k = 0; k < terms; ++k) {
    const double w = 2 * std::numbers::pi * base_hz * harmonics[static_cast<std::size_t>(k)];
    motion.frequency.push_back(w);
    for (Index j = 0; j < n; ++j) {  // equal parts of the speed
      motion.sine(j, k) = normal(random) / w;
      motion.cosine(j, k) = normal(random) / w;
    }
  }
  VectorXd used = VectorXd::Zero(n);
  for (double time = 0; time < seconds; time += 0.01) {
    const FourierMotion::State state = motion.at(time);
    used = used.cwiseMax((state.q - motion.centre).cwiseAbs().cwiseQuotient(limits.reach));
    used = used.cwiseMax(state.dq.cwiseAbs().cwiseQuotient(limits.speed));
    used = used.cwiseMax(state.ddq.cwiseAbs().cwiseQuotient(limits.acceleration));
  }
  motion.sine = used.cwiseInverse().asDiagonal() * motion.sine;
  motion.cosine = used.cwiseInverse().asDiagonal() * motion.cosine;
  return motion;
}

}  // namespace dyngen::test
