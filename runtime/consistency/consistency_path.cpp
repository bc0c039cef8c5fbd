// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistency_path.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "runtime/consistency/linearised_cost.h"
#include "runtime/consistency/log_cholesky_map.h"

namespace dyngen::runtime {
namespace {

constexpr int kMostIterations = 100;  // usually 12 to 30
constexpr double kOfTheWay = 0.95;    // to the edge of consistency: at most this part in a step
constexpr double kNear = 1e-6;        // squared step / w at which Newton's method goes on
constexpr double kBoundGap = 1e-6;    // a y / w of what is told to be at its bound, or not

/// A point of the search: S and Z, a and y are both positive (definite).
struct PrimalDual {
  ScaledParameters primal;
  std::vector<Eigen::Matrix4d> Z;  ///< (links) multipliers of S
  Eigen::VectorXd y;               ///< (na) multipliers of a; 1 and not read where it may be < 0
};

/// The scaling of Nesterov and Todd: G' Z G = G^-1 S G^-T = diag(lambda).
struct Scaling {
  Eigen::Matrix4d G, inverse;
  Eigen::Vector4d lambda;
};

Scaling scaling_of(const Eigen::Matrix4d& S, const Eigen::Matrix4d& Z) {
  const Eigen::Matrix4d L = S.llt().matrixL(), R = Z.llt().matrixL();
  const Eigen::Matrix4d product = R.transpose() * L;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(product, Eigen::ComputeFullV);
  const Eigen::Vector4d root = svd.singularValues().cwiseSqrt();
  const Eigen::Matrix4d V = svd.matrixV();
  return {L * V * root.cwiseInverse().asDiagonal(),
          root.asDiagonal() * V.transpose() *
              L.triangularView<Eigen::Lower>().solve(Eigen::Matrix4d::Identity()),
          svd.singularValues()};
}

/// Largest part, up to 1, of a step that a positive matrix with this relative change may go.
double part_of_step(const Eigen::Matrix4d& scaled_change, const Eigen::Vector4d& lambda) {
  const Eigen::Vector4d root = lambda.cwiseSqrt().cwiseInverse();
  const Eigen::Matrix4d relative = root.asDiagonal() * scaled_change * root.asDiagonal();
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(relative, Eigen::EigenvaluesOnly)
          .eigenvalues()[0];
  return least < 0 ? std::min(1.0, kOfTheWay / -least) : 1.0;
}

double part_of_step(double value, double change) {
  return change < 0 ? std::min(1.0, kOfTheWay * value / -change) : 1.0;
}

/// Means of the eigenvalues of S Z and of a y: w and 0 at the end.
struct Products {
  double S = 0, a = 0;
};

Products mean_products(const ConsistencyCost& cost, const PrimalDual& at) {
  Products mean;
  for (std::size_t link = 0; link < at.Z.size(); ++link) {
    mean.S += at.primal.S[link].cwiseProduct(at.Z[link]).sum() / (4 * cost.links);
  }
  int count = 0;
  for (int k = 0; k < cost.actuators(); ++k) {
    if (!cost.nonnegative[static_cast<std::size_t>(k)]) continue;
    mean.a += at.primal.actuators[k] * at.y[k];
    ++count;
  }
  if (count > 0) mean.a /= count;
  return mean;
}

/// A linear system whose right side tells where the step shall end.
class SearchStep {
 public:
  SearchStep(const ConsistencyCost& cost, const PrimalDual& at) : cost_(cost), at_(at) {
    const Eigen::Index nb = cost.A.rows(), inertial = cost.inertial_size(), na = cost.actuators();
    linear_ = linearise_data(cost, at.primal, nb + inertial + 2 * na);
    for (int link = 0; link < cost.links; ++link) {
      const auto place = static_cast<std::size_t>(link);
      scalings_.push_back(scaling_of(at.primal.S[place], at.Z[place]));
      write_cone_rows(linear_, nb + 10 * link, link, 0.5, scalings_.back().inverse,
                      Eigen::Matrix4d::Zero());
    }
    write_actuator_rows(linear_, nb + inertial, cost, at.primal);
    for (Eigen::Index k = 0; k < na; ++k) {
      if (!cost.nonnegative[static_cast<std::size_t>(k)]) continue;
      linear_.rows(nb + inertial + na + k, inertial + k) =
          std::sqrt(at.y[k] / at.primal.actuators[k] / 2);
    }
    qr_.compute(linear_.rows);
    dS_.assign(scalings_.size(), Eigen::Matrix4d::Zero());
    dZ_ = dS_;
    da_ = dy_ = Eigen::VectorXd::Zero(na);
  }

  /// Solves for S Z = ends.S, a y = ends.a; what was found before, gone `bend` of it, is the guess
  /// of the second order.
  void solve(const Products& ends, double bend) {
    const Eigen::Index nb = cost_.A.rows(), inertial = cost_.inertial_size(),
                       na = cost_.actuators();
    std::vector<Eigen::Matrix4d> sums;  // of dS and dZ, in scaled axes
    for (std::size_t link = 0; link < scalings_.size(); ++link) {
      const Scaling& scaling = scalings_[link];
      const Eigen::Matrix4d product = bend * bend * dS_[link] * dZ_[link];
      Eigen::Matrix4d sum = -(product + product.transpose()) / 2;
      sum.diagonal().array() += ends.S - scaling.lambda.array().square();
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) sum(i, j) *= 2 / (scaling.lambda[i] + scaling.lambda[j]);
      }
      Eigen::Matrix4d gradient = cost_.weight * scaling.G.transpose() * scaling.G - sum;
      gradient.diagonal() -= scaling.lambda;
      const auto first = static_cast<Eigen::Index>(10 * link);
      linear_.residual.segment<10>(nb + first) = cone_residual(0.5, gradient);
      sums.push_back(sum);
    }
    Eigen::VectorXd ends_of_y = Eigen::VectorXd::Zero(na);  // y + dy if da were 0
    for (Eigen::Index k = 0; k < na; ++k) {
      if (!cost_.nonnegative[static_cast<std::size_t>(k)]) continue;
      const double a = at_.primal.actuators[k];
      ends_of_y[k] = (ends.a - bend * bend * da_[k] * dy_[k]) / a;
      linear_.residual[nb + inertial + na + k] = -ends_of_y[k] * std::sqrt(a / at_.y[k] / 2);
    }
    dx_ = qr_.solve(-linear_.residual);
    for (std::size_t link = 0; link < scalings_.size(); ++link) {
      const Scaling& scaling = scalings_[link];
      dS_[link] = scaling.inverse *
                  log_cholesky_map::from_upper_elements<double>(
                      dx_.segment<10>(static_cast<Eigen::Index>(10 * link))) *
                  scaling.inverse.transpose();
      dZ_[link] = sums[link] - dS_[link];
    }
    da_ = dx_.tail(na);
    for (Eigen::Index k = 0; k < na; ++k) {
      if (!cost_.nonnegative[static_cast<std::size_t>(k)]) continue;
      dy_[k] = ends_of_y[k] - at_.y[k] - at_.y[k] * da_[k] / at_.primal.actuators[k];
    }
  }

  [[nodiscard]] bool is_finite() const { return dx_.allFinite(); }

  /// How far it may be gone, up to 1.
  [[nodiscard]] double part() const {
    double part = 1;
    for (std::size_t link = 0; link < scalings_.size(); ++link) {
      part = std::min({part, part_of_step(dS_[link], scalings_[link].lambda),
                       part_of_step(dZ_[link], scalings_[link].lambda)});
    }
    for (Eigen::Index k = 0; k < cost_.actuators(); ++k) {
      if (!cost_.nonnegative[static_cast<std::size_t>(k)]) continue;
      part = std::min(
          {part, part_of_step(at_.primal.actuators[k], da_[k]), part_of_step(at_.y[k], dy_[k])});
    }
    return part;
  }

  /// Squared length in the inertias, of the order of w where the step is of the order of S.
  [[nodiscard]] double squared_length() const {
    double sum = 0;
    for (std::size_t link = 0; link < dS_.size(); ++link) {
      sum += dS_[link].squaredNorm() + dZ_[link].squaredNorm();
    }
    return sum;
  }

  [[nodiscard]] PrimalDual end(double part) const {
    PrimalDual to{moved(at_.primal, dx_, part), at_.Z, at_.y + part * dy_};
    for (std::size_t link = 0; link < dZ_.size(); ++link) {
      const Eigen::Matrix4d& inverse = scalings_[link].inverse;
      to.Z[link] += part * inverse.transpose() * dZ_[link] * inverse;
    }
    return to;
  }

 private:
  const ConsistencyCost& cost_;
  const PrimalDual& at_;
  LinearisedCost linear_;
  std::vector<Scaling> scalings_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  Eigen::VectorXd dx_, da_, dy_;
  std::vector<Eigen::Matrix4d> dS_, dZ_;  // in scaled axes
};

/// The central path to near its end.
PrimalDual approach(const ConsistencyCost& cost, int& iterations) {
  PrimalDual at{at_prior(cost), {}, Eigen::VectorXd::Ones(cost.actuators())};
  const Eigen::VectorXd slope = 2 * cost.A.transpose() * (cost.A * stacked(at.primal) - cost.b);
  double centre = std::max(cost.weight, slope.cwiseAbs().maxCoeff());
  at.Z.assign(at.primal.S.size(), centre * Eigen::Matrix4d::Identity());
  for (int k = 0; k < cost.actuators(); ++k) {
    if (!cost.nonnegative[static_cast<std::size_t>(k)]) continue;
    at.primal.actuators[k] = std::max(at.primal.actuators[k], 1.0);
    at.y[k] = centre / at.primal.actuators[k];
  }
  const Products end{cost.weight, kBoundGap * cost.weight};
  for (int iteration = 0; iteration < kMostIterations; ++iteration, ++iterations) {
    SearchStep step(cost, at);
    step.solve(end, 0);
    if (!step.is_finite()) break;
    // Mehrotra's rule: the less of the step to the end is possible, the more it is centred.
    const double possible = step.part();
    const double blocked = std::pow(1 - possible * possible, 3);
    const Products mean = mean_products(cost, at);
    step.solve({std::max(end.S, end.S + blocked * (mean.S - end.S)),
                std::max(end.a, end.a + blocked * (mean.a - end.a))},
               possible);
    if (!step.is_finite()) break;
    const double part = step.part(), length = step.squared_length();
    at = step.end(part);
    if (part > 0.5 && length < kNear * cost.weight && mean.a < 10 * end.a) break;
  }
  return at;
}

}  // namespace

NewtonResult follow_path(const ConsistencyCost& cost) {
  int iterations = 0;
  PrimalDual near = approach(cost, iterations);
  std::vector<bool> at_zero(cost.places.size(), false);
  for (int k = 0; k < cost.actuators(); ++k) {
    double& value = near.primal.actuators[k];
    if (!cost.nonnegative[static_cast<std::size_t>(k)] || value > near.y[k] / cost.weight) continue;
    value = 0;
    at_zero[static_cast<std::size_t>(k)] = true;
  }
  NewtonResult result = minimise_by_newton(cost, near.primal, at_zero);
  result.iterations += iterations;
  return result;
}

}  // namespace dyngen::runtime
