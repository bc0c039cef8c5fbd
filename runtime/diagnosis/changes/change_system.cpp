// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/change_system.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Part of a parameter that may lie in combinations that no motion shows.
constexpr double kHidden = 1e-4;
// Scatter over its estimate, which is not certain.
constexpr std::array<double, 6> kScatterLevels = {0.5, 0.71, 1, 1.41, 2, 2.83};

/// x with P(chi-square of one degree > x) = tail.
double quantile(double tail) {
  double low = 0, high = 1e3;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_square_tail(middle, 1) > tail ? low : high) = middle;
  }
  return low;
}

/// log of the sum of exponentials.
double log_sum(const std::vector<double>& values) {
  const double most = *std::max_element(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += std::exp(value - most);
  return most + std::log(sum);
}

bool has_body(const ChangeCandidate& candidate) {
  return candidate.kind == ChangeCandidate::Kind::kLoad ||
         candidate.kind == ChangeCandidate::Kind::kInertia;
}

}  // namespace

ChangeSystem::ChangeSystem(const std::vector<SessionEquations>& sessions,
                           const SessionScatter& scatter, Index common,
                           std::vector<ChangeCandidate> candidates, double false_alarm,
                           const ChangeRules& rules)
    : sessions_(sessions),
      scatter_(scatter),
      common_(common),
      candidates_(std::move(candidates)),
      rules_(rules) {
  drop_absent();
  std::vector<double> scatters = {1};
  if (scatter_.estimated) scatters.assign(kScatterLevels.begin(), kScatterLevels.end());
  for (std::size_t i = 0; i < scatters.size(); ++i) {
    Level level;
    level.scatter = scatters[i];
    level.of = left_of_sessions(whitened_sessions(sessions_, scatter_, level.scatter), common_,
                                columns_, reference_);
    const double s = level.scatter * level.scatter;
    level.log_weight = level.of.restricted - 0.5 * rules_.allowance_worth * (std::log(s) + 1 / s);
    if (level.scatter == 1) centre_ = i;
    levels_.push_back(std::move(level));
  }
  join_equal();
  make_forms({});
  const auto both =
      static_cast<double>(std::count_if(candidates_.begin(), candidates_.end(),
                                        [](const ChangeCandidate& own) { return own.both_sides; }));
  cost_of_both_ = std::log(std::max(1.0, both));
  const double tests = std::max(1.0, static_cast<double>(candidates_.size()) - both);
  cost_ = std::max(0.0, 0.5 * quantile(false_alarm / tests) - 0.5 * std::log(1 + rules_.slab));
}

void ChangeSystem::drop_absent() {
  const WhitenedSessions all = whitened_sessions(sessions_, scatter_, 1);
  const auto stack = [&] {
    Index width = 0;
    first_.clear();
    for (const ChangeCandidate& own : candidates_) {
      first_.push_back(width);
      width += own.columns.cols();
    }
    columns_ = MatrixXd::Zero(sessions_.front().triangle.cols() - 1, width);
    reference_ = columns_;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const MatrixXd& own = candidates_[i].columns;
      columns_.middleCols(first_[i], own.cols()) = own;
      if (candidates_[i].both_sides) reference_.middleCols(first_[i], own.cols()) = own;
    }
  };
  stack();
  const LeftOfSessions of = left_of_sessions(all, common_, columns_, reference_);
  std::vector<ChangeCandidate> present;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Index from = first_[i], count = candidates_[i].columns.cols();
    const double whole = of.whole.diagonal().segment(from, count).maxCoeff();
    const double left = of.left.diagonal().segment(from, count).maxCoeff();
    if (whole > 0 && left > kRoundingPart * whole) present.push_back(std::move(candidates_[i]));
  }
  candidates_ = std::move(present);
  stack();
  length_ = left_of_sessions(all, common_, columns_, reference_).whole.diagonal().cwiseSqrt();
  for (Index c = 0; c < length_.size(); ++c) {
    if (!(length_[c] > 0)) length_[c] = 1;
    columns_.col(c) /= length_[c];
    reference_.col(c) /= length_[c];
  }
}

void ChangeSystem::join_equal() {
  const MatrixXd& left = levels_[centre_].of.left;
  const auto basis = [&](std::size_t i) {
    const Index count = candidates_[i].columns.cols();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
        left.block(first_[i], first_[i], count, count));
    const Index rank = (eigen.eigenvalues().array() > kRoundingPart).count();
    return MatrixXd(eigen.eigenvectors().rightCols(rank) *
                    eigen.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse().asDiagonal());
  };
  std::vector<MatrixXd> bases;
  for (std::size_t i = 0; i < candidates_.size(); ++i) bases.push_back(basis(i));
  std::vector<bool> dropped(candidates_.size(), false);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    for (std::size_t k = i + 1; k < candidates_.size() && !dropped[i]; ++k) {
      if (dropped[k] || bases[i].cols() != bases[k].cols()) continue;
      if (has_body(candidates_[i]) || has_body(candidates_[k])) continue;
      if (candidates_[i].both_sides != candidates_[k].both_sides) continue;
      const MatrixXd inner = bases[i].transpose() *
                             left.block(first_[i], first_[k], bases[i].rows(), bases[k].rows()) *
                             bases[k];
      constexpr double kEqual = 1e-5;  // of the squared cosines
      if (inner.squaredNorm() < (1 - kEqual) * static_cast<double>(inner.cols())) continue;
      dropped[k] = true;
      for (const std::string& family : candidates_[k].families) {
        std::vector<std::string>& own = candidates_[i].families;
        if (std::find(own.begin(), own.end(), family) == own.end()) own.push_back(family);
      }
      if (candidates_[i].base.front() < 0 &&
          candidates_[i].base.size() == candidates_[k].base.size()) {
        candidates_[i].base = candidates_[k].base;
      }
    }
  }
  std::vector<ChangeCandidate> kept;
  std::vector<Index> first, raw;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (dropped[i]) continue;
    first.push_back(static_cast<Index>(raw.size()));
    for (Index c = 0; c < candidates_[i].columns.cols(); ++c) raw.push_back(first_[i] + c);
    kept.push_back(std::move(candidates_[i]));
  }
  candidates_ = std::move(kept);
  first_ = std::move(first);
  columns_ = columns_(Eigen::all, raw).eval();
  reference_ = reference_(Eigen::all, raw).eval();
  length_ = length_(raw).eval();
  for (Level& level : levels_) {
    level.of.left = level.of.left(raw, raw).eval();
    level.of.whole = level.of.whole(raw, raw).eval();
    level.of.rest = level.of.rest(raw).eval();
  }
}

void ChangeSystem::add_form(ChangeForm form, std::vector<MatrixXd>& mixes) {
  const Index at = first_[form.candidate], rows = form.mix.rows();
  const LeftOfSessions& of = levels_[centre_].of;
  // mixes are in own units, raw columns over their lengths
  MatrixXd scaled = length_.segment(at, rows).asDiagonal() * form.mix;
  scaled = scaled * scaled.colwise().norm().cwiseMax(1e-300).cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled.transpose() *
                                                      of.left.block(at, at, rows, rows) * scaled);
  const Index rank = (eigen.eigenvalues().array() > kRoundingPart).count();
  if (rank == 0) return;
  const MatrixXd own = scaled * eigen.eigenvectors().rightCols(rank) *
                       eigen.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
  form.from = mixes.empty() ? 0 : forms_.back().from + forms_.back().count;
  form.count = rank;
  form.slab =
      std::max<double>(rules_.slab, (own.transpose() * of.rest.segment(at, rows)).squaredNorm());
  forms_.push_back(std::move(form));
  mixes.push_back(own);
}

void ChangeSystem::make_forms(const ChangeSet& beside) {
  std::vector<ChangeForm> wanted;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const ChangeCandidate& own = candidates_[i];
    const Index count = own.columns.cols();
    for (const std::vector<int>& parameters : own.forms) {
      ChangeForm form;
      form.candidate = i;
      form.body = own.kind == ChangeCandidate::Kind::kLoad;
      form.mix = MatrixXd::Zero(count, static_cast<Index>(parameters.size()));
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        form.mix(parameters[p], static_cast<Index>(p)) = 1;
      }
      wanted.push_back(std::move(form));
    }
    if (own.kind != ChangeCandidate::Kind::kLoad) continue;
    ChangeSet others;
    for (const std::size_t f : beside) {
      if (forms_[f].candidate != i) others.push_back(f);
    }
    ChangeForm form;
    form.candidate = i;
    form.point = true;
    const BodyEvidence evidence = evidence_of_load(i, others);
    const PointMass mass = point_mass(evidence, possible_body(evidence).parameters);
    if (mass.mass == 0) continue;
    form.mix = mass.tangents();
    wanted.push_back(std::move(form));
  }
  std::vector<MatrixXd> mixes;
  forms_.clear();
  for (ChangeForm& form : wanted) add_form(std::move(form), mixes);
  const Index total = forms_.empty() ? 0 : forms_.back().from + forms_.back().count;
  MatrixXd all = MatrixXd::Zero(columns_.cols(), total);
  for (std::size_t f = 0; f < forms_.size(); ++f) {
    all.block(first_[forms_[f].candidate], forms_[f].from, mixes[f].rows(), mixes[f].cols()) =
        mixes[f];
  }
  for (Level& level : levels_) {
    level.gram = all.transpose() * level.of.left * all;
    level.rest = all.transpose() * level.of.rest;
  }
}

void ChangeSystem::place_points(const ChangeSet& set) { make_forms(set); }

std::vector<Index> ChangeSystem::columns_of(const ChangeSet& set) const {
  std::vector<Index> columns;
  for (const std::size_t f : set) {
    for (Index c = 0; c < forms_[f].count; ++c) columns.push_back(forms_[f].from + c);
  }
  return columns;
}

VectorXd ChangeSystem::slabs_of(const ChangeSet& set) const {
  VectorXd slabs(degrees(set));
  Index place = 0;
  for (const std::size_t f : set) {
    slabs.segment(place, forms_[f].count).setConstant(forms_[f].slab);
    place += forms_[f].count;
  }
  return slabs;
}

Index ChangeSystem::degrees(const ChangeSet& set) const {
  Index sum = 0;
  for (const std::size_t f : set) sum += forms_[f].count;
  return sum;
}

double ChangeSystem::log_likelihood(const Level& level, const std::vector<Index>& columns,
                                    const VectorXd& slabs) const {
  if (columns.empty()) return level.log_weight;
  const VectorXd wide = slabs.cwiseSqrt();
  MatrixXd M = wide.asDiagonal() * level.gram(columns, columns) * wide.asDiagonal();
  M.diagonal().array() += 1;
  const Eigen::LLT<MatrixXd> factor(M);
  const VectorXd b = wide.asDiagonal() * level.rest(columns);
  return level.log_weight + 0.5 * b.dot(factor.solve(b)) -
         factor.matrixLLT().diagonal().array().log().sum();
}

double ChangeSystem::prior(const ChangeSet& set) const {
  double sum = 0;
  int frictions = 0;
  for (const std::size_t f : set) {
    const ChangeCandidate& own = candidates_[forms_[f].candidate];
    if (own.both_sides) {
      sum -= cost_of_both_;
      continue;
    }
    const bool inertia = own.kind == ChangeCandidate::Kind::kInertia;
    double cost = cost_ - (inertia ? std::log(rules_.inertia_odds) : 0);
    if (own.kind == ChangeCandidate::Kind::kFriction && frictions++ > 0) {
      cost = std::min(cost, -std::log(rules_.further_friction));
    }
    const auto forms =
        static_cast<double>(own.forms.size()) + (own.kind == ChangeCandidate::Kind::kLoad ? 1 : 0);
    sum -= cost + std::log(forms);
  }
  return sum;
}

double ChangeSystem::upper_bound(const ChangeSet& set) const {
  const std::vector<Index> columns = columns_of(set);
  const VectorXd slabs = slabs_of(set);
  std::vector<double> values;
  for (const Level& level : levels_) values.push_back(log_likelihood(level, columns, slabs));
  return log_sum(values) + prior(set);
}

BodyEvidence ChangeSystem::evidence_of_load(std::size_t candidate, const ChangeSet& beside) const {
  const LeftOfSessions& of = levels_[centre_].of;
  const Index at = first_[candidate];
  MatrixXd G = of.left.block(at, at, kBodyParameters, kBodyParameters);
  VectorXd b = of.rest.segment(at, kBodyParameters);
  std::vector<Index> raw;
  for (const std::size_t f : beside) {
    const Index start = first_[forms_[f].candidate];
    for (Index p = 0; p < forms_[f].mix.rows(); ++p) {
      if (!forms_[f].mix.row(p).isZero(0)) raw.push_back(start + p);
    }
  }
  if (!raw.empty()) {
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
    solver.setThreshold(kRoundingPart);
    solver.compute(of.left(raw, raw));
    const MatrixXd across = of.left(raw, Eigen::seqN(at, kBodyParameters));
    G -= across.transpose() * solver.solve(across);
    b -= across.transpose() * solver.solve(of.rest(raw));
  }
  const VectorXd unit = length_.segment(at, kBodyParameters);
  BodyEvidence evidence;
  evidence.G = unit.asDiagonal() * G * unit.asDiagonal();
  evidence.b = unit.asDiagonal() * b;
  return evidence;
}

double ChangeSystem::body_price(const ChangeSet& set) const {
  double price = 0;
  for (const std::size_t f : set) {
    if (!forms_[f].body) continue;
    ChangeSet others;
    for (const std::size_t other : set) {
      if (other != f) others.push_back(other);
    }
    price += 0.5 * possible_body(evidence_of_load(forms_[f].candidate, others)).worse;
  }
  return price;
}

double ChangeSystem::bounds_price(const ChangeSet& set) const {
  // P of a size within its bounds, over its prior probability of one half
  const auto price = [](double value, double deviation, double least, double most) {
    double sum = 0;
    for (const double room : {value - least, most - value}) {
      if (!std::isfinite(room)) continue;
      const double share = std::max(std::erfc(-room / (deviation * std::numbers::sqrt2)), 1e-300);
      sum -= std::min(0.0, std::log(share));
    }
    return sum;
  };
  const bool bounded = std::any_of(set.begin(), set.end(), [&](std::size_t f) {
    const ChangeCandidate& own = candidates_[forms_[f].candidate];
    return (own.least.array() > -std::numeric_limits<double>::infinity()).any() ||
           (own.most.array() < std::numeric_limits<double>::infinity()).any();
  });
  if (!bounded) return 0;
  const RawPlaces raw = raw_places(set);
  const Fitted fit = fitted(raw.columns, level_weights(set));
  double sum = 0;
  for (std::size_t i = 0; i < raw.columns.size(); ++i) {
    const ChangeCandidate& own = candidates_[forms_[raw.forms[i]].candidate];
    if (own.least.size() == 0) continue;
    // the size after the reference: with that of both sides, if the set has one
    VectorXd slope = VectorXd::Zero(fit.mean.size());
    for (std::size_t k = 0; k < raw.columns.size(); ++k) {
      const ChangeCandidate& other = candidates_[forms_[raw.forms[k]].candidate];
      const bool same = k == i || (!own.both_sides && other.both_sides &&
                                   raw.parameters[k] == raw.parameters[i] &&
                                   is_same_effect(own.effect, other.effect));
      if (same) slope[static_cast<Index>(k)] = 1 / length_[raw.columns[k]];
    }
    const double variance = slope.dot(fit.covariance * slope);
    if (!(variance > 0)) continue;
    sum += price(slope.dot(fit.mean), std::sqrt(variance), own.least[raw.parameters[i]],
                 own.most[raw.parameters[i]]);
  }
  return sum;
}

double ChangeSystem::log_evidence(const ChangeSet& set) const {
  return upper_bound(set) - body_price(set) - bounds_price(set);
}

double ChangeSystem::chi_square(const ChangeSet& set) const {
  const std::vector<Index> columns = columns_of(set);
  if (columns.empty()) return 0;
  const Level& level = levels_[centre_];
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(kRoundingPart);
  solver.compute(level.gram(columns, columns));
  const VectorXd b = level.rest(columns);
  return b.dot(solver.solve(b));
}

std::vector<double> ChangeSystem::level_weights(const ChangeSet& set) const {
  std::vector<double> weights;
  const std::vector<Index> columns = columns_of(set);
  const VectorXd slabs = slabs_of(set);
  for (const Level& level : levels_) weights.push_back(log_likelihood(level, columns, slabs));
  const double sum = log_sum(weights);
  for (double& weight : weights) weight = std::exp(weight - sum);
  return weights;
}

ChangeSystem::Fitted ChangeSystem::fitted(const std::vector<Index>& raw,
                                          const std::vector<double>& weights) const {
  const auto count = static_cast<Index>(raw.size());
  Fitted fit{VectorXd::Zero(count), MatrixXd::Zero(count, count), {}};
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(levels_[i].of.left(raw, raw));
    const Index rank = (eigen.eigenvalues().array() > kRoundingPart).count();
    const MatrixXd V = eigen.eigenvectors().rightCols(rank);
    const MatrixXd C =
        V * eigen.eigenvalues().tail(rank).cwiseInverse().asDiagonal() * V.transpose();
    const VectorXd x = C * levels_[i].of.rest(raw);
    fit.mean += weights[i] * x;
    fit.covariance += weights[i] * (C + x * x.transpose());
    if (i != centre_) continue;
    for (Index p = 0; p < count; ++p) fit.seen.push_back(1 - V.row(p).squaredNorm() < kHidden);
  }
  fit.covariance -= fit.mean * fit.mean.transpose();
  return fit;
}

VectorXd ChangeSystem::reference_beside(const std::vector<Index>& raw, const VectorXd& mean) const {
  const WhitenedSessions all = whitened_sessions(sessions_, scatter_, 1);
  const Index later = all.rows.rows() - all.later_from;
  VectorXd y = all.rows.rightCols(1);
  y.head(all.later_from) -= all.rows.topLeftCorner(all.later_from, reference_.rows()) *
                            (reference_(Eigen::all, raw) * mean);
  y.tail(later) -=
      all.rows.bottomLeftCorner(later, columns_.rows()) * (columns_(Eigen::all, raw) * mean);
  const MatrixXd X = all.rows.leftCols(common_);
  const VectorXd scale = X.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(kRoundingPart);
  solver.compute(X * scale.asDiagonal());
  return scale.asDiagonal() * solver.solve(y);
}

ChangeSystem::RawPlaces ChangeSystem::raw_places(const ChangeSet& set) const {
  RawPlaces raw;
  for (const std::size_t f : set) {
    const ChangeForm& form = forms_[f];
    for (Index p = 0; p < form.mix.rows(); ++p, ++raw.all) {
      if (!form.point && form.mix.row(p).isZero(0)) continue;
      raw.columns.push_back(first_[form.candidate] + p);
      raw.places.push_back(raw.all);
      raw.forms.push_back(f);
      raw.parameters.push_back(p);
    }
  }
  return raw;
}

ChangeEstimate ChangeSystem::estimate(const ChangeSet& set) const {
  const RawPlaces own = raw_places(set);
  const std::vector<Index>&raw = own.columns, &places = own.places;
  const Index all = own.all;
  const Fitted fit = fitted(raw, level_weights(set));
  const VectorXd unit = length_(raw).cwiseInverse();
  ChangeEstimate result;
  result.values = result.deviations = VectorXd::Zero(all);
  result.values(places) = unit.cwiseProduct(fit.mean);
  result.deviations(places) = unit.cwiseProduct(fit.covariance.diagonal().cwiseMax(0).cwiseSqrt());
  result.seen.assign(static_cast<std::size_t>(all), true);
  for (std::size_t i = 0; i < places.size(); ++i) {
    result.seen[static_cast<std::size_t>(places[i])] = fit.seen[i];
  }
  // parameters of both sides, once the changes are taken out of the later sessions
  result.reference = reference_beside(raw, fit.mean);
  return result;
}

}  // namespace dyngen::runtime
