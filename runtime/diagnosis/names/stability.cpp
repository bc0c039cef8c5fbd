// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/stability.h"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kPiecesOfHalves = 40;
constexpr int kHalves = 100;

/// Products of a contender's columns with one another and with what is left, in one stretch.
struct StretchProducts {
  MatrixXd own;
  VectorXd rest;
};

std::vector<StretchProducts> products_of(const EvidenceSystem& system,
                                         const JointColumns& columns) {
  const Index k = columns.columns();
  std::vector<StretchProducts> all(kPiecesOfHalves, {MatrixXd::Zero(k, k), VectorXd::Zero(k)});
  for (const int joint : columns.joints) {
    const MatrixXd left = system.left_of(columns, joint);
    const VectorXd rest = system.rest(joint);
    for (Index i = 0; i < kPiecesOfHalves; ++i) {
      const Index from = i * left.rows() / kPiecesOfHalves,
                  to = (i + 1) * left.rows() / kPiecesOfHalves;
      const auto rows = left.middleRows(from, to - from);
      auto& own = all[static_cast<std::size_t>(i)];
      own.own += rows.transpose() * rows;
      own.rest += rows.transpose() * rest.segment(from, to - from);
    }
  }
  return all;
}

/// Chi-square reduction by columns over some stretches.
double squares_of(const std::vector<StretchProducts>& all, const std::vector<std::size_t>& chosen) {
  MatrixXd own = all[chosen.front()].own;
  VectorXd rest = all[chosen.front()].rest;
  for (std::size_t i = 1; i < chosen.size(); ++i) {
    own += all[chosen[i]].own;
    rest += all[chosen[i]].rest;
  }
  if (rest.size() == 0) return 0;
  // to unit diagonal: columns have different units
  const VectorXd scale = own.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * own * scale.asDiagonal();
  const VectorXd wanted = scale.cwiseProduct(rest);
  const VectorXd solved = scaled.completeOrthogonalDecomposition().solve(wanted);
  return wanted.dot(solved);
}

}  // namespace

std::vector<double> selected_shares(const EvidenceSystem& system,
                                    const std::vector<Contender>& contenders, std::uint64_t seed) {
  std::vector<std::vector<StretchProducts>> products;
  for (const Contender& own : contenders) products.push_back(products_of(system, own.columns));
  std::vector<double> shares(contenders.size(), 0.0);
  if (contenders.empty()) return shares;
  std::mt19937_64 random(seed);
  std::vector<std::size_t> order(kPiecesOfHalves);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int half = 0; half < kHalves; ++half) {
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[random() % (i + 1)]);
    const std::vector<std::size_t> chosen(order.begin(), order.begin() + kPiecesOfHalves / 2);
    std::size_t best = 0;
    double most = 0;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      const double net = 2 * squares_of(products[c], chosen) - contenders[c].price;
      if (c == 0 || net > most) {
        best = c;
        most = net;
      }
    }
    shares[best] += 1.0 / kHalves;
  }
  return shares;
}

}  // namespace dyngen::runtime
