// SPDX-License-Identifier: MIT
#include "runtime/import/joint_transform.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Zeros that rounding has filled: a value that is missing must not spoil joints it is no part of.
void clear_rounding(MatrixXd& matrix) {
  constexpr double kRounding = 1e-14;  // of the largest element
  const double most = matrix.cwiseAbs().maxCoeff();
  matrix = (matrix.cwiseAbs().array() <= kRounding * most).select(0.0, matrix);
}

/// matrix * values, without what is multiplied by 0.
void multiply(const MatrixXd& matrix, const Eigen::VectorXd& values, double* result) {
  for (Index i = 0; i < matrix.rows(); ++i) {
    double sum = 0;
    for (Index j = 0; j < matrix.cols(); ++j) {
      if (matrix(i, j) != 0) sum += matrix(i, j) * values[j];
    }
    result[i] = sum;
  }
}

}  // namespace

MatrixXd side_matrix(const ImportMap& map, const SignalMap& signal, std::size_t joints) {
  const auto n = static_cast<Index>(joints);
  const auto is_motor = [&](std::size_t j) {
    if (signal.sides.empty()) return false;
    return (signal.sides.size() == 1 ? signal.sides.front() : signal.sides[j]) == GearSide::kMotor;
  };
  MatrixXd matrix = MatrixXd::Identity(n, n);
  bool any = false;
  for (std::size_t j = 0; j < joints; ++j) {
    if (!is_motor(j)) continue;
    any = true;
    const auto row = static_cast<Index>(j);
    if (map.coupling.size() > 0) {
      matrix.row(row) = map.coupling.row(row);
    } else {
      matrix(row, row) = of_joint(map.gears, j, 1);
    }
  }
  return any ? matrix : MatrixXd();
}

void JointTransform::set_sides(const ImportMap& map, const SignalMap& signal, std::size_t joints,
                               bool torque) {
  measured_.resize(static_cast<Index>(joints));
  for (std::size_t j = 0; j < joints; ++j) offsets_.push_back(of_joint(signal.offset, j, 0));
  const MatrixXd sides = side_matrix(map, signal, joints);
  if (sides.size() == 0) return;
  if (torque) {
    matrix_ = sides.transpose();
    return;
  }
  // a diagonal divides exactly: 1/K[i][i], and no more rounding
  const Eigen::FullPivLU<MatrixXd> factors(sides);
  matrix_ = factors.inverse();
  clear_rounding(matrix_);
}

JointTransform::JointTransform(const ImportMap& map, const SignalMap& signal,
                               ColumnQuantity quantity, const std::vector<ColumnPlace>& columns,
                               const ColumnLookup& lookup) {
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const bool told = !signal.units.empty();
    const std::string& unit =
        told ? signal.units.size() == 1 ? signal.units.front() : signal.units[j] : columns[j].unit;
    if (unit.empty()) {
      if (quantity == ColumnQuantity::kTemperature) {
        conversions_.emplace_back();
        factors_.push_back(1);
        continue;
      }
      lookup.fail(signal.place,
                  fmt::format("found no unit for {}, and the log has none: expected "
                              "'unit', one of {}",
                              runtime::quoted(columns[j].name), known_signal_units(quantity)));
    }
    const auto known = signal_unit(unit, quantity);
    if (!known) {
      lookup.fail(signal.place,
                  fmt::format("found unit {} of {} in the log, expected {}; 'unit' in the map "
                              "overrides it",
                              runtime::quoted(unit), runtime::quoted(columns[j].name),
                              known_signal_units(quantity)));
    }
    double factor = of_joint(signal.sign, j, 1) * of_joint(signal.gain, j, 1) *
                    of_joint(signal.efficiency, j, 1);
    const auto needs = [&](const PerJoint& values, const char* key, const char* what) {
      if (values.empty()) {
        lookup.fail(signal.place, fmt::format("found {} in {}, expected '{}' too: {}",
                                              runtime::quoted(columns[j].name), unit, key, what));
      }
      factor *= of_joint(values, j, 1);
    };
    switch (known->kind) {
      case RawKind::kSi:
        break;
      case RawKind::kCounts:
        needs(signal.counts_per_turn, "counts_per_rev", "counts of one turn of the encoder");
        factor = 2 * std::numbers::pi * of_joint(signal.sign, j, 1) * of_joint(signal.gain, j, 1) /
                 of_joint(signal.counts_per_turn, j, 1);
        break;
      case RawKind::kCurrent:
        needs(signal.constant, "constant", "the torque constant, N m/A");
        break;
      case RawKind::kPercent:
        needs(signal.rated, "rated", "the torque at 100 %, N m");
        break;
    }
    if (known->kind != RawKind::kCurrent && !signal.constant.empty()) {
      lookup.fail(signal.place, fmt::format("found 'constant', and {} is in {}, expected A or mA",
                                            runtime::quoted(columns[j].name), unit));
    }
    conversions_.push_back(known->conversion);
    factors_.push_back(factor);
  }
  if (quantity == ColumnQuantity::kTemperature) {
    offsets_.assign(columns.size(), 0);
    measured_.resize(static_cast<Index>(columns.size()));
    return;
  }
  set_sides(map, signal, columns.size(), quantity == ColumnQuantity::kTorque);
}

void JointTransform::to_joints(double* joints) const {
  if (matrix_.size() == 0) {
    std::copy(measured_.begin(), measured_.end(), joints);
  } else {
    multiply(matrix_, measured_, joints);
  }
  for (std::size_t j = 0; j < offsets_.size(); ++j) joints[j] += offsets_[j];
}

void JointTransform::apply(const double* raw, double* joints) const {
  for (std::size_t j = 0; j < conversions_.size(); ++j) {
    measured_[static_cast<Index>(j)] = conversions_[j](raw[j]) * factors_[j];
  }
  to_joints(joints);
}

DutyTransform::DutyTransform(const ImportMap& map, const SignalMap& signal, std::size_t joints)
    : law_(*signal.duty),
      constant_(signal.constant),
      sign_(signal.sign),
      gain_(signal.gain),
      efficiency_(signal.efficiency),
      joints_(joints),
      speeds_(side_matrix(map, signal, joints)) {
  torque_.set_sides(map, signal, joints, true);
}

void DutyTransform::apply(const double* duty, const double* voltage, const double* dq,
                          double* tau) const {
  for (std::size_t j = 0; j < joints_; ++j) {
    const auto row = static_cast<Index>(j);
    double speed = 0;
    if (speeds_.size() == 0) {
      speed = dq[j];
    } else {
      for (Index i = 0; i < speeds_.cols(); ++i) {
        if (speeds_(row, i) != 0) speed += speeds_(row, i) * dq[i];
      }
    }
    const double constant = of_joint(constant_, j, 1);
    const double supplied =
        of_joint(sign_, j, 1) * duty[j] / of_joint(law_.full_scale, j, 1) * voltage[j];
    torque_.measured_[row] = constant * of_joint(gain_, j, 1) * of_joint(efficiency_, j, 1) *
                             (supplied - of_joint(law_.back_emf, j, constant) * speed) /
                             of_joint(law_.resistance, j, 1);
  }
  torque_.to_joints(tau);
}

}  // namespace dyngen::runtime
