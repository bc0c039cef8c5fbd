// SPDX-License-Identifier: MIT
#include "runtime/estimation/joint_noise.h"

#include <cmath>
#include <complex>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::VectorXd;

double JointNoise::deviation() const {
  double variance = quick.deviation * quick.deviation;
  for (const SlowNoise& part : slow) variance += part.deviation * part.deviation;
  return std::sqrt(variance);
}

double JointNoise::density(double frequency) const {
  double sum = runtime::density(quick, frequency);
  for (const SlowNoise& part : slow) sum += runtime::density(part, frequency);
  return sum;
}

std::vector<AutoregressiveNoise> JointNoise::parts() const {
  std::vector<AutoregressiveNoise> all = {quick};
  for (const SlowNoise& part : slow) {
    AutoregressiveNoise process;
    process.coefficients = VectorXd::Constant(1, part.pole);
    process.deviation = part.deviation;
    process.innovation = part.deviation * std::sqrt(1 - part.pole * part.pole);
    process.correlation_time = (1 + part.pole) / (1 - part.pole);
    all.push_back(std::move(process));
  }
  return all;
}

double density(const AutoregressiveNoise& noise, double frequency) {
  const std::complex<double> delay = std::polar(1.0, -2 * M_PI * frequency);
  std::complex<double> power = 1, response = 1;
  for (const double a : noise.coefficients) {
    power *= delay;
    response -= a * power;
  }
  return noise.innovation * noise.innovation / std::norm(response);
}

double density(const SlowNoise& noise, double frequency) {
  const double variance = noise.deviation * noise.deviation, pole = noise.pole;
  return variance * (1 - pole * pole) /
         (1 + pole * pole - 2 * pole * std::cos(2 * M_PI * frequency));
}

VectorXd autocovariance(const AutoregressiveNoise& noise, Index most) {
  // predictors of lower orders, from the highest down (Levinson-Durbin, backwards)
  const Index order = noise.coefficients.size();
  std::vector<VectorXd> predictors(static_cast<std::size_t>(order) + 1);
  VectorXd a = noise.coefficients;
  double error = noise.innovation * noise.innovation;
  for (Index p = order; p > 0; --p) {
    predictors[static_cast<std::size_t>(p)] = a;
    const double reflection = a[p - 1], left = 1 - reflection * reflection;
    VectorXd lower(p - 1);
    for (Index k = 0; k < p - 1; ++k) lower[k] = (a[k] + reflection * a[p - 2 - k]) / left;
    a = std::move(lower);
    error /= left;
  }
  VectorXd covariance = VectorXd::Zero(most + 1);
  covariance[0] = error;
  for (Index lag = 1; lag <= most; ++lag) {
    const VectorXd& own = predictors[static_cast<std::size_t>(std::min(lag, order))];
    for (Index k = 0; k < own.size(); ++k) covariance[lag] += own[k] * covariance[lag - 1 - k];
  }
  return covariance;
}

std::vector<JointNoise> quick_noise(const std::vector<AutoregressiveNoise>& joints) {
  std::vector<JointNoise> all;
  for (const AutoregressiveNoise& joint : joints) all.push_back({joint, {}});
  return all;
}

}  // namespace dyngen::runtime
