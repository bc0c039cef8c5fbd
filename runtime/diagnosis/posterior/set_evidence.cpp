// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/posterior/set_evidence.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kDependent = 1e-6;  // eigenvalue of a correlation matrix: columns are dependent

/// A basis of the span of columns with these products, in which they are orthonormal.
MatrixXd orthonormal(const MatrixXd& products) {
  VectorXd scale = products.diagonal().cwiseMax(0).cwiseSqrt();
  for (double& s : scale) s = s > 0 ? 1 / s : 0;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(scale.asDiagonal() * products *
                                                      scale.asDiagonal());
  std::vector<Index> kept;
  for (Index i = 0; i < parts.eigenvalues().size(); ++i) {
    if (parts.eigenvalues()[i] > kDependent) kept.push_back(i);
  }
  const MatrixXd vectors = parts.eigenvectors()(Eigen::all, kept);
  const VectorXd sizes = parts.eigenvalues()(kept).cwiseSqrt();
  return scale.asDiagonal() * vectors * sizes.cwiseInverse().asDiagonal();
}

}  // namespace

SetEvidence::SetEvidence(const MatrixXd& G, const VectorXd& b, std::vector<Candidate> candidates,
                         double slab)
    : candidates_(std::move(candidates)), slab_(slab) {
  Index all = 0;
  for (const Candidate& each : candidates_) all += each.columns;
  if (G.rows() != all || G.cols() != all || b.size() != all) {
    throw std::invalid_argument(
        fmt::format("SetEvidence: G is {} x {} and b has {}, expected {}: the columns of all "
                    "candidates",
                    G.rows(), G.cols(), b.size(), all));
  }
  if (!(slab > 0)) {
    throw std::invalid_argument(fmt::format("SetEvidence: slab is {}, expected > 0", slab));
  }
  std::vector<MatrixXd> bases;
  begin_.push_back(0);
  Index from = 0;
  for (const Candidate& each : candidates_) {
    bases.push_back(orthonormal(G.block(from, from, each.columns, each.columns)));
    begin_.push_back(begin_.back() + bases.back().cols());
    from += each.columns;
  }
  MatrixXd half(all, begin_.back());  // G in the new bases on one side
  b_.resize(begin_.back());
  from = 0;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    const Index rows = candidates_[i].columns, columns = bases[i].cols();
    half.middleCols(begin_[i], columns) = G.middleCols(from, rows) * bases[i];
    b_.segment(begin_[i], columns) = bases[i].transpose() * b.segment(from, rows);
    from += rows;
  }
  G_.resize(begin_.back(), begin_.back());
  from = 0;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    G_.middleRows(begin_[i], bases[i].cols()) =
        bases[i].transpose() * half.middleRows(from, candidates_[i].columns);
    from += candidates_[i].columns;
  }
}

bool SetEvidence::meets(const CandidateSet& set, std::size_t place) const {
  return std::any_of(set.begin(), set.end(), [&](std::size_t other) {
    return candidates_[other].hypothesis == candidates_[place].hypothesis;
  });
}

std::vector<Index> SetEvidence::columns_of(const CandidateSet& set) const {
  std::vector<Index> columns;
  for (const std::size_t place : set) {
    for (Index c = begin_[place]; c < begin_[place + 1]; ++c) columns.push_back(c);
  }
  return columns;
}

MatrixXd SetEvidence::regularised(const std::vector<Index>& columns) const {
  MatrixXd own = G_(columns, columns);
  own.diagonal().array() += 1 / slab_;
  return own;
}

double SetEvidence::of(const CandidateSet& set) const {
  double evidence = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (meets({set.begin(), set.begin() + static_cast<std::ptrdiff_t>(i)}, set[i])) {
      return kImpossible;
    }
    evidence += candidates_[set[i]].log_odds;
  }
  const std::vector<Index> columns = columns_of(set);
  const Eigen::LLT<MatrixXd> factor(regularised(columns));
  const VectorXd own = factor.matrixL().solve(b_(columns));
  const double determinant = VectorXd(MatrixXd(factor.matrixL()).diagonal()).array().log().sum();
  return evidence + 0.5 * own.squaredNorm() - determinant -
         0.5 * static_cast<double>(columns.size()) * std::log(slab_);
}

VectorXd SetEvidence::with_each(const CandidateSet& set) const {
  const double base = of(set);
  VectorXd all = VectorXd::Constant(static_cast<Index>(size()), kImpossible);
  const std::vector<Index> columns = columns_of(set);
  // Schur complements beside the set: D - U'U and b - U'u
  MatrixXd U(static_cast<Index>(columns.size()), G_.cols());
  VectorXd rest = b_;
  if (!columns.empty()) {
    const Eigen::LLT<MatrixXd> factor(regularised(columns));
    U = factor.matrixL().solve(MatrixXd(G_(columns, Eigen::all)));
    rest -= U.transpose() * factor.matrixL().solve(b_(columns));
  }
  for (std::size_t place = 0; place < size(); ++place) {
    if (meets(set, place)) continue;
    const Index from = begin_[place], count = begin_[place + 1] - from;
    if (count == 0) continue;
    MatrixXd own = G_.block(from, from, count, count);
    own.diagonal().array() += 1 / slab_;
    own.noalias() -= U.middleCols(from, count).transpose() * U.middleCols(from, count);
    const Eigen::LLT<MatrixXd> factor(own);
    const VectorXd white = factor.matrixL().solve(rest.segment(from, count));
    all[static_cast<Index>(place)] =
        base + candidates_[place].log_odds + 0.5 * white.squaredNorm() -
        VectorXd(MatrixXd(factor.matrixL()).diagonal()).array().log().sum() -
        0.5 * static_cast<double>(count) * std::log(slab_);
  }
  return all;
}

MatrixXd SetEvidence::likeness() const {
  const auto count = static_cast<Index>(size());
  MatrixXd likeness = MatrixXd::Zero(count, count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < count; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const auto block =
          G_.block(begin_[a], begin_[b], begin_[a + 1] - begin_[a], begin_[b + 1] - begin_[b]);
      if (block.size() > 0) likeness(i, j) = std::min(1.0, block.cwiseAbs().maxCoeff());
    }
  }
  return likeness;
}

}  // namespace dyngen::runtime
