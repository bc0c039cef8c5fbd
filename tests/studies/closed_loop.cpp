// SPDX-License-Identifier: MIT
#include "tests/studies/closed_loop.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::Recording;

std::vector<double> list(const VectorXd& v) { return {v.data(), v.data() + v.size()}; }
VectorXd vector(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(v.size()));
}

class Plant {
 public:
  Plant(const NumericRobot& robot, const FourierMotion::State& start)
      : robot_(robot), q_(start.q), dq_(start.dq), ddq_(start.ddq) {
    const Index n = q_.size();
    IA_.resize(n);
    Fs_.resize(n);
    Fv_.resize(n);
    off_.resize(n);
    for (Index j = 0; j < n; ++j) {
      const NumericJoint& joint = robot.joints[static_cast<std::size_t>(j)];
      IA_[j] = joint.IA;
      Fs_[j] = joint.Fs;
      Fv_[j] = joint.Fv;
      off_[j] = joint.off;
    }
    renew();
  }

  const VectorXd& q() const { return q_; }
  const VectorXd& dq() const { return dq_; }
  /// Right after the torque u was put on.
  VectorXd acceleration(const VectorXd& u) {
    decide(u);
    return solve(q_, dq_, u, ddq_);
  }

  void advance(const VectorXd& u, double time) {
    if (++steps_ % 4 == 0) renew();
    decide(u);
    int reversals = 0;
    while (time > 0) {
      VectorXd q = q_, dq = dq_;
      runge_kutta(u, time, q, dq);
      Index joint = -1;
      double part = 1;
      for (Index j = 0; j < dq.size(); ++j) {
        if (Fs_[j] == 0 || direction_[j] * dq[j] >= 0) continue;
        const double at = dq_[j] / (dq_[j] - dq[j]);
        if (at < part) {
          part = at;
          joint = j;
        }
      }
      if (joint < 0 || ++reversals > 20) {
        q_ = q;
        dq_ = dq;
        break;
      }
      runge_kutta(u, part * time, q_, dq_);
      time *= 1 - part;
      dq_[joint] = 0;
      direction_[joint] = 0;
      decide(u);
    }
    if (!q_.allFinite()) throw std::runtime_error("simulate(): the motion does not stay finite");
  }

 private:
  void renew() {
    M_ = mass_matrix(robot_, list(q_));
    factored_ = false;
  }

  /// Joints that stand stay where they are if friction can hold them.
  void decide(const VectorXd& u) {
    direction_ = dq_.cwiseSign();
    if ((direction_.array() != 0).all()) return;
    const VectorXd ddq = solve(q_, dq_, u, ddq_);
    const VectorXd held = u - torque(q_, dq_, ddq);
    for (Index j = 0; j < dq_.size(); ++j) {
      if (direction_[j] == 0 && std::abs(held[j]) > Fs_[j]) direction_[j] = held[j] > 0 ? 1 : -1;
    }
  }

  VectorXd torque(const VectorXd& q, const VectorXd& dq, const VectorXd& ddq) const {
    VectorXd tau = vector(id_rigid(robot_, list(q), list(dq), list(ddq)));
    tau += IA_.cwiseProduct(ddq) + Fv_.cwiseProduct(dq) + off_ + Fs_.cwiseProduct(direction_);
    return tau;
  }

  VectorXd solve(const VectorXd& q, const VectorXd& dq, const VectorXd& u, VectorXd ddq) {
    const auto stands = (direction_.array() == 0).eval();
    if (!factored_ || (stands != factored_stands_).any()) {
      MatrixXd M = M_;
      for (Index j = 0; j < M.rows(); ++j) {
        if (!stands[j]) continue;
        M.row(j).setZero();
        M.col(j).setZero();
        M(j, j) = 1;
      }
      ldlt_.compute(M);
      if (!ldlt_.isPositive()) throw std::runtime_error("simulate(): M is not positive definite");
      factored_ = true;
      factored_stands_ = stands;
    }
    ddq = stands.select(0.0, ddq);
    for (int round = 0; round < 20; ++round) {
      const VectorXd tau = torque(q, dq, ddq);
      const VectorXd left = stands.select(0.0, u - tau);
      ddq += ldlt_.solve(left);
      if (left.cwiseAbs().maxCoeff() < 1e-9 * (1 + tau.cwiseAbs().maxCoeff())) break;
    }
    return ddq_ = ddq;
  }

  void runge_kutta(const VectorXd& u, double h, VectorXd& q, VectorXd& dq) {
    const VectorXd a1 = solve(q, dq, u, ddq_);
    const VectorXd v2 = dq + h / 2 * a1, a2 = solve(q + h / 2 * dq, v2, u, a1);
    const VectorXd v3 = dq + h / 2 * a2, a3 = solve(q + h / 2 * v2, v3, u, a2);
    const VectorXd v4 = dq + h * a3, a4 = solve(q + h * v3, v4, u, a3);
    q += h / 6 * (dq + 2 * v2 + 2 * v3 + v4);
    dq += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }

  const NumericRobot& robot_;
  VectorXd IA_, Fs_, Fv_, off_;
  VectorXd q_, dq_, ddq_;
  VectorXd direction_;  ///< of sliding; 0: the joint stands
  MatrixXd M_;
  bool factored_ = false;
  Eigen::Array<bool, Eigen::Dynamic, 1> factored_stands_;
  Eigen::LDLT<MatrixXd> ldlt_;
  int steps_ = 0;
};

/// Noise of recorded torque: white and AR(1).
class TorqueNoise {
 public:
  TorqueNoise(const ClosedLoopOptions& options, unsigned seed)
      : options_(options), random_(seed), state_(VectorXd::Zero(options.torque_noise.size())) {}

  VectorXd next() {
    const double kick = std::sqrt(options_.coloured_part * (1 - options_.pole * options_.pole));
    const double white = std::sqrt(1 - options_.coloured_part);
    VectorXd noise(state_.size());
    for (Index j = 0; j < noise.size(); ++j) {
      state_[j] = options_.pole * state_[j] + kick * normal_(random_);
      noise[j] = state_[j] + white * normal_(random_);
      if (uniform_(random_) < options_.wild_part) {
        const double size = 10 + 30 * uniform_(random_);
        noise[j] += uniform_(random_) < 0.7 ? size : -size;
      }
    }
    return noise.cwiseProduct(options_.torque_noise);
  }

 private:
  const ClosedLoopOptions& options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  VectorXd state_;
};

class Controller {
 public:
  Controller(const ClosedLoopOptions& options, const FourierMotion::State& start)
      : options_(options), before_(start.q), dq_(start.dq) {}

  VectorXd torque(const VectorXd& measured, const FourierMotion::State& reference) {
    const double h = options_.sample_time;
    const double forget = std::exp(-2 * std::numbers::pi * options_.velocity_hz * h);
    dq_ = forget * dq_ + (1 - forget) / h * (measured - before_);
    before_ = measured;
    VectorXd u = options_.stiffness.cwiseProduct(reference.q - measured) +
                 options_.damping.cwiseProduct(reference.dq - dq_);
    if (options_.feedforward) {
      u += vector(
          id(*options_.feedforward, list(reference.q), list(reference.dq), list(reference.ddq)));
    }
    return u;
  }

 private:
  const ClosedLoopOptions& options_;
  VectorXd before_, dq_;
};

VectorXd rounded(const VectorXd& q, const VectorXd& step) {
  VectorXd result = q;
  for (Index j = 0; j < q.size(); ++j) {
    if (step[j] > 0) result[j] = step[j] * std::round(q[j] / step[j]);
  }
  return result;
}

Recording empty_recording(Index samples, Index joints, const char* name) {
  Recording recording;
  recording.file_name = name;
  recording.time.resize(samples);
  recording.q.resize(samples, joints);
  recording.dq.resize(samples, joints);
  recording.ddq.resize(samples, joints);
  recording.tau.resize(samples, joints);
  recording.run_starts = {0};
  return recording;
}

void put(const FourierMotion::State& state, Index row, Recording& recording) {
  recording.q.row(row) = state.q;
  recording.dq.row(row) = state.dq;
  recording.ddq.row(row) = state.ddq;
}

}  // namespace

ClosedLoopRun simulate(const NumericRobot& robot, const FourierMotion& motion,
                       const ClosedLoopOptions& options, unsigned seed) {
  const double h = options.sample_time;
  const Index lead = std::llround(options.lead_in / h), n = motion.centre.size();
  const Index samples = std::llround(options.seconds / h);
  ClosedLoopRun run;
  run.truth = empty_recording(samples, n, "truth");
  run.reference = empty_recording(samples, n, "reference");
  run.measured = empty_recording(samples, n, "measured");
  run.measured.tau_sim.resize(samples, n);

  const FourierMotion::State start = motion.at(-options.lead_in);
  Plant plant(robot, start);
  Controller controller(options, start);
  TorqueNoise noise(options, seed);
  VectorXd u = VectorXd::Zero(n);
  for (Index k = -lead; k < samples; ++k) {
    const double time = static_cast<double>(k) * h;
    const FourierMotion::State reference = motion.at(time);
    const VectorXd measured = rounded(plant.q(), options.encoder_step);
    const VectorXd before = u;
    u = controller.torque(measured, reference);
    const VectorXd error = noise.next();
    if (k >= 0) {
      const VectorXd tau = options.centred_torque ? ((before + u) / 2).eval() : u;
      run.measured.time[k] = run.truth.time[k] = run.reference.time[k] = time;
      run.measured.q.row(k) = measured;
      run.measured.tau_sim.row(k) = tau;
      run.measured.tau.row(k) = tau + error;
      put({plant.q(), plant.dq(), plant.acceleration(tau)}, k, run.truth);
      put(reference, k, run.reference);
    }
    plant.advance(u, h);
  }
  run.truth.tau = run.reference.tau = run.measured.tau;
  run.measured.dq.resize(0, 0);
  run.measured.ddq.resize(0, 0);
  return run;
}

void set_gains(const NumericRobot& robot, const VectorXd& q, double hz,
               ClosedLoopOptions& options) {
  const double w = 2 * std::numbers::pi * hz;
  const MatrixXd M = mass_matrix(robot, list(q));
  options.stiffness = w * w * M.diagonal();
  options.damping = 2 * w * M.diagonal();
}

Recording clean_recording(const NumericRobot& robot, const FourierMotion& motion, double seconds,
                          double sample_time) {
  const Index samples = std::llround(seconds / sample_time);
  Recording recording = empty_recording(samples, motion.centre.size(), "clean");
  for (Index k = 0; k < samples; ++k) {
    recording.time[k] = static_cast<double>(k) * sample_time;
    const FourierMotion::State state = motion.at(recording.time[k]);
    put(state, k, recording);
    recording.tau.row(k) = vector(id(robot, list(state.q), list(state.dq), list(state.ddq)));
  }
  return recording;
}

}  // namespace dyngen::test
