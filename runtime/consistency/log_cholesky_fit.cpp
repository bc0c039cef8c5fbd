// SPDX-License-Identifier: MIT
#include "runtime/consistency/log_cholesky_fit.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/cost_function.h>
#include <ceres/jet.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "runtime/consistency/log_cholesky_map.h"
#include "runtime/consistency/pseudo_inertia.h"

namespace dyngen::runtime {
namespace {

constexpr int kCoordinates = 10;
constexpr int kLogarithms = 4;  // alpha, d1, d2, d3 stand first
constexpr int kMaxRounds = 20;

using Jacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // as Ceres has it

/// A x - b; blocks: theta of each link, actuators.
class DataResidual : public ceres::CostFunction {
 public:
  explicit DataResidual(const ConsistencyCost& cost) : cost_(cost) {
    set_num_residuals(static_cast<int>(cost.A.rows()));
    for (int link = 0; link < cost.links; ++link) {
      mutable_parameter_block_sizes()->push_back(kCoordinates);
    }
    if (cost.actuators() > 0) mutable_parameter_block_sizes()->push_back(cost.actuators());
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Jet = ceres::Jet<double, kCoordinates>;
    Eigen::VectorXd x(cost_.A.cols());
    for (int link = 0; link < cost_.links; ++link) {
      log_cholesky_map::Ten<Jet> theta;
      for (int k = 0; k < kCoordinates; ++k) theta[k] = Jet(blocks[link][k], k);
      const auto S = log_cholesky_map::upper_elements<Jet>(
          log_cholesky_map::square<Jet>(log_cholesky_map::factor<Jet>(theta)));
      Eigen::Matrix<double, kCoordinates, kCoordinates> dS;
      for (int k = 0; k < kCoordinates; ++k) {
        x[kCoordinates * link + k] = S[k].a;
        dS.row(k) = S[k].v.transpose();
      }
      if (jacobians != nullptr && jacobians[link] != nullptr) {
        Eigen::Map<Jacobian>(jacobians[link], cost_.A.rows(), kCoordinates) =
            cost_.A.middleCols<kCoordinates>(kCoordinates * link) * dS;
      }
    }
    const int na = cost_.actuators();
    if (na > 0) {
      x.tail(na) = Eigen::Map<const Eigen::VectorXd>(blocks[cost_.links], na);
      if (jacobians != nullptr && jacobians[cost_.links] != nullptr) {
        Eigen::Map<Jacobian>(jacobians[cost_.links], cost_.A.rows(), na) = cost_.A.rightCols(na);
      }
    }
    Eigen::Map<Eigen::VectorXd>(residuals, cost_.A.rows()) = cost_.A * x - cost_.b;
    return x.allFinite();
  }

 private:
  const ConsistencyCost& cost_;
};

/// g(u) with g^2 = exp(2 u) - 2 u - 1 and the sign of u: smooth also where u = 0.
template <typename T>
T root_of_divergence(const T& u) {
  using std::exp;
  using std::sqrt;
  if (u > T(1) || u < T(-1)) {
    const T root = sqrt(exp(2.0 * u) - 2.0 * u - 1.0);
    return u > T(0) ? root : T(-root);
  }
  // exp(2 u) - 2 u - 1 = 2 u^2 (1 + 2u/3 (1 + 2u/4 (1 + 2u/5 ...))); 30 terms: 2^30 / 30! < 1e-22
  T series(1);
  for (int n = 32; n >= 3; --n) series = 1.0 + series * u * (2.0 / n);
  return u * sqrt(2.0 * series);
}

/// sqrt(w) times ten residuals, the sum of whose squares is D(V V' || 1).
struct DivergenceResidual {
  double root_weight;

  template <typename T>
  bool operator()(const T* theta, T* residuals) const {
    const log_cholesky_map::Ten<T> coordinates = Eigen::Map<const log_cholesky_map::Ten<T>>(theta);
    const auto V = log_cholesky_map::factor<T>(coordinates);
    int place = 0;
    for (int i = 0; i < 4; ++i) {
      const T u = i < 3 ? T(theta[0] + theta[1 + i]) : theta[0];
      residuals[place++] = root_weight * root_of_divergence(u);
      for (int j = i + 1; j < 4; ++j) residuals[place++] = root_weight * V(i, j);
    }
    return true;
  }
};

/// sqrt(w) (a - a0)
class ActuatorResidual : public ceres::CostFunction {
 public:
  explicit ActuatorResidual(const ConsistencyCost& cost) : cost_(cost) {
    set_num_residuals(cost.actuators());
    mutable_parameter_block_sizes()->push_back(cost.actuators());
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int na = cost_.actuators();
    const double root_weight = std::sqrt(cost_.weight);
    Eigen::Map<Eigen::VectorXd>(residuals, na) =
        root_weight * (Eigen::Map<const Eigen::VectorXd>(blocks[0], na) - cost_.prior);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Jacobian>(jacobians[0], na, na) = root_weight * Eigen::MatrixXd::Identity(na, na);
    }
    return true;
  }

 private:
  const ConsistencyCost& cost_;
};

/// A parameter block, its lower bounds, and which of its entries are held at them.
struct Block {
  std::vector<double> values;
  std::vector<double> lower;  // -inf: none
  std::vector<bool> held;
};

Block make_block(const double* values, int size) {
  const auto count = static_cast<std::size_t>(size);
  Block block;
  block.values.assign(values, values + size);
  block.lower.assign(count, -std::numeric_limits<double>::infinity());
  block.held.assign(count, false);
  return block;
}

std::vector<Block> make_blocks(const ConsistencyCost& cost, double floor,
                               const ScaledParameters& start) {
  std::vector<Block> blocks;
  for (const Eigen::Matrix4d& S : start.S) {
    const LogCholesky theta = log_cholesky(S);
    blocks.push_back(make_block(theta.data(), kCoordinates));
    std::fill_n(blocks.back().lower.begin(), kLogarithms, std::log(floor));
  }
  if (cost.actuators() > 0) {
    blocks.push_back(make_block(start.actuators.data(), cost.actuators()));
    for (std::size_t k = 0; k < cost.nonnegative.size(); ++k) {
      if (cost.nonnegative[k]) blocks.back().lower[k] = 0;
    }
  }
  for (Block& block : blocks) {
    for (std::size_t k = 0; k < block.values.size(); ++k) {
      block.values[k] = std::max(block.values[k], block.lower[k]);
    }
  }
  return blocks;
}

/// Tells Ceres which entries are constant in the next round.
void set_constant_entries(ceres::Problem& problem, Block& block) {
  std::vector<int> constant;
  for (std::size_t k = 0; k < block.held.size(); ++k) {
    if (block.held[k]) constant.push_back(static_cast<int>(k));
  }
  double* values = block.values.data();
  problem.SetManifold(values, nullptr);
  problem.SetParameterBlockVariable(values);
  if (constant.size() == block.values.size()) {
    problem.SetParameterBlockConstant(values);
  } else if (!constant.empty()) {
    problem.SetManifold(values,
                        new ceres::SubsetManifold(static_cast<int>(block.values.size()), constant));
  }
}

/// Holds what is at its bound and pushes against it, frees what wants back. Returns whether
/// anything has changed.
bool update_held(ceres::Problem& problem, std::vector<Block>& blocks) {
  for (Block& block : blocks) {  // the gradient of all entries is wanted
    problem.SetManifold(block.values.data(), nullptr);
    problem.SetParameterBlockVariable(block.values.data());
  }
  ceres::Problem::EvaluateOptions options;
  for (Block& block : blocks) options.parameter_blocks.push_back(block.values.data());
  std::vector<double> gradient;
  problem.Evaluate(options, nullptr, nullptr, &gradient, nullptr);
  bool changed = false;
  std::size_t place = 0;
  for (Block& block : blocks) {
    for (std::size_t k = 0; k < block.values.size(); ++k, ++place) {
      const bool hold = block.values[k] <= block.lower[k] && gradient[place] > 0;
      changed = changed || hold != block.held[k];
      block.held[k] = hold;
    }
    set_constant_entries(problem, block);
  }
  return changed;
}

ScaledParameters read_blocks(const ConsistencyCost& cost, const std::vector<Block>& blocks) {
  ScaledParameters parameters;
  for (int link = 0; link < cost.links; ++link) {
    parameters.S.push_back(from_log_cholesky(
        Eigen::Map<const LogCholesky>(blocks[static_cast<std::size_t>(link)].values.data())));
  }
  parameters.actuators.resize(cost.actuators());
  if (cost.actuators() > 0) {
    std::copy(blocks.back().values.begin(), blocks.back().values.end(),
              parameters.actuators.begin());
  }
  return parameters;
}

}  // namespace

LogCholeskyFit fit_log_cholesky(const ConsistencyCost& cost, const ConsistencyOptions& options,
                                const ScaledParameters& start) {
  std::vector<Block> blocks = make_blocks(cost, options.floor, start);
  ceres::Problem problem;  // owns the residuals and manifolds
  std::vector<double*> all;
  for (Block& block : blocks) {
    all.push_back(block.values.data());
    problem.AddParameterBlock(all.back(), static_cast<int>(block.values.size()));
    for (std::size_t k = 0; k < block.values.size(); ++k) {
      if (std::isfinite(block.lower[k])) {
        problem.SetParameterLowerBound(all.back(), static_cast<int>(k), block.lower[k]);
      }
    }
  }
  problem.AddResidualBlock(new DataResidual(cost), nullptr, all);
  for (int link = 0; link < cost.links; ++link) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<DivergenceResidual, kCoordinates, kCoordinates>(
            new DivergenceResidual{std::sqrt(cost.weight)}),
        nullptr, all[static_cast<std::size_t>(link)]);
  }
  if (cost.actuators() > 0) {
    problem.AddResidualBlock(new ActuatorResidual(cost), nullptr, all.back());
  }

  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.max_num_consecutive_invalid_steps = 50;
  solver.initial_trust_region_radius = 1e8;  // badly known directions must not be damped away
  solver.function_tolerance = 1e-14;
  solver.parameter_tolerance = 1e-14;
  solver.gradient_tolerance = 1e-14;
  solver.logging_type = ceres::SILENT;

  LogCholeskyFit fit;
  bool changed = update_held(problem, blocks);
  for (int round = 0; round < kMaxRounds && (round == 0 || changed); ++round) {
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    fit.iterations += static_cast<int>(summary.iterations.size());
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
    fit.message = fit.converged ? "" : summary.message;
    changed = update_held(problem, blocks);
  }
  if (changed) {
    fit.converged = false;
    fit.message = "the set of active bounds did not settle";
  }
  fit.parameters = read_blocks(cost, blocks);
  for (int link = 0; link < cost.links; ++link) {
    const std::vector<bool>& held = blocks[static_cast<std::size_t>(link)].held;
    if (std::find(held.begin(), held.end(), true) != held.end()) fit.at_floor.push_back(link + 1);
  }
  if (cost.actuators() > 0) fit.at_zero = blocks.back().held;
  return fit;
}

}  // namespace dyngen::runtime
