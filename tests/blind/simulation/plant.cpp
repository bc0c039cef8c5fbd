// SPDX-License-Identifier: MIT
#include "tests/blind/simulation/plant.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kEventsAStep = 40;  // more is chatter: the step is taken as it is
constexpr int kLoadRounds = 4;    // friction reads the load, the load the acceleration

/// Rates of everything, and the dry friction that acts.
struct Rates {
  VectorXd a, z;
  VectorXd dry;       // of each friction, with its sign
  VectorXd strength;  // of each friction
  MatrixXd M;         // with armatures
};

/// Runge and Kutta's fourth order between the moments at which dry friction turns, sticks or
/// slips; which frictions slip where is known within a step.
class Simulation {
 public:
  Simulation(Plant& plant, const VectorXd& x0, const VectorXd& v0) : plant_(plant) {
    now_.x = x0;
    now_.v = v0;
    const Index joints = plant.joints();
    for (VectorXd* zero : {&now_.command, &now_.acting, &now_.load, &now_.dry, &now_.q_error,
                           &now_.dq_error, &now_.q_error_rate, &now_.dq_error_rate}) {
      *zero = VectorXd::Zero(joints);
    }
    now_.z.resize(static_cast<Index>(plant.states.size()));
    for (Index i = 0; i < now_.z.size(); ++i) now_.z[i] = plant.states[at(i)].start;
    slip_.resize(plant.friction.size());
    for (std::size_t e = 0; e < slip_.size(); ++e) {
      const double speed = plant.friction[e].along.dot(v0);
      slip_[e] = speed > 0 ? 1 : speed < 0 ? -1 : 0;
    }
    settle();
  }

  Moment& now() { return now_; }
  const Rates& rates() {
    derive(now_, here_);
    return here_;
  }

  void advance(double until, double step) {
    while (until - now_.t > 1e-12) {
      take(std::min(step, until - now_.t));
      refuse_beyond(now_, 1e3);
    }
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  double speed(std::size_t e) const { return plant_.friction[e].along.dot(now_.v); }

  static void refuse_beyond(const Moment& m, double speed) {
    if (m.x.allFinite() && m.v.allFinite() && m.v.cwiseAbs().maxCoeff() < speed) return;
    throw std::runtime_error("the simulated motion leaves 1e3 rad/s");
  }

  void derive(Moment& m, Rates& r) {
    const Index links = plant_.links;
    refuse_beyond(m, 1e6);  // between two samples; engines end the program on what is not finite
    plant_.engine.dynamics(m.x.head(links), m.v.head(links), dynamics_);
    r.M = plant_.armature.asDiagonal();
    r.M.topLeftCorner(links, links) += dynamics_.M;
    m.command = plant_.command(m);
    m.acting = plant_.acting ? plant_.acting(m) : m.command;
    force_ = -plant_.viscous.cwiseProduct(m.v);
    force_.head(links) -= dynamics_.bias;
    for (Index j = 0; j < plant_.joints(); ++j) force_[plant_.drive[at(j)]] += m.acting[j];
    for (const auto& add : plant_.forces) add(m, force_);
    factor_.compute(r.M);
    for (int round = 0; round < kLoadRounds; ++round) {
      const VectorXd load = m.load;
      rub(m, r);
      for (Index j = 0; j < plant_.joints(); ++j) {
        const Index c = plant_.carried[at(j)];
        m.load[j] = dynamics_.M.row(c).dot(r.a.head(links)) + dynamics_.bias[c];
        m.dry[j] = r.dry[j];
      }
      if ((m.load - load).cwiseAbs().maxCoeff() < 1e-9 * (1 + load.cwiseAbs().maxCoeff())) break;
    }
    m.a = r.a;
    r.z.resize(m.z.size());
    for (Index i = 0; i < r.z.size(); ++i) r.z[i] = plant_.states[at(i)].rate(m);
  }

  /// Accelerations where some frictions slip and the others hold their velocity.
  void rub(const Moment& m, Rates& r) {
    const std::size_t count = plant_.friction.size();
    r.dry.setZero(static_cast<Index>(count));
    r.strength.resize(static_cast<Index>(count));
    VectorXd force = force_;
    held_.clear();
    for (std::size_t e = 0; e < count; ++e) {
      const Index i = static_cast<Index>(e);
      r.strength[i] = std::max(0.0, plant_.friction[e].strength(m));
      if (slip_[e] == 0 && r.strength[i] > 0) {
        held_.push_back(e);
      } else {
        r.dry[i] = slip_[e] * r.strength[i];
        force -= plant_.friction[e].along * r.dry[i];
      }
    }
    r.a = factor_.solve(force);
    if (held_.empty()) return;
    MatrixXd D(static_cast<Index>(held_.size()), r.a.size());
    for (std::size_t h = 0; h < held_.size(); ++h) {
      D.row(static_cast<Index>(h)) = plant_.friction[held_[h]].along;
    }
    const MatrixXd answer = factor_.solve(D.transpose());
    const VectorXd holding = (D * answer).ldlt().solve(D * r.a);
    r.a -= answer * holding;
    for (std::size_t h = 0; h < held_.size(); ++h) {
      r.dry[static_cast<Index>(held_[h])] = holding[static_cast<Index>(h)];
    }
  }

  Moment moved(const Rates& r, double h) const {
    Moment next = now_;
    next.t += h;
    next.x += h * speed_;
    next.v += h * r.a;
    next.z += h * r.z;
    return next;
  }

  /// One step of the fourth order from now_; velocities of its stages are kept in speed_.
  Moment stepped(double h) {
    Rates k1, k2, k3, k4;
    Moment first = now_;
    derive(first, k1);
    const VectorXd v1 = now_.v;
    speed_ = v1;
    Moment m = moved(k1, h / 2);
    m.load = first.load;
    const VectorXd v2 = m.v;
    derive(m, k2);
    speed_ = v2;
    Moment n = moved(k2, h / 2);
    n.load = m.load;
    const VectorXd v3 = n.v;
    derive(n, k3);
    speed_ = v3;
    Moment o = moved(k3, h);
    o.load = n.load;
    const VectorXd v4 = o.v;
    derive(o, k4);
    Moment next = now_;
    next.t += h;
    next.x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    next.v += h / 6 * (k1.a + 2 * k2.a + 2 * k3.a + k4.a);
    next.z += h / 6 * (k1.z + 2 * k2.z + 2 * k3.z + k4.z);
    next.load = o.load;
    return next;
  }

  /// The first friction whose velocity turns within the step, and its share of it.
  std::pair<std::size_t, double> first_turn(const Moment& next) const {
    std::pair<std::size_t, double> first(slip_.size(), 2);
    for (std::size_t e = 0; e < slip_.size(); ++e) {
      if (slip_[e] == 0) continue;
      const double before = slip_[e] * speed(e);
      const double after = slip_[e] * plant_.friction[e].along.dot(next.v);
      if (after >= 0 || before <= 0) continue;
      const double share = before / (before - after);
      if (share < first.second) first = {e, share};
    }
    return first;
  }

  /// What has just let go and would turn at once is held through this step: letting go with a
  /// velocity of 0 that becomes one of the other direction, it would be pushed by its friction.
  bool hold_on(const Moment& next) {
    bool held = false;
    for (std::size_t e = 0; e < slip_.size(); ++e) {
      if (slip_[e] == 0 || slip_[e] * speed(e) > 0) continue;
      if (slip_[e] * plant_.friction[e].along.dot(next.v) >= 0) continue;
      stop(e);
      held = true;
    }
    return held;
  }

  void take(double h) {
    for (int events = 0; h > 1e-12 && events < kEventsAStep; ++events) {
      Moment next = stepped(h);
      while (hold_on(next)) next = stepped(h);
      auto [turned, share] = first_turn(next);
      double taken = h;
      for (int round = 0; turned < slip_.size() && round < 4; ++round) {
        // the velocity is nearly a line within a step: the secant of what is left
        const double part = taken * share;
        const Moment nearer = stepped(part);
        const double before = slip_[turned] * speed(turned);
        const double after = slip_[turned] * plant_.friction[turned].along.dot(nearer.v);
        next = nearer;
        taken = part;
        if (std::abs(after) < 1e-10) break;
        share = before / (before - after);
      }
      now_ = next;
      h -= taken;
      if (turned < slip_.size()) stop(turned);
      settle();
    }
    now_.t += std::max(h, 0.0);
  }

  /// A velocity that turns is 0 first.
  void stop(std::size_t e) {
    const VectorXd& along = plant_.friction[e].along;
    now_.v -= along * (along.dot(now_.v) / along.squaredNorm());
    slip_[e] = 0;
  }

  /// What is held by more than its strength slips.
  void settle() {
    for (std::size_t round = 0; round < slip_.size(); ++round) {
      derive(now_, here_);
      double worst = 1;
      std::size_t which = slip_.size();
      for (std::size_t e = 0; e < slip_.size(); ++e) {
        const Index i = static_cast<Index>(e);
        if (slip_[e] != 0 || here_.strength[i] <= 0) continue;
        const double excess = std::abs(here_.dry[i]) / here_.strength[i];
        if (excess > worst) worst = excess, which = e;
      }
      if (which == slip_.size()) return;
      slip_[which] = here_.dry[static_cast<Index>(which)] > 0 ? 1 : -1;
    }
  }

  Plant& plant_;
  Moment now_;
  std::vector<int> slip_;  // direction, 0: held
  std::vector<std::size_t> held_;
  Dynamics dynamics_;
  Rates here_;
  VectorXd force_, speed_;
  Eigen::LLT<MatrixXd> factor_;
};

}  // namespace

Index add_motor(Plant& plant, Index joint) {
  const Index link = plant.drive[static_cast<std::size_t>(joint)], motor = plant.coordinates();
  for (VectorXd* each : {&plant.armature, &plant.viscous}) {
    each->conservativeResize(motor + 1);
    (*each)[motor] = (*each)[link];
    (*each)[link] = 0;
  }
  for (Friction& friction : plant.friction) {
    friction.along.conservativeResize(motor + 1);
    friction.along[motor] = friction.along[link];
    friction.along[link] = 0;
  }
  plant.drive[static_cast<std::size_t>(joint)] = motor;
  return motor;
}

Log run(Plant& plant, const VectorXd& x0, const VectorXd& v0, const RunOptions& options,
        const std::function<void(const VectorXd& q, Moment& moment)>& errors) {
  const Index joints = plant.joints();
  const Index lead = static_cast<Index>(std::lround(options.lead * options.rate));
  const Index count = static_cast<Index>(std::lround(options.duration * options.rate));
  Log log;
  log.rate = options.rate;
  for (MatrixXd* part : {&log.q, &log.dq, &log.ddq, &log.recorded, &log.sign, &log.load}) {
    part->resize(count, joints);
  }
  Simulation simulation(plant, x0, v0);
  Moment& now = simulation.now();
  std::vector<Happening> ahead = plant.happenings;
  VectorXd q(joints);
  for (Index k = -lead; k < count; ++k) {
    for (Index j = 0; j < joints; ++j) q[j] = now.x[plant.drive[static_cast<std::size_t>(j)]];
    now.t = static_cast<double>(k) / options.rate;
    std::erase_if(ahead, [&](const Happening& one) {
      if (one.t > now.t) return false;
      one.act();
      return true;
    });
    if (errors) errors(q, now);
    if (k >= 0) {
      const Rates& rates = simulation.rates();
      MatrixXd M(joints, joints);
      for (Index j = 0; j < joints; ++j) {
        const Index c = plant.drive[static_cast<std::size_t>(j)];
        log.q(k, j) = q[j];
        log.dq(k, j) = now.v[c];
        log.ddq(k, j) = rates.a[c];
        log.sign(k, j) = rates.strength[j] > 0
                             ? rates.dry[j] / rates.strength[j]
                             : static_cast<double>((now.v[c] > 0) - (now.v[c] < 0));
        log.load(k, j) = now.load[j];
        for (Index i = 0; i < joints; ++i) {
          M(j, i) = rates.M(c, plant.drive[static_cast<std::size_t>(i)]);
        }
      }
      log.M.push_back(M);
      log.recorded.row(k) = plant.recorded ? plant.recorded(now) : now.command;
    }
    simulation.advance(static_cast<double>(k + 1) / options.rate, options.step);
  }
  return log;
}

}  // namespace blind
