// SPDX-License-Identifier: MIT
#include "runtime/evidence/evidence_system.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "runtime/effects/equation_stack.h"
#include "runtime/estimation/matrix_products.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Below this part of a column's sum of squares the remainder of the column is rounding.
constexpr double kAbsorbed = 1e-7;

/// Columns that are left once those before them are taken out, and their Cholesky triangle.
struct PivotedTriangle {
  std::vector<Index> columns;  // in the order of the triangle
  MatrixXd L;
};

/// @param A  (k x k) products of columns that had unit length before projection
PivotedTriangle pivoted_triangle(const MatrixXd& A) {
  const Index k = A.rows();
  PivotedTriangle result;
  MatrixXd rows = MatrixXd::Zero(k, k);  // of all columns, by their places
  VectorXd left = A.diagonal();
  for (Index r = 0; r < k; ++r) {
    Index pivot = 0;
    if (!(left.maxCoeff(&pivot) > kAbsorbed)) break;
    const VectorXd column =
        (A.col(pivot) - rows.leftCols(r) * rows.row(pivot).head(r).transpose()) /
        std::sqrt(left[pivot]);
    rows.col(r) = column;
    left -= column.cwiseAbs2();
    left[pivot] = 0;
    result.columns.push_back(pivot);
  }
  const auto rank = static_cast<Index>(result.columns.size());
  result.L = rows.leftCols(rank)(result.columns, Eigen::all);
  return result;
}

/// An orthonormal basis of columns that had unit length before projection. Impulses are hundreds of
/// columns, and joints with stiction need as many bases: only products of matrices are fast enough.
MatrixXd basis_of(const MatrixXd& projected) {
  const PivotedTriangle independent = pivoted_triangle(transposed_product(projected, projected));
  MatrixXd basis = projected(Eigen::all, independent.columns);
  independent.L.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(basis);
  return basis;
}

std::shared_ptr<const std::vector<std::vector<Whitener>>> whiteners_of(
    const EffectRecordings& data, const TorqueNoiseModel& noise) {
  auto all = std::make_shared<std::vector<std::vector<Whitener>>>(noise.joints.size());
  for (std::size_t j = 0; j < all->size(); ++j) {
    for (const EffectRun& run : data.runs) {
      (*all)[j].emplace_back(noise.joints[j], run.rows.counted.col(static_cast<Index>(j)));
    }
  }
  return all;
}

std::shared_ptr<const std::vector<std::deque<UnknownTorque>>> unknown_of(
    const EffectRecordings& data, const std::vector<std::vector<Whitener>>& whiteners) {
  auto all = std::make_shared<std::vector<std::deque<UnknownTorque>>>(whiteners.size());
  for (std::size_t j = 0; j < all->size(); ++j) {
    for (std::size_t run = 0; run < data.runs.size(); ++run) {
      (*all)[j].emplace_back(data.runs[run], static_cast<int>(j), whiteners[j][run]);
    }
  }
  return all;
}

}  // namespace

Score score_of(const Products& products, bool surrogates) {
  Score score;
  const Index k = products.rest.size();
  score.coefficients = VectorXd::Zero(k);
  if (surrogates) score.surrogates = VectorXd::Zero(products.noise.cols());
  const double before = products.whole.trace();
  if (k == 0 || !(before > 0)) return score;
  score.part_left = std::clamp(products.left.trace() / before, 0.0, 1.0);
  // columns of unit length before projection
  VectorXd scale = products.whole.diagonal().cwiseSqrt();
  for (double& s : scale) s = s > 0 ? 1 / s : 0;
  const MatrixXd A = scale.asDiagonal() * products.left * scale.asDiagonal();
  const PivotedTriangle independent = pivoted_triangle(A);
  const auto L = independent.L.triangularView<Eigen::Lower>();
  const auto innovations = [&](const MatrixXd& inner) {
    MatrixXd x = (scale.asDiagonal() * inner)(independent.columns, Eigen::all);
    L.solveInPlace(x);
    return x;
  };
  score.degrees = static_cast<int>(independent.columns.size());
  MatrixXd rest = innovations(products.rest);
  score.delta_chi2 = rest.squaredNorm();
  L.adjoint().solveInPlace(rest);
  for (std::size_t i = 0; i < independent.columns.size(); ++i) {
    const Index c = independent.columns[i];
    score.coefficients[c] = scale[c] * rest(static_cast<Index>(i), 0);
  }
  if (surrogates) {
    score.surrogates = innovations(products.noise).colwise().squaredNorm().transpose();
  }
  return score;
}

std::vector<double> squares_of_few(const Products& products) {
  constexpr double kOfOthers =
      1e-8;  // part of a column's sum of squares: below, it depends on the others
  MatrixXd A = products.left;
  VectorXd r = products.rest;
  const VectorXd own = products.whole.diagonal();
  std::vector<double> squares;
  for (Index taken = 0; taken < r.size(); ++taken) {
    Index best = -1;
    double most = 0;
    for (Index c = 0; c < r.size(); ++c) {
      if (!(A(c, c) > kOfOthers * own[c])) continue;
      const double gain = r[c] * r[c] / A(c, c);
      if (gain > most) {
        most = gain;
        best = c;
      }
    }
    if (best < 0) break;
    squares.push_back((squares.empty() ? 0 : squares.back()) + most);
    const VectorXd column = A.col(best) / std::sqrt(A(best, best));
    const double step = r[best] / std::sqrt(A(best, best));
    A -= column * column.transpose();
    r -= step * column;
  }
  return squares;
}

EvidenceSystem::EvidenceSystem(const EffectRecordings& data, const RunResiduals& residuals,
                               const TorqueNoiseModel& noise, const Options& options)
    : data_(data),
      rules_(options.rules.scans),
      priors_(options.rules.priors),
      left_out_(noise.joints.size()),
      worth_(noise.worth),
      rows_(data.equations()) {
  const int n = data.joints();
  const Index size = data.model.size();
  whiteners_ = whiteners_of(data, noise);
  unknown_ = unknown_of(data, *whiteners_);
  rest_.resize(n * rows_);
  MatrixXd W = MatrixXd::Zero(options.with_regressor ? n * rows_ : 0, size);
  for (int j = 0; j < n; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    Index start = j * rows_;
    for (std::size_t run = 0; run < data.runs.size(); ++run) {
      const RowBlock& block = data.runs[run].rows;
      const Index count = block.Y.rows();
      rest_.segment(start, count) = residuals[run].col(j).cwiseProduct(block.counted.col(j));
      if (options.with_regressor) {
        for (const int c : data.model.columns[joint]) {
          W.col(c).segment(start, count) =
              block.Y.col(j * size + c).cwiseProduct(block.counted.col(j));
        }
      }
      start += count;
    }
    MatrixXd own = rest_.segment(j * rows_, rows_);
    whiten(own, j);
    rest_.segment(j * rows_, rows_) = own;
    if (options.with_regressor) whiten(W.middleRows(j * rows_, rows_), j);
  }
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  noise_.resize(n * rows_, options.surrogates);
  for (Index i = 0; i < noise_.size(); ++i) noise_.data()[i] = normal(random);
  VectorXd counted(n * rows_);
  Index place = 0;
  for (int j = 0; j < n; ++j) {
    for (const EffectRun& run : data.runs) {
      counted.segment(place, run.rows.counted.rows()) = run.rows.counted.col(j);
      place += run.rows.counted.rows();
    }
  }
  noise_.array().colwise() *= counted.array();
  for (int j = 0; j < n; ++j) take_out_unknown(noise_.middleRows(j * rows_, rows_), j);
  basis_.resize(n * rows_, 0);
  if (options.with_regressor) project(orthonormal(W));
}

void EvidenceSystem::take_out_unknown(Eigen::Ref<MatrixXd> rows, int joint) const {
  Index start = 0;
  for (std::size_t run = 0; run < data_.runs.size(); ++run) {
    const Index count = data_.runs[run].rows.Y.rows();
    (*unknown_)[static_cast<std::size_t>(joint)][run].take_out_of(rows.middleRows(start, count));
    start += count;
  }
}

void EvidenceSystem::whiten(Eigen::Ref<MatrixXd> rows, int joint) const {
  Index start = 0;
  for (std::size_t run = 0; run < data_.runs.size(); ++run) {
    const Index count = data_.runs[run].rows.Y.rows();
    (*whiteners_)[static_cast<std::size_t>(joint)][run].apply(rows.middleRows(start, count));
    start += count;
  }
  take_out_unknown(rows, joint);
  const auto& left_out = left_out_[static_cast<std::size_t>(joint)];
  if (left_out) left_out->take_out_of(rows);
}

JointColumns EvidenceSystem::whitened(JointColumns columns) const {
  constexpr Index kEach = 20;  // multiplications: the order of the filter that whitens
  for (const MatrixXd& part : columns.parts) data_.count_work(part.rows(), part.cols(), kEach);
  for (std::size_t i = 0; i < columns.joints.size(); ++i) {
    whiten(columns.parts[i], columns.joints[i]);
  }
  return columns;
}

void EvidenceSystem::project(const MatrixXd& columns) {
  data_.count_work(columns.rows(), columns.cols(), columns.cols() + 2 * noise_.cols());
  rest_ -= columns * (columns.transpose() * rest_);
  subtract_product(columns, transposed_product(columns, noise_), noise_);
  const Index before = basis_.cols();
  basis_.conservativeResize(Eigen::NoChange, before + columns.cols());
  basis_.rightCols(columns.cols()) = columns;
}

void EvidenceSystem::add(const JointColumns& whitened) {
  VectorXd squares = VectorXd::Zero(whitened.columns());
  for (const MatrixXd& part : whitened.parts) {
    squares += part.colwise().squaredNorm().transpose();
  }
  std::vector<Index> present;
  for (Index c = 0; c < squares.size(); ++c) {
    if (squares[c] > 0) present.push_back(c);
  }
  if (present.empty()) return;
  // of unit length before projection
  const VectorXd scale = squares(present).cwiseSqrt().cwiseInverse();
  MatrixXd columns = MatrixXd::Zero(basis_.rows(), scale.size());
  for (std::size_t i = 0; i < whitened.joints.size(); ++i) {
    columns.middleRows(whitened.joints[i] * rows_, rows_) =
        whitened.parts[i](Eigen::all, present) * scale.asDiagonal();
  }
  for (int pass = 0; pass < 2; ++pass) {
    subtract_product(basis_, transposed_product(basis_, columns), columns);
  }
  project(basis_of(columns));
}

void EvidenceSystem::leave_out(const JointColumns& whitened) {
  const int joint = whitened.joints.front();
  auto& left_out = left_out_[static_cast<std::size_t>(joint)];
  left_out = std::make_shared<const LocalReflections>(whitened.parts.front());
  const Index first = joint * rows_;
  left_out->take_out_of(basis_.middleRows(first, rows_));
  left_out->take_out_of(noise_.middleRows(first, rows_));
  MatrixXd own = rest_.segment(first, rows_);
  left_out->take_out_of(own);
  rest_.segment(first, rows_) = own;
  const MatrixXd columns = basis_of(basis_);
  basis_.resize(Eigen::NoChange, 0);
  project(columns);
}

Products EvidenceSystem::products(const JointColumns& whitened, bool surrogates) const {
  return products(whitened, 0, rows_, surrogates);
}

std::vector<Products> EvidenceSystem::products_of_groups(const JointColumns& whitened, Index width,
                                                         bool surrogates) const {
  const Index count = whitened.columns();
  MatrixXd noise = MatrixXd::Zero(count, surrogates ? noise_.cols() : 0);
  VectorXd rest = VectorXd::Zero(count);
  for (std::size_t i = 0; i < whitened.joints.size(); ++i) {
    const MatrixXd& C = whitened.parts[i];
    const Index first = whitened.joints[i] * rows_;
    rest += C.transpose() * rest_.segment(first, rows_);
    if (surrogates) noise += transposed_product(C, noise_.middleRows(first, rows_));
  }
  if (surrogates) count_products(whitened, rows_, true);
  const MatrixXd inner = absorbed(whitened, 0, rows_);
  std::vector<Products> groups;
  for (Index start = 0; start + width <= count; start += width) {
    Products group;
    group.whole = MatrixXd::Zero(width, width);
    for (const MatrixXd& part : whitened.parts) {
      const auto C = part.middleCols(start, width);
      group.whole += C.transpose() * C;
    }
    const auto taken = inner.middleCols(start, width);
    group.left = group.whole - taken.transpose() * taken;
    group.rest = rest.segment(start, width);
    group.noise = noise.middleRows(start, width);
    groups.push_back(std::move(group));
  }
  return groups;
}

void EvidenceSystem::count_products(const JointColumns& whitened, Index rows,
                                    bool with_surrogates) const {
  const Index others = with_surrogates ? noise_.cols() : basis_.cols() + whitened.columns();
  const auto joints = static_cast<Index>(whitened.joints.size());
  data_.count_work(joints * rows, whitened.columns(), others);
}

MatrixXd EvidenceSystem::absorbed(const JointColumns& whitened, Index from, Index to) const {
  MatrixXd inner = MatrixXd::Zero(basis_.cols(), whitened.columns());
  count_products(whitened, to - from, false);
  for (std::size_t i = 0; i < whitened.joints.size(); ++i) {
    inner += transposed_product(basis_.middleRows(whitened.joints[i] * rows_ + from, to - from),
                                whitened.parts[i].middleRows(from, to - from));
  }
  return inner;
}

namespace {

/// Columns that are 0 but for a few rows each, as those of impulses are; nothing if they are not.
/// With as many of them as there are seconds, dense products grow as the cube of the time.
std::optional<Eigen::SparseMatrix<double>> sparse_of(const Eigen::Ref<const MatrixXd>& C) {
  constexpr Index kMany = 64;  // columns: fewer are no burden
  constexpr double kFew = 0.05;
  if (C.cols() < kMany) return std::nullopt;
  std::vector<Eigen::Triplet<double>> entries;
  const auto most = static_cast<std::size_t>(kFew * static_cast<double>(C.size()));
  for (Index c = 0; c < C.cols(); ++c) {
    for (Index row = 0; row < C.rows(); ++row) {
      if (C(row, c) == 0) continue;
      if (entries.size() == most) return std::nullopt;
      entries.emplace_back(static_cast<int>(row), static_cast<int>(c), C(row, c));
    }
  }
  Eigen::SparseMatrix<double> sparse(C.rows(), C.cols());
  sparse.setFromTriplets(entries.begin(), entries.end());
  return sparse;
}

}  // namespace

Products EvidenceSystem::products(const JointColumns& whitened, Index from, Index to,
                                  bool surrogates) const {
  const Index k = whitened.columns(), count = to - from;
  Products products;
  products.whole = MatrixXd::Zero(k, k);
  products.rest = VectorXd::Zero(k);
  products.noise = MatrixXd::Zero(k, surrogates ? noise_.cols() : 0);
  MatrixXd inner = MatrixXd::Zero(basis_.cols(), k);
  count_products(whitened, count, false);
  if (surrogates) count_products(whitened, count, true);
  for (std::size_t i = 0; i < whitened.joints.size(); ++i) {
    const Index first = whitened.joints[i] * rows_ + from;
    const auto C = whitened.parts[i].middleRows(from, count);
    const auto rest = rest_.segment(first, count);
    const auto noise = noise_.middleRows(first, count);
    const auto basis = basis_.middleRows(first, count);
    if (const auto sparse = sparse_of(C)) {
      products.whole += MatrixXd(sparse->transpose() * *sparse);
      products.rest += sparse->transpose() * rest;
      if (surrogates) products.noise += sparse->transpose() * noise;
      inner += (sparse->transpose() * basis).transpose();
    } else {
      products.whole += transposed_product(C, C);
      products.rest += C.transpose() * rest;
      if (surrogates) products.noise += transposed_product(C, noise);
      inner += transposed_product(basis, C);
    }
  }
  products.left = products.whole - transposed_product(inner, inner);
  return products;
}

VectorXd EvidenceSystem::rest(int joint) const {
  MatrixXd rest = rest_.segment(joint * rows_, rows_);
  if (const auto& left_out = left_out_[static_cast<std::size_t>(joint)]) left_out->turn_back(rest);
  return rest;
}

MatrixXd EvidenceSystem::noise(int joint) const {
  MatrixXd noise = noise_.middleRows(joint * rows_, rows_);
  if (const auto& left_out = left_out_[static_cast<std::size_t>(joint)]) left_out->turn_back(noise);
  return noise;
}

MatrixXd EvidenceSystem::left_of(const JointColumns& whitened, int joint) const {
  MatrixXd left = -basis_.middleRows(joint * rows_, rows_) * absorbed(whitened, 0, rows_);
  for (std::size_t i = 0; i < whitened.joints.size(); ++i) {
    if (whitened.joints[i] == joint) left += whitened.parts[i];
  }
  if (const auto& left_out = left_out_[static_cast<std::size_t>(joint)]) left_out->turn_back(left);
  return left;
}

VectorXd EvidenceSystem::taken() const {
  VectorXd degrees(data_.joints());
  for (int j = 0; j < data_.joints(); ++j) {
    const auto& left_out = left_out_[static_cast<std::size_t>(j)];
    degrees[j] = basis_.middleRows(j * rows_, rows_).squaredNorm() +
                 (left_out ? static_cast<double>(left_out->rank()) : 0.0);
    for (const UnknownTorque& unknown : (*unknown_)[static_cast<std::size_t>(j)]) {
      degrees[j] += static_cast<double>(unknown.degrees());
    }
  }
  return degrees;
}

}  // namespace dyngen::runtime
