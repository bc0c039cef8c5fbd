// SPDX-License-Identifier: MIT
#include "runtime/estimation/unseen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/posture_scale.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Reduced row echelon form of the transposed directions: each combination then has a parameter of
/// its own and few others. Of pivots that are alike the first parameter's is taken: rounding must
/// not choose between columns that are the same.
MatrixXd simplest(MatrixXd rows) {
  constexpr double kSamePivot = 0.99;
  Index pivot_row = 0;
  const double small = 1e-6;
  for (; pivot_row < rows.rows(); ++pivot_row) {
    const MatrixXd left = rows.bottomRows(rows.rows() - pivot_row).cwiseAbs();
    const double largest = left.maxCoeff();
    if (largest < small) break;
    Index r = 0, c = 0;
    while (left.col(c).maxCoeff(&r) < kSamePivot * largest) ++c;
    r += pivot_row;
    rows.row(r).swap(rows.row(pivot_row));
    rows.row(pivot_row) /= rows(pivot_row, c);
    for (Index k = 0; k < rows.rows(); ++k) {
      if (k != pivot_row) rows.row(k) -= rows(k, c) * rows.row(pivot_row);
    }
  }
  return rows.topRows(pivot_row);
}

std::string combination_text(const std::vector<std::pair<int, double>>& terms,
                             const LinearModel& model) {
  std::string text;
  for (const auto& [parameter, factor] : terms) {
    const double size = std::abs(factor / terms.front().second);
    const bool negative = (factor < 0) != (terms.front().second < 0);
    if (!text.empty()) text += negative ? " - " : " + ";
    if (std::abs(size - 1) > 1e-6) text += fmt::format("{:.3g} ", size);
    text += model.parameters[static_cast<std::size_t>(parameter)].name;
  }
  return text;
}

/// An offset, with friction or alone: no posture tells it, and motion one way does not part it from
/// Coulomb friction.
bool is_of_offset(const std::vector<std::pair<int, double>>& terms, const LinearModel& model) {
  bool offset = false;
  for (const auto& [parameter, factor] : terms) {
    const ParameterKind kind = model.parameters[static_cast<std::size_t>(parameter)].kind;
    offset = offset || kind == ParameterKind::kOffset;
    if (kind == ParameterKind::kInertial || kind == ParameterKind::kRotorInertia) return false;
  }
  return offset;
}

/// Which part of a motion shows a direction.
enum class Shown { kNot, kPosture, kSpeed, kAcceleration };

/// Motions of some joints around a posture: the direction's largest torque on these joints, by kind
/// of motion. The torque of a joint that stands is held by stiction and shows nothing.
Shown shown_by(const LinearModel& model, const VectorXd& direction, const VectorXd& posture,
               const std::vector<int>& moving) {
  constexpr Index kTrials = 12;
  const int n = model.joints();
  const Index nb = model.size();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Shown kind : {Shown::kPosture, Shown::kSpeed, Shown::kAcceleration}) {
    MatrixXd q = posture.transpose().replicate(kTrials, 1);
    MatrixXd dq = MatrixXd::Zero(kTrials, n), ddq = dq;
    for (Index k = 0; k < kTrials; ++k) {
      for (const int j : moving) {
        q(k, j) += (model.revolute[static_cast<std::size_t>(j)] ? 1.5 : 0.2) * uniform(random);
        if (kind != Shown::kPosture) dq(k, j) = 2 * uniform(random);
        if (kind == Shown::kAcceleration) ddq(k, j) = 5 * uniform(random);
      }
    }
    MatrixXd Y;
    model.regressor(q, dq, ddq, Y);
    double largest = 0, size = 0;
    for (const int j : moving) {
      largest = std::max(largest, (Y.middleCols(j * nb, nb) * direction).cwiseAbs().maxCoeff());
      size = std::max(size, Y.middleCols(j * nb, nb).cwiseAbs().maxCoeff());
    }
    if (largest > 1e-6 * size * direction.cwiseAbs().maxCoeff()) return kind;
  }
  return Shown::kNot;
}

std::string joints_text(const LinearModel& model, const std::vector<int>& joints,
                        const MotionExtent& extent) {
  std::string text;
  for (const int j : joints) {
    if (!text.empty()) text += " and ";
    const std::string& name = model.joint_names[static_cast<std::size_t>(j)];
    if (extent.speed[j] == 0) {
      text += fmt::format("joint {} ({}; it stands)", j + 1, name);
      continue;
    }
    text += fmt::format("joint {} ({}; recorded over {:.3g} {}, {:.2g} {}/s rms)", j + 1, name,
                        extent.highest[j] - extent.lowest[j],
                        model.revolute[static_cast<std::size_t>(j)] ? "rad" : "m", extent.speed[j],
                        model.revolute[static_cast<std::size_t>(j)] ? "rad" : "m");
  }
  return text;
}

/// @param direction  with the small terms that `terms` leaves out
std::string advice_text(const LinearModel& model, const VectorXd& direction,
                        const std::vector<std::pair<int, double>>& terms,
                        const MotionExtent& extent) {
  const VectorXd posture = 0.5 * (extent.lowest + extent.highest);
  const auto sentence = [&](const std::vector<int>& joints, Shown kind) {
    const std::string who = joints_text(model, joints, extent);
    if (is_of_offset(terms, model)) {
      return fmt::format("motion of {} in both directions would show it", who);
    }
    switch (kind) {
      case Shown::kPosture:
        return fmt::format("other postures of {} would show it, slowly too: gravity does", who);
      case Shown::kSpeed:
        return fmt::format("motion of {} would show it, at constant speed too", who);
      default:
        return fmt::format("faster changes of speed of {} would show it", who);
    }
  };
  // the joints that moved least are the likeliest to be what is missing
  std::vector<int> order(static_cast<std::size_t>(model.joints()));
  for (int j = 0; j < model.joints(); ++j) order[static_cast<std::size_t>(j)] = j;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return extent.acceleration[a] + extent.speed[a] < extent.acceleration[b] + extent.speed[b];
  });
  // the gentlest motion first: posture, then speed, then acceleration
  std::vector<int> best;
  Shown gentlest = Shown::kNot;
  for (const int j : order) {
    const Shown kind = shown_by(model, direction, posture, {j});
    if (kind != Shown::kNot && (gentlest == Shown::kNot || kind < gentlest)) {
      gentlest = kind;
      best = {j};
    }
  }
  if (!best.empty()) return sentence(best, gentlest);
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const Shown kind = shown_by(model, direction, posture, {order[a], order[b]});
      if (kind != Shown::kNot) {
        return sentence({order[a], order[b]}, kind) + ", both at the same time";
      }
    }
  }
  return "no motion of one or two joints around the recorded postures would show it";
}

}  // namespace

void MotionExtent::add(const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq) {
  if (q.rows() == 0) return;
  MotionExtent block;
  const double count = static_cast<double>(q.rows());
  block.lowest = q.colwise().minCoeff().transpose();
  block.highest = q.colwise().maxCoeff().transpose();
  block.speed = (dq.colwise().squaredNorm() / count).cwiseSqrt().transpose();
  block.acceleration = (ddq.colwise().squaredNorm() / count).cwiseSqrt().transpose();
  block.samples = count;
  merge(block);
}

void MotionExtent::merge(const MotionExtent& other) {
  if (other.samples == 0) return;
  if (samples == 0) {
    *this = other;
    return;
  }
  lowest = lowest.cwiseMin(other.lowest);
  highest = highest.cwiseMax(other.highest);
  const double mine = samples / (samples + other.samples), theirs = 1 - mine;
  const auto pooled = [&](const VectorXd& a, const VectorXd& b) -> VectorXd {
    return (mine * a.cwiseAbs2() + theirs * b.cwiseAbs2()).cwiseSqrt();
  };
  speed = pooled(speed, other.speed);
  acceleration = pooled(acceleration, other.acceleration);
  samples += other.samples;
}

std::vector<SeenCombination> name_seen(const Estimate& estimate, const LinearModel& model,
                                       const VectorXd& beta, const MatrixXd& covariance) {
  std::vector<SeenCombination> combinations;
  if (estimate.unseen.cols() == 0) return combinations;
  const MatrixXd rows = simplest(complement_of(estimate.unseen).transpose());
  for (Index i = 0; i < rows.rows(); ++i) {
    VectorXd scaled = rows.row(i).transpose();
    const double least = kKnownPosture * scaled.cwiseAbs().maxCoeff();
    scaled = (scaled.cwiseAbs().array() > least).select(scaled, 0.0);
    VectorXd direction = scaled.cwiseQuotient(estimate.scale);
    SeenCombination combination;
    std::vector<int> order;
    for (Index c = 0; c < scaled.size(); ++c) {
      if (scaled[c] != 0) order.push_back(static_cast<int>(c));
    }
    if (order.size() < 2) continue;
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return std::abs(scaled[a]) > std::abs(scaled[b]) * (1 + 1e-9);
    });
    direction /= direction[order.front()];
    for (const int c : order) combination.terms.emplace_back(c, direction[c]);
    combination.text = combination_text(combination.terms, model);
    combination.unit = model.parameters[static_cast<std::size_t>(order.front())].unit;
    combination.value = direction.dot(beta);
    combination.stddev = covariance.size() == 0
                             ? std::numeric_limits<double>::quiet_NaN()
                             : std::sqrt(std::max(0.0, direction.dot(covariance * direction)));
    combinations.push_back(std::move(combination));
  }
  std::stable_sort(combinations.begin(), combinations.end(), [](const auto& a, const auto& b) {
    return std::min_element(a.terms.begin(), a.terms.end())->first <
           std::min_element(b.terms.begin(), b.terms.end())->first;
  });
  return combinations;
}

std::vector<UnseenCombination> name_unseen(const Estimate& estimate, const LinearModel& model,
                                           const MotionExtent& extent) {
  constexpr double kSmall = 1e-4;  // of the largest term, in scaled parameters
  std::vector<UnseenCombination> combinations;
  const MatrixXd rows = simplest(estimate.unseen.transpose());
  for (Index i = 0; i < rows.rows(); ++i) {
    UnseenCombination combination;
    const VectorXd scaled = rows.row(i).transpose();
    const VectorXd direction = scaled.cwiseProduct(estimate.scale);
    std::vector<int> order;
    for (Index c = 0; c < scaled.size(); ++c) {
      if (std::abs(scaled[c]) > kSmall * scaled.cwiseAbs().maxCoeff()) {
        order.push_back(static_cast<int>(c));
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return std::abs(scaled[a]) > std::abs(scaled[b]) * (1 + 1e-9);
    });
    for (const int c : order) combination.terms.emplace_back(c, direction[c]);
    combination.text = combination_text(combination.terms, model);
    combination.advice = advice_text(model, direction, combination.terms, extent);
    combinations.push_back(std::move(combination));
  }
  return combinations;
}

}  // namespace dyngen::runtime
