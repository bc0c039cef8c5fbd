// SPDX-License-Identifier: MIT
#include "tests/blind/cases/strength.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

using Eigen::MatrixXd;

constexpr double kSmooth = 0.12;  // of a frequency: lines on each side whose mean is its power

/// Ten point masses of 1 kg whose pseudo-inertias span all.
std::vector<Inertia> point_masses() {
  std::vector<Inertia> points;
  const auto add = [&](double x, double y, double z) {
    Inertia point;
    point.mass = 1;
    point.com = Eigen::Vector3d(x, y, z);
    points.push_back(point);
  };
  add(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(k), f = Eigen::Vector3d::Unit((k + 1) % 3);
    add(e.x(), e.y(), e.z());
    add(-e.x(), -e.y(), -e.z());
    add(e.x() + f.x(), e.y() + f.y(), e.z() + f.z());
  }
  return points;
}

VectorXd whitened(const VectorXd& values, const VectorXd& deviation) {
  Eigen::FFT<double> fft;
  std::vector<double> time(values.begin(), values.end());
  std::vector<std::complex<double>> lines;
  fft.fwd(lines, time);
  const double n = static_cast<double>(time.size());
  const double last = static_cast<double>(deviation.size() - 1);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double line = std::min(static_cast<double>(k), n - static_cast<double>(k));
    const double place = line / (n / 2) * last;
    const Index low = std::min<Index>(static_cast<Index>(place), deviation.size() - 2);
    const double share = place - static_cast<double>(low);
    lines[k] /= (1 - share) * deviation[low] + share * deviation[low + 1];
  }
  fft.inv(time, lines);
  return Eigen::Map<VectorXd>(time.data(), static_cast<Index>(time.size()));
}

/// Error of the equations: of the torque, and of the acceleration that positions give.
MatrixXd equation_error(const Recording& recording) {
  const MatrixXd& n = recording.encoder_error;
  MatrixXd error = recording.torque_noise;
  const double square = recording.log.rate * recording.log.rate;
  for (Index k = 1; k + 1 < n.rows(); ++k) {
    const VectorXd ddn = (n.row(k + 1) - 2 * n.row(k) + n.row(k - 1)).transpose() * square;
    error.row(k) -= (recording.log.M[at(k)] * ddn).transpose();
  }
  return error;
}

}  // namespace

MatrixXd base_columns(const Machine& machine, const Log& log) {
  const Index n = machine.joints(), samples = log.q.rows();
  MatrixXd columns = MatrixXd::Zero(samples * n, 14 * n);
  const auto torque = torque_of_each(machine.tree, point_masses());
  for (Index k = 0; k < samples; ++k) {
    const MatrixXd each = torque(log.q.row(k), log.dq.row(k), log.ddq.row(k));
    for (Index j = 0; j < n; ++j) columns.row(j * samples + k).head(10 * n) = each.row(j);
  }
  for (Index j = 0; j < n; ++j) {
    const Index own = 10 * n + 4 * j;
    columns.block(j * samples, own, samples, 1) = log.ddq.col(j);
    columns.block(j * samples, own + 1, samples, 1) = log.sign.col(j);
    columns.block(j * samples, own + 2, samples, 1) = log.dq.col(j);
    columns.block(j * samples, own + 3, samples, 1).setOnes();
  }
  return columns;
}

VectorXd base_torque(const Machine& machine, const Log& log) {
  const Engine engine = mujoco_engine(machine.tree);
  MatrixXd tau(log.q.rows(), machine.joints());
  for (Index k = 0; k < tau.rows(); ++k) {
    tau.row(k) = engine.inverse(log.q.row(k), log.dq.row(k), log.ddq.row(k)) + machine.offset +
                 machine.armature.cwiseProduct(log.ddq.row(k).transpose()) +
                 machine.coulomb.cwiseProduct(log.sign.row(k).transpose()) +
                 machine.viscous.cwiseProduct(log.dq.row(k).transpose());
  }
  return torque_rows(tau);
}

void leave_out_rest(const Log& log, Eigen::Ref<MatrixXd> rows) {
  const Index samples = log.q.rows();
  for (Index j = 0; j < log.q.cols(); ++j) {
    for (Index k = 0; k < samples; ++k) {
      if (std::abs(log.sign(k, j)) < 1) rows.row(j * samples + k).setZero();
    }
  }
}

VectorXd torque_rows(const MatrixXd& by_joint) {
  return Eigen::Map<const VectorXd>(by_joint.data(), by_joint.size());
}

Whitener::Whitener(const std::vector<Recording>& training) {
  const Index joints = training.front().log.q.cols(), samples = training.front().log.q.rows();
  MatrixXd power = MatrixXd::Zero(samples / 2 + 1, joints);
  Eigen::FFT<double> fft;
  VectorXd window(samples);
  for (Index k = 0; k < samples; ++k) {
    const double turn = 2 * kPi * static_cast<double>(k) / static_cast<double>(samples);
    window[k] = 0.5 - 0.5 * std::cos(turn);
  }
  const double scale = window.squaredNorm() * static_cast<double>(training.size());
  for (const Recording& recording : training) {
    const MatrixXd error = equation_error(recording);
    for (Index j = 0; j < joints; ++j) {
      const VectorXd part = error.col(j).cwiseProduct(window);
      std::vector<double> time(part.begin(), part.end());
      std::vector<std::complex<double>> lines;
      fft.fwd(lines, time);
      for (Index k = 0; k < power.rows(); ++k) power(k, j) += std::norm(lines[at(k)]) / scale;
    }
  }
  // the mean over lines near in their logarithm: what is slow has few of them
  MatrixXd sum = MatrixXd::Zero(power.rows() + 1, joints);
  for (Index k = 0; k < power.rows(); ++k) sum.row(k + 1) = sum.row(k) + power.row(k);
  deviation_.resize(power.rows(), joints);
  for (Index k = 0; k < power.rows(); ++k) {
    const auto reach = static_cast<Index>(2 + kSmooth * static_cast<double>(k));
    const Index from = std::max<Index>(0, k - reach);
    const Index to = std::min<Index>(power.rows(), k + reach + 1);
    deviation_.row(k) =
        ((sum.row(to) - sum.row(from)) / static_cast<double>(to - from)).cwiseSqrt();
  }
}

VectorXd Whitener::column(Index joint, const VectorXd& values) const {
  return whitened(values, deviation_.col(joint));
}

MatrixXd Whitener::operator()(const MatrixXd& rows) const {
  const Index joints = deviation_.cols(), samples = rows.rows() / joints;
  MatrixXd result(rows.rows(), rows.cols());
  for (Index c = 0; c < rows.cols(); ++c) {
    for (Index j = 0; j < joints; ++j) {
      const auto part = rows.col(c).segment(j * samples, samples);
      if (part.isZero(0)) {
        result.col(c).segment(j * samples, samples).setZero();
      } else {
        result.col(c).segment(j * samples, samples) = column(j, part);
      }
    }
  }
  return result;
}

Refit::Refit(std::vector<MatrixXd> whitened) : columns_(std::move(whitened)) {
  const Index n = columns_.front().cols();
  MatrixXd gram = MatrixXd::Zero(n, n);
  for (const MatrixXd& part : columns_) {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(part.transpose());
  }
  gram = gram.selfadjointView<Eigen::Lower>();
  scale_ = gram.diagonal().cwiseSqrt();
  for (double& each : scale_) each = each > 0 ? 1 / each : 0;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale_.asDiagonal() * gram *
                                                      scale_.asDiagonal());
  VectorXd values = eigen.eigenvalues();
  for (double& each : values) each = each > 1e-11 * values.maxCoeff() ? 1 / each : 0;
  inverse_ = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

VectorXd Refit::solve(const std::vector<VectorXd>& rows) const {
  VectorXd answer = VectorXd::Zero(scale_.size());
  std::vector<VectorXd> left = rows;
  for (int round = 0; round < 3; ++round) {  // the Gram matrix squares the condition
    VectorXd right = VectorXd::Zero(scale_.size());
    for (std::size_t i = 0; i < left.size(); ++i) right += columns_[i].transpose() * left[i];
    answer += scale_.cwiseProduct(inverse_ * scale_.cwiseProduct(right));
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = rows[i] - columns_[i] * answer;
  }
  return answer;
}

std::vector<VectorXd> Refit::residual(const std::vector<VectorXd>& rows) const {
  const VectorXd answer = solve(rows);
  std::vector<VectorXd> left = rows;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= columns_[i] * answer;
  return left;
}

double squares(const std::vector<VectorXd>& rows) {
  double sum = 0;
  for (const VectorXd& each : rows) sum += each.squaredNorm();
  return sum;
}

}  // namespace blind
