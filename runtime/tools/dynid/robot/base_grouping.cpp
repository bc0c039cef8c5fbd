// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/base_grouping.h"

#include <Eigen/QR>
#include <stdexcept>

#include "gen/symbols/exact.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kOfLink = static_cast<int>(kChiCount);  // standard parameters

/// Place of a symbol of the file among the standard parameters.
Index place_of_symbol(const FileSymbol& symbol, int links) {
  for (int link = 1; link <= links; ++link) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      if (symbol.name == chi_name(static_cast<Chi>(k), link)) {
        return static_cast<Index>(k) + kOfLink * (link - 1);
      }
    }
  }
  throw std::logic_error("grouping_matrix(): '" + symbol.name + "' is no standard parameter");
}

/// Which standard parameters rather carry base parameters: a first moment or an element of a tensor
/// may have any sign, a mass or a rotor inertia that is negative looks like a mistake.
int reluctance(Index place) {
  const Chi kind = static_cast<Chi>(place % kOfLink);
  if (index(kind) >= kInertialCount) return 2;
  return kind == Chi::kM ? 1 : 0;
}

}  // namespace

MatrixXd grouping_matrix(const SymbolicRobot& robot,
                         const std::vector<GroupedParameter>& parameters) {
  MatrixXd K = MatrixXd::Zero(static_cast<Index>(parameters.size()), Index{kOfLink} * robot.size());
  for (const FileSymbol& symbol : robot.parameters) {
    const Index place = place_of_symbol(symbol, robot.size());
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const GiNaC::ex coefficient = parameters[i].value.coeff(symbol.symbol, 1);
      if (!coefficient.is_zero()) K(static_cast<Index>(i), place) = to_double(coefficient);
    }
  }
  return K;
}

IndependentParameters independent_parameters(const MatrixXd& grouping) {
  constexpr double kDependent = 1e-10;  // of a row's norm; rounding leaves some 1e-16
  IndependentParameters result;
  MatrixXd basis(grouping.cols(), 0);  // orthonormal
  for (Index i = 0; i < grouping.rows(); ++i) {
    VectorXd rest = grouping.row(i).transpose();
    const double norm = rest.norm();
    for (int round = 0; round < 2; ++round) rest -= basis * (basis.transpose() * rest).eval();
    if (rest.norm() <= kDependent * norm) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = rest.normalized();
    result.kept.push_back(static_cast<std::size_t>(i));
  }
  if (result.kept.empty()) return result;
  const MatrixXd own = grouping(result.kept, Eigen::all).transpose();
  result.combination = own.colPivHouseholderQr().solve(grouping.transpose()).transpose();
  for (std::size_t k = 0; k < result.kept.size(); ++k) {
    result.combination.row(static_cast<Index>(result.kept[k])).setZero();
    result.combination(static_cast<Index>(result.kept[k]), static_cast<Index>(k)) = 1;
  }
  result.combination =
      (result.combination.array().abs() > kDependent).select(result.combination, 0.0);
  return result;
}

std::vector<Index> choose_places(const MatrixXd& grouping,
                                 const std::vector<GroupedParameter>& parameters) {
  constexpr double kWeak = 1e-3;  // of a pivot beside the largest: other columns say it better
  std::vector<Index> places;
  for (const GroupedParameter& parameter : parameters) {
    places.push_back(static_cast<Index>(index(parameter.column.kind)) +
                     Index{kOfLink} * (parameter.column.link - 1));
  }
  if (places.empty() || grouping(Eigen::all, places).isIdentity(1e-12)) return places;
  places.clear();
  MatrixXd rest = grouping;
  for (int most = 0; most <= 3; ++most) {  // at last all columns, weak or not
    MatrixXd allowed = rest;
    for (Index c = 0; c < allowed.cols(); ++c) {
      if (reluctance(c) > most) allowed.col(c).setZero();
    }
    const Eigen::ColPivHouseholderQR<MatrixXd> pivoted(allowed);
    const Eigen::VectorXd pivots = pivoted.matrixQR().diagonal().cwiseAbs();
    const Index wanted = grouping.rows() - static_cast<Index>(places.size());
    Index taken = 0;
    while (taken < wanted && (most == 3 || pivots[taken] > kWeak * grouping.norm())) {
      places.push_back(pivoted.colsPermutation().indices()(taken++));
    }
    const MatrixXd Q = MatrixXd(pivoted.householderQ()).leftCols(taken);
    rest -= Q * (Q.transpose() * rest).eval();
  }
  return places;
}

}  // namespace dyngen::runtime
