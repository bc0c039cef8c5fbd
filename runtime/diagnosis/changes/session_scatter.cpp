// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/session_scatter.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/effects/effect_recordings.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Orthonormal columns that span those of X.
MatrixXd span_of(const MatrixXd& X, double* log_determinant) {
  const VectorXd norm = X.colwise().norm().transpose();
  std::vector<Index> present;
  for (Index c = 0; c < norm.size(); ++c) {
    if (norm[c] > 0) present.push_back(c);
  }
  const VectorXd scale = norm(present);
  Eigen::ColPivHouseholderQR<MatrixXd> qr(X(Eigen::all, present) *
                                          scale.cwiseInverse().asDiagonal());
  qr.setThreshold(kRoundingPart);
  const Index rank = qr.rank();
  if (log_determinant != nullptr) {
    *log_determinant = 2 * (qr.matrixR().diagonal().head(rank).cwiseAbs().array().log().sum() +
                            scale.array().log().sum());
  }
  return qr.householderQ() * MatrixXd::Identity(X.rows(), rank);
}

/// Log of the restricted likelihood, each side with parameters of its own.
double sides_likelihood(const std::vector<SessionEquations>& sessions,
                        const SessionScatter& scatter, Index common) {
  const WhitenedSessions all = whitened_sessions(sessions, scatter, 1);
  const Index rows = all.rows.rows();
  MatrixXd X = MatrixXd::Zero(rows, 2 * common);
  X.topLeftCorner(all.later_from, common) = all.rows.topLeftCorner(all.later_from, common);
  X.bottomRightCorner(rows - all.later_from, common) =
      all.rows.bottomLeftCorner(rows - all.later_from, all.rows.cols()).leftCols(common);
  double determinant = 0;
  const MatrixXd Q = span_of(X, &determinant);
  const VectorXd y = all.rows.rightCols(1);
  const VectorXd left = y - Q * (Q.transpose() * y);
  return -0.5 * (all.log_determinant + determinant + left.squaredNorm());
}

/// Of the squared factor, which the allowance centres: a scaled inverse chi-square.
double log_prior(double factor, const ChangeRules& rules) {
  const double s = factor * factor;
  return -0.5 * rules.allowance_worth * (std::log(s) + 1 / s);
}

/// How much more the halves of sessions differ than their noise says.
double inflation_of(const std::vector<SessionEquations>& sessions, Index common) {
  double squares = 0, degrees = 0;
  for (const SessionEquations& session : sessions) {
    const Index K = session.first.cols();
    MatrixXd X = MatrixXd::Zero(2 * K, 2 * common);
    X.topLeftCorner(K, common) = session.first.leftCols(common);
    X.bottomLeftCorner(K, common) = session.second.leftCols(common);
    X.bottomRightCorner(K, common) = session.second.leftCols(common);
    VectorXd y(2 * K);
    y << session.first.rightCols(1), session.second.rightCols(1);
    const MatrixXd one = span_of(X.leftCols(common), nullptr), both = span_of(X, nullptr);
    squares += (both.transpose() * y).squaredNorm() - (one.transpose() * y).squaredNorm();
    degrees += static_cast<double>(both.cols() - one.cols());
  }
  return degrees > 0 ? std::max(1.0, squares / degrees) : 1;
}

/// How much more sessions of one side differ in all parameters than noise and scatter say: what the
/// model lacks shows in parameters that the motion of a session chooses.
double misfit_between(const std::vector<SessionEquations>& sessions, const SessionScatter& scatter,
                      Index common) {
  const WhitenedSessions all = whitened_sessions(sessions, scatter, 1);
  const Index K = all.rows.rows() / static_cast<Index>(sessions.size());
  double squares = 0, degrees = 0;
  for (const bool later : {false, true}) {
    std::vector<MatrixXd> own;
    for (std::size_t s = 0; s < sessions.size(); ++s) {
      if (sessions[s].later == later) {
        own.emplace_back(all.rows.middleRows(static_cast<Index>(s) * K, K));
      }
    }
    MatrixXd side(K * static_cast<Index>(own.size()), all.rows.cols());
    for (std::size_t s = 0; s < own.size(); ++s) {
      side.middleRows(static_cast<Index>(s) * K, K) = own[s];
      const MatrixXd Q = span_of(own[s].leftCols(common), nullptr);
      squares += (Q.transpose() * own[s].rightCols(1)).squaredNorm();
      degrees += static_cast<double>(Q.cols());
    }
    const MatrixXd Q = span_of(side.leftCols(common), nullptr);
    squares -= (Q.transpose() * side.rightCols(1)).squaredNorm();
    degrees -= static_cast<double>(Q.cols());
  }
  return degrees > 0 ? std::max(1.0, squares / degrees) : 1;
}

bool has_replicates(const std::vector<SessionEquations>& sessions) {
  const auto later = std::count_if(sessions.begin(), sessions.end(),
                                   [](const SessionEquations& own) { return own.later; });
  return later > 1 || static_cast<std::ptrdiff_t>(sessions.size()) - later > 1;
}

}  // namespace

std::vector<ScatterTerm> scatter_terms(const LinearModel& model, const VectorXd& size,
                                       const VectorXd& torque, const ChangeRules& rules) {
  std::vector<ScatterTerm> terms;
  for (int j = 0; j < model.joints(); ++j) {
    const int coulomb = parameter_of(model, j, ParameterKind::kCoulomb);
    const double least = rules.least_friction * torque[j];
    const double friction = coulomb < 0 ? least : std::max(least, size[coulomb]);
    if (coulomb >= 0) {
      terms.push_back({coulomb, j, ScatterKind::kCoulomb, rules.coulomb_allowance * friction});
    }
    if (const int viscous = parameter_of(model, j, ParameterKind::kViscous); viscous >= 0) {
      terms.push_back({viscous, j, ScatterKind::kViscous, rules.viscous_allowance * size[viscous]});
    }
    if (const int offset = parameter_of(model, j, ParameterKind::kOffset); offset >= 0) {
      terms.push_back({offset, j, ScatterKind::kOffset, rules.offset_allowance * friction});
    }
  }
  return terms;
}

VectorXd SessionScatter::deviations(double common) const {
  VectorXd values(static_cast<Index>(terms.size()));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    values[static_cast<Index>(i)] =
        common * factor[static_cast<std::size_t>(terms[i].kind)] * terms[i].allowance;
  }
  return values;
}

WhitenedSessions whitened_sessions(const std::vector<SessionEquations>& sessions,
                                   const SessionScatter& scatter, double common) {
  const Index width = sessions.front().triangle.cols(), K = width - 1;
  WhitenedSessions all;
  all.rows.resize(K * static_cast<Index>(sessions.size()), width);
  const VectorXd deviations = scatter.deviations(common);
  Index row = 0;
  for (const SessionEquations& session : sessions) {
    if (!session.later) all.later_from = row + K;
    const MatrixXd& R = session.triangle;
    MatrixXd U(K, deviations.size());
    for (Index i = 0; i < U.cols(); ++i) {
      U.col(i) = R.col(scatter.terms[static_cast<std::size_t>(i)].column).head(K) * deviations[i];
    }
    MatrixXd V = scatter.inflation * MatrixXd::Identity(K, K);
    V.selfadjointView<Eigen::Lower>().rankUpdate(U);
    const Eigen::LLT<MatrixXd> factor(V);
    all.log_determinant += 2 * factor.matrixLLT().diagonal().array().log().sum();
    MatrixXd rows = R.topRows(K);
    factor.matrixL().solveInPlace(rows);
    all.rows.middleRows(row, K) = rows;
    row += K;
  }
  return all;
}

SessionScatter session_scatter(const std::vector<SessionEquations>& sessions,
                               std::vector<ScatterTerm> terms, Index common,
                               const ChangeRules& rules) {
  SessionScatter scatter;
  scatter.terms = std::move(terms);
  scatter.inflation = inflation_of(sessions, common);
  scatter.estimated = has_replicates(sessions) && !scatter.terms.empty();
  if (!scatter.estimated) return scatter;
  // a search along one kind after another: the kinds hardly know of one another
  constexpr int kRounds = 3;
  double step = 2;
  const auto value = [&](const SessionScatter& own) {
    double sum = sides_likelihood(sessions, own, common);
    for (const double factor : own.factor) sum += log_prior(factor, rules);
    return sum;
  };
  double best = value(scatter);
  for (int round = 0; round < kRounds; ++round, step = std::sqrt(step)) {
    for (std::size_t kind = 0; kind < kScatterKinds; ++kind) {
      for (const double way : {step, 1 / step}) {
        constexpr int kMost = 8;  // steps one way: a factor of 256 in the first round
        for (int i = 0; i < kMost; ++i) {
          SessionScatter trial = scatter;
          trial.factor[kind] *= way;
          const double now = value(trial);
          if (now <= best) break;
          best = now;
          scatter = trial;
        }
      }
    }
  }
  SessionScatter alone = scatter;
  alone.inflation = 1;
  scatter.inflation = std::max(scatter.inflation, misfit_between(sessions, alone, common));
  return scatter;
}

LeftOfSessions left_of_sessions(const WhitenedSessions& sessions, Index common,
                                const MatrixXd& columns, const MatrixXd& reference) {
  LeftOfSessions result;
  const Index later = sessions.rows.rows() - sessions.later_from;
  MatrixXd C = MatrixXd::Zero(sessions.rows.rows(), columns.cols());
  C.topRows(sessions.later_from) =
      sessions.rows.topLeftCorner(sessions.later_from, reference.rows()) * reference;
  C.bottomRows(later) = sessions.rows.bottomLeftCorner(later, columns.rows()) * columns;
  double determinant = 0;
  const MatrixXd Q = span_of(sessions.rows.leftCols(common), &determinant);
  VectorXd y = sessions.rows.rightCols(1);
  result.whole = C.transpose() * C;
  for (int pass = 0; pass < 2; ++pass) C -= Q * (Q.transpose() * C);
  y -= Q * (Q.transpose() * y);
  result.left = C.transpose() * C;
  result.rest = C.transpose() * y;
  result.restricted = -0.5 * (sessions.log_determinant + determinant + y.squaredNorm());
  return result;
}

}  // namespace dyngen::runtime
