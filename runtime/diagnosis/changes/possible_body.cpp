// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/possible_body.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kSteps = 200;              // of a search
constexpr double kSettled = 1e-4;        // fall of chi-square at which it ends: no name turns on it
constexpr double kFree = 1e-3;           // damping of steps that are hardly shortened
constexpr double kGap = 1e-6;            // of chi-square, above the least of bodies that can exist
constexpr double kNewtonSettled = 1e-6;  // of what holds bodies inside: 4 is its scale

/// Tensor about the origin and first moments of a pseudo-inertia matrix [Sigma h; h' m].
BodyVector body_of(const Matrix4d& J) {
  BodyVector x;
  x << J(1, 1) + J(2, 2), -J(0, 1), -J(0, 2), J(0, 0) + J(2, 2), -J(1, 2), J(0, 0) + J(1, 1),
      J(0, 3), J(1, 3), J(2, 3), J(3, 3);
  return x;
}

Matrix4d pseudo_inertia_of(const BodyVector& x) {
  const double half = 0.5 * (x[0] + x[3] + x[5]);
  Matrix4d J;
  J << half - x[0], -x[1], -x[2], x[6], -x[1], half - x[3], -x[4], x[7], -x[2], -x[4], half - x[5],
      x[8], x[6], x[7], x[8], x[9];
  return J;
}

struct MappedBody {
  BodyVector x;
  MatrixXd slope;  // (10 x unknowns)
};
using BodyMap = std::function<MappedBody(const VectorXd& unknowns)>;

/// Levenberg and Marquardt on chi-square over bodies that a map gives.
VectorXd least_chi_square(const BodyEvidence& evidence, const BodyMap& map, VectorXd unknowns) {
  double damping = 1e-3;
  MappedBody here = map(unknowns);
  double best = evidence.chi_square(here.x);
  for (int step = 0; step < kSteps; ++step) {
    const MatrixXd H = here.slope.transpose() * evidence.G * here.slope;
    const VectorXd slope = here.slope.transpose() * (evidence.b - evidence.G * here.x);
    MatrixXd damped = H;
    const double least = 1e-12 * std::max(H.trace(), 1e-300);
    damped.diagonal() += damping * H.diagonal().cwiseMax(least);
    const VectorXd trial = unknowns + damped.ldlt().solve(slope);
    const MappedBody there = map(trial);
    const double now = evidence.chi_square(there.x);
    if (now < best) {
      // a step that damping shortened says nothing of what is left
      const bool settled = best - now < kSettled && damping <= kFree;
      unknowns = trial;
      here = there;
      best = now;
      damping = std::max(1e-12, damping / 5);
      if (settled) break;
    } else {
      damping *= 4;
      if (damping > 1e10) break;
    }
  }
  return unknowns;
}

/// Chi-square of bodies inside the cone, over a weight, less what holds them inside: the logarithm
/// of the determinant, and a trace that holds what is not seen.
class BarrierFunction {
 public:
  BarrierFunction(const BodyEvidence& evidence, double sign, double size)
      : evidence_(evidence), sign_(sign), size_(size) {
    for (Index i = 0; i < kBodyParameters; ++i) {
      units_.push_back(pseudo_inertia_of(BodyVector::Unit(i)));
    }
  }

  /// @return infinity outside of the cone
  [[nodiscard]] double at(const BodyVector& x, double weight) const {
    const Matrix4d J = pseudo_inertia_of(x);
    const Eigen::LLT<Matrix4d> factor(J);
    if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    const Matrix4d L = factor.matrixL();
    return evidence_.chi_square(sign_ * x) / weight - 2 * L.diagonal().array().log().sum() +
           J.trace() / size_;
  }

  /// Newton's method with a shortened step. @return x, inside the cone as at the beginning
  [[nodiscard]] BodyVector least(BodyVector x, double weight) const {
    double here = at(x, weight);
    for (int step = 0; step < kSteps; ++step) {
      const Matrix4d inverse = pseudo_inertia_of(x).inverse();
      BodyVector slope = (2 / weight) * (evidence_.G * x - sign_ * evidence_.b);
      BodyMatrix curvature = (2 / weight) * evidence_.G;
      for (Index i = 0; i < kBodyParameters; ++i) {
        const Matrix4d own = inverse * units_[static_cast<std::size_t>(i)];
        slope[i] += units_[static_cast<std::size_t>(i)].trace() / size_ - own.trace();
        for (Index k = 0; k <= i; ++k) {
          const double part = (own * inverse * units_[static_cast<std::size_t>(k)]).trace();
          curvature(i, k) += part;
          if (k < i) curvature(k, i) += part;
        }
      }
      const BodyVector direction = -MatrixXd(curvature).ldlt().solve(slope);
      const double fall = -slope.dot(direction);  // twice what the whole step takes away
      if (!(fall > kNewtonSettled)) break;
      constexpr double kExpectedPart = 0.25;  // of the expected fall, that a step must have
      double length = 1;
      double there = at(x + direction, weight);
      while (!(there <= here - kExpectedPart * length * fall) && length > 1e-10) {
        length /= 2;
        there = at(x + length * direction, weight);
      }
      if (!(there < here)) break;
      x += length * direction;
      here = there;
    }
    return x;
  }

 private:
  const BodyEvidence& evidence_;
  double sign_, size_;
  std::vector<Matrix4d> units_;
};

/// Chi-square is convex over the cone: a path inside it ends within kGap of the least.
/// Source: Boyd and Vandenberghe, "Convex optimization", 2004, sections 11.2 and 11.3.
BodyVector best_inside(const BodyEvidence& evidence, double sign, const Matrix4d& start) {
  const BarrierFunction barrier(evidence, sign, start.trace());
  BodyVector x = body_of(start);
  constexpr double kSmaller = 0.1;  // from one weight to the next
  const double last = kGap / 5;     // 4 of the determinant, 1 of the trace
  double weight = std::max(last, std::abs(evidence.chi_square(sign * x)));
  while (true) {
    x = barrier.least(x, weight);
    if (weight <= last) return x;
    weight = std::max(last, kSmaller * weight);
  }
}

/// Evidence of parameters in units in which each has a chi-square of its own.
struct Scaled {
  BodyEvidence evidence;
  BodyVector unit;
};

/// One length and one mass scale all ten, so that bodies that can exist stay such.
Scaled scaled(const BodyEvidence& evidence) {
  const auto size = [&](std::initializer_list<int> places) {
    double sum = 0;
    for (const int p : places) sum += evidence.G(p, p);
    return std::sqrt(sum);
  };
  const double tensor = size({0, 1, 2, 3, 4, 5}), moment = size({6, 7, 8}), mass = size({9});
  double length = 1;
  if (moment > 0 && tensor > 0) {
    length = moment / tensor;
  } else if (moment > 0 && mass > 0) {
    length = mass / moment;
  }
  const double per_mass = std::max({tensor * length * length, moment * length, mass, 1e-300});
  Scaled result;
  result.unit << BodyVector::Constant(1 / per_mass);
  result.unit.head<6>() *= length * length;
  result.unit.segment<3>(6) *= length;
  result.evidence.G = result.unit.asDiagonal() * evidence.G * result.unit.asDiagonal();
  result.evidence.b = result.unit.asDiagonal() * evidence.b;
  return result;
}

/// A pseudo-inertia matrix inside the cone, near ten numbers: small and negative eigenvalues cut
/// off.
Matrix4d start_of(const BodyVector& x) {
  constexpr double kInside = 1e-3;  // of the largest eigenvalue
  const Eigen::SelfAdjointEigenSolver<Matrix4d> eigen(pseudo_inertia_of(x));
  const double most = std::max(eigen.eigenvalues().cwiseAbs().maxCoeff(), 1e-12);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(kInside * most).asDiagonal() *
         eigen.eigenvectors().transpose();
}

BodyVector any_numbers(const BodyEvidence& evidence) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(1e-10);
  solver.compute(evidence.G);
  return solver.solve(evidence.b);
}

}  // namespace

PossibleBody possible_body(const BodyEvidence& given) {
  const Scaled own = scaled(given);
  const BodyVector free = any_numbers(own.evidence);
  const double least = own.evidence.chi_square(free);
  PossibleBody best;
  best.worse = -least;
  for (const double sign : {1.0, -1.0}) {
    const BodyVector x = sign * best_inside(own.evidence, sign, start_of(sign * free));
    const double worse = own.evidence.chi_square(x) - least;
    if (worse >= best.worse) continue;
    best.worse = worse;
    best.parameters = own.unit.asDiagonal() * x;
  }
  best.worse = std::max(0.0, best.worse);
  return best;
}

BodyVector PointMass::parameters() const {
  const Vector3d& c = place;
  BodyVector x;
  x << c[1] * c[1] + c[2] * c[2], -c[0] * c[1], -c[0] * c[2], c[0] * c[0] + c[2] * c[2],
      -c[1] * c[2], c[0] * c[0] + c[1] * c[1], c[0], c[1], c[2], 1;
  return mass * x;
}

Eigen::Matrix<double, kBodyParameters, 4> PointMass::tangents() const {
  const Vector3d& c = place;
  Eigen::Matrix<double, kBodyParameters, 4> slope;
  slope.col(0) = PointMass{1, place}.parameters();
  const double m = mass;
  slope.col(1) << 0, -m * c[1], -m * c[2], 2 * m * c[0], 0, 2 * m * c[0], m, 0, 0, 0;
  slope.col(2) << 2 * m * c[1], -m * c[0], 0, 0, -m * c[2], 2 * m * c[1], 0, m, 0, 0;
  slope.col(3) << 2 * m * c[2], 0, -m * c[0], 2 * m * c[2], -m * c[1], 0, 0, 0, m, 0;
  return slope;
}

PointMass point_mass(const BodyEvidence& given, const BodyVector& start) {
  const Scaled own = scaled(given);
  const BodyVector x = own.unit.cwiseInverse().asDiagonal() * start;
  const auto map = [](const VectorXd& at) {
    const PointMass mass{at[0], at.tail<3>()};
    return MappedBody{mass.parameters(), mass.tangents()};
  };
  VectorXd best = VectorXd::Zero(4);
  double least = 0;
  // where the mass is not seen, it is anything: several starts
  for (const double mass : {x[9], 0.3 * x[9], 3 * x[9]}) {
    if (mass == 0) continue;
    VectorXd at(4);
    at << mass, x.segment<3>(6) / mass;
    at = least_chi_square(own.evidence, map, at);
    const double now = own.evidence.chi_square(map(at).x);
    if (now < least) {
      least = now;
      best = at;
    }
  }
  // mass in units of M, length in units of MX over those of M
  const double length = own.unit[6] / own.unit[9];
  return {best[0] * own.unit[9], best.tail<3>() * length};
}

}  // namespace dyngen::runtime
