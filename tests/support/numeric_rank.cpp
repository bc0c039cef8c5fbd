// SPDX-License-Identifier: MIT
#include "tests/support/numeric_rank.h"

#include <Eigen/SVD>
#include <cstddef>
#include <random>
#include <vector>

#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

using Real = long double;
using Matrix = SquareMatrix<Real>;

constexpr Real kRankTolerance = 1e-10L;

struct State {
  std::vector<Real> q, dq, ddq;
};

/// Written out, not std::uniform_real_distribution: that differs between standard libraries.
Real uniform(std::mt19937& generator, Real bound) {
  return bound * (2 * static_cast<Real>(generator()) / static_cast<Real>(std::mt19937::max()) - 1);
}

std::vector<State> random_states(std::size_t joints, int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<State> states(static_cast<std::size_t>(count));
  for (State& state : states) {
    for (std::size_t i = 0; i < joints; ++i) {
      state.q.push_back(uniform(generator, 3.14L));
      state.dq.push_back(uniform(generator, 3));
      state.ddq.push_back(uniform(generator, 6));
    }
  }
  return states;
}

/// Rows: joints of state after state. Columns: ten per link, by unit parameters.
Matrix inertial_regressor(const NumericRobot& robot, const std::vector<State>& states) {
  const std::size_t n = robot.size();
  Matrix W(static_cast<Eigen::Index>(n * states.size()), static_cast<Eigen::Index>(10 * n));
  NumericRobot unit = robot;
  for (NumericJoint& joint : unit.joints) joint.inertial = {};
  for (std::size_t link = 0; link < n; ++link) {
    for (std::size_t k = 0; k < 10; ++k) {
      unit.joints[link].inertial[k] = 1;
      Eigen::Index row = 0;
      for (const State& state : states) {
        for (const Real tau : id_rigid(unit, state.q, state.dq, state.ddq)) {
          W(row++, static_cast<Eigen::Index>(10 * link + k)) = tau;
        }
      }
      unit.joints[link].inertial[k] = 0;
    }
  }
  return W;
}

/// Columns of IA: the joint's own acceleration, nothing for a fixed joint.
Matrix rotor_regressor(const NumericRobot& robot, const std::vector<State>& states) {
  const auto n = static_cast<Eigen::Index>(robot.size());
  Matrix W = Matrix::Zero(n * static_cast<Eigen::Index>(states.size()), n);
  Eigen::Index row = 0;
  for (const State& state : states) {
    for (Eigen::Index i = 0; i < n; ++i, ++row) {
      const auto joint = static_cast<std::size_t>(i);
      if (robot.joints[joint].sigma != 2) W(row, i) = state.ddq[joint];
    }
  }
  return W;
}

NumericRank rank(Matrix W) {
  // Columns have different units, so each is scaled to length 1; one that is only rounding noise
  // (cos of a stored right angle is 6e-17) must not be scaled up to count.
  const Real largest_column = W.colwise().norm().maxCoeff();
  for (Eigen::Index j = 0; j < W.cols(); ++j) {
    const Real length = W.col(j).norm();
    W.col(j) *= length > kRankTolerance * largest_column ? 1 / length : 0;
  }
  const Eigen::JacobiSVD<Matrix> svd(W);
  const auto& values = svd.singularValues();
  NumericRank result;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const Real ratio = values[0] > 0 ? values[k] / values[0] : 0;
    if (ratio > kRankTolerance) {
      ++result.rank;
      result.last_kept = static_cast<double>(ratio);
    } else {
      result.first_dropped = static_cast<double>(ratio);
      break;
    }
  }
  return result;
}

}  // namespace

BaseParameterRanks base_parameter_ranks(const NumericRobot& robot, int states, unsigned seed) {
  std::vector<State> samples = random_states(robot.size(), states, seed);
  const Matrix inertial = inertial_regressor(robot, samples);
  const Matrix rotor = rotor_regressor(robot, samples);
  Matrix both(inertial.rows(), inertial.cols() + rotor.cols());
  both << inertial, rotor;
  for (State& state : samples) {
    state.dq.assign(robot.size(), 0);
    state.ddq.assign(robot.size(), 0);
  }
  return {rank(inertial), rank(both), rank(inertial_regressor(robot, samples))};
}

}  // namespace dyngen::test
