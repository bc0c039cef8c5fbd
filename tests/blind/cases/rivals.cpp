// SPDX-License-Identifier: MIT
#include "tests/blind/cases/rivals.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

using Eigen::MatrixXd;

/// Columns of one joint's torque, (N x k), or of all joints' where `spread` is set, (N j x k).
struct Rival {
  std::string family;
  bool spread = false;
  std::function<MatrixXd(const Machine& machine, const Log& log, Index joint)> columns;
};

VectorXd rate_of(const VectorXd& values, double rate) {
  VectorXd result = VectorXd::Zero(values.size());
  for (Index k = 1; k + 1 < values.size(); ++k) {
    result[k] = (values[k + 1] - values[k - 1]) * rate / 2;
  }
  return result;
}

Rival of_samples(const std::string& family,
                 std::function<double(const Machine&, const Log&, Index k, Index j)> value) {
  return {family, false,
          [value = std::move(value)](const Machine& machine, const Log& log, Index j) {
            MatrixXd column(log.q.rows(), 1);
            for (Index k = 0; k < column.rows(); ++k) column(k, 0) = value(machine, log, k, j);
            return column;
          }};
}

/// Friction that builds up over a distance: Dahl's, less its end value.
MatrixXd dahl(const Log& log, Index j, double reach) {
  MatrixXd column(log.q.rows(), 1);
  double z = 0;
  for (Index k = 0; k < column.rows(); ++k) {
    const double step = log.dq(k, j) / log.rate;
    const double end = step > 0 ? 1 : -1;
    z = end + (z - end) * std::exp(-std::abs(step) / reach);
    column(k, 0) = z - log.sign(k, j);
  }
  return column;
}

/// All joints' torque by a lag of what the motor shows behind its link, or before it.
MatrixXd by_windup(const Log& log, Index j, const VectorXd& windup) {
  const Index n = log.q.cols(), samples = log.q.rows();
  const VectorXd push = rate_of(rate_of(windup, log.rate), log.rate);
  MatrixXd column(samples * n, 1);
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < samples; ++k) column(i * samples + k, 0) = log.M[at(k)](i, j) * push[k];
  }
  return column;
}

/// What a second-order resonance adds to the load.
VectorXd swing(const Log& log, Index j, double f) {
  const double w = 2 * kPi * f, h = 1 / log.rate, zeta = 0.03;
  VectorXd result(log.q.rows());
  double x = log.load(0, j), v = 0;
  for (Index k = 0; k < result.size(); ++k) {
    result[k] = x - log.load(k, j);
    constexpr int kParts = 8;
    for (int part = 0; part < kParts; ++part) {
      v += h / kParts * (w * w * (log.load(k, j) - x) - 2 * zeta * w * v);
      x += h / kParts * v;
    }
  }
  return result;
}

/// Change of all torques by a change of the tree or of the positions, (N j x 1).
MatrixXd difference(const Machine& machine, const Log& log,
                    const std::function<void(double, Tree&, Log&)>& change) {
  constexpr double kStep = 1e-5;
  MatrixXd column;
  for (const double side : {1.0, -1.0}) {
    Machine other = machine;
    Log moved = log;
    change(side * kStep, other.tree, moved);
    const VectorXd torque = base_torque(other, moved);
    if (column.size() == 0) {
      column = torque;
    } else {
      column = (column - torque) / (2 * kStep);
    }
  }
  return column;
}

std::vector<Rival> rivals() {
  std::vector<Rival> all;
  for (const double part : {0.02, 0.06, 0.15}) {
    all.push_back(of_samples("stribeck", [=](const Machine& m, const Log& l, Index k, Index j) {
      return l.sign(k, j) * std::exp(-std::abs(l.dq(k, j)) / (part * m.arm.v_max[j]));
    }));
    all.push_back(
        of_samples("nonlinear_viscous", [=](const Machine& m, const Log& l, Index k, Index j) {
          return std::tanh(l.dq(k, j) / (3 * part * m.arm.v_max[j]));
        }));
  }
  all.push_back(of_samples("nonlinear_viscous", [](const Machine&, const Log& l, Index k, Index j) {
    return std::pow(l.dq(k, j), 3);
  }));
  all.push_back(of_samples("asymmetric_viscous", [](const Machine&, const Log& l, Index k,
                                                    Index j) { return std::abs(l.dq(k, j)); }));
  all.push_back(of_samples("quadratic_drag", [](const Machine&, const Log& l, Index k, Index j) {
    return l.dq(k, j) * std::abs(l.dq(k, j));
  }));
  all.push_back(of_samples("load_friction", [](const Machine&, const Log& l, Index k, Index j) {
    return l.sign(k, j) * std::abs(l.load(k, j));
  }));
  all.push_back({"position_friction", false, [](const Machine&, const Log& l, Index j) {
                   MatrixXd columns(l.q.rows(), 4);
                   for (int h = 1; h <= 2; ++h) {
                     columns.col(2 * h - 2) =
                         l.sign.col(j).array() * (h * l.q.col(j).array()).cos();
                     columns.col(2 * h - 1) =
                         l.sign.col(j).array() * (h * l.q.col(j).array()).sin();
                   }
                   return columns;
                 }});
  for (const double part : {0.2, 0.6, 2.0}) {
    all.push_back({"thermal_drift", false, [=](const Machine&, const Log& l, Index j) {
                     const VectorXd t = VectorXd::LinSpaced(l.q.rows(), 0, 1);
                     MatrixXd columns(l.q.rows(), 2);
                     columns.col(0) = (-t.array() / part).exp() * l.dq.col(j).array();
                     columns.col(1) = (-t.array() / part).exp() * l.sign.col(j).array();
                     return columns;
                   }});
  }
  for (const double reach : {5e-4, 3e-3, 2e-2}) {
    all.push_back({"presliding", false,
                   [=](const Machine&, const Log& l, Index j) { return dahl(l, j, reach); }});
  }
  all.push_back({"joint_elasticity", true, [](const Machine&, const Log& l, Index j) {
                   return by_windup(l, j, l.load.col(j));
                 }});
  for (const double part : {0.05, 0.3}) {
    all.push_back({"backlash", true, [=](const Machine&, const Log& l, Index j) {
                     const double flank = part * l.load.col(j).cwiseAbs().mean();
                     return by_windup(l, j, (l.load.col(j).array() / flank).tanh());
                   }});
  }
  for (const double f : {4.0, 6.0, 9.0, 13.0}) {
    all.push_back({"link_flexibility", false, [=](const Machine&, const Log& l, Index j) {
                     return MatrixXd(swing(l, j, f));
                   }});
  }
  all.push_back({"actuator_lag", false, [](const Machine&, const Log& l, Index j) {
                   return MatrixXd(rate_of(l.recorded.col(j), l.rate));
                 }});
  all.push_back({"time_delay", false, [](const Machine&, const Log& l, Index j) {
                   return MatrixXd(rate_of(l.recorded.col(j), l.rate));
                 }});
  all.push_back(of_samples("torque_gain", [](const Machine&, const Log& l, Index k, Index j) {
    return l.recorded(k, j);
  }));
  all.push_back(of_samples("torque_saturation", [](const Machine&, const Log& l, Index k, Index j) {
    return std::pow(l.recorded(k, j), 3);
  }));
  all.push_back(of_samples("gain_drift", [](const Machine&, const Log& l, Index k, Index j) {
    return l.recorded(k, j) * static_cast<double>(k);
  }));
  all.push_back(of_samples("sensor_drift", [](const Machine&, const Log&, Index k, Index) {
    return static_cast<double>(k);
  }));
  all.push_back({"cable", false, [](const Machine&, const Log& l, Index j) {
                   MatrixXd columns(l.q.rows(), 3);
                   for (int p = 1; p <= 3; ++p) columns.col(p - 1) = l.q.col(j).array().pow(p);
                   return columns;
                 }});
  all.push_back(of_samples(
      "gravity_spring", [](const Machine&, const Log& l, Index k, Index j) { return l.q(k, j); }));
  all.push_back({"encoder_offset", true, [](const Machine& m, const Log& l, Index j) {
                   return difference(
                       m, l, [j](double step, Tree&, Log& log) { log.q.col(j).array() += step; });
                 }});
  all.push_back({"geometry_error", true, [](const Machine& m, const Log& l, Index j) {
                   return difference(m, l, [j](double step, Tree& tree, Log&) {
                     tree.links[at(j)].position.x() += step;
                   });
                 }});
  all.push_back({"base_tilt", true, [](const Machine& m, const Log& l, Index) {
                   const Eigen::Vector3d down = m.tree.gravity.normalized();
                   const Eigen::Vector3d a = down.unitOrthogonal(), b = down.cross(a);
                   MatrixXd columns(l.q.size(), 2);
                   for (int c = 0; c < 2; ++c) {
                     columns.col(c) = difference(m, l, [&](double step, Tree& tree, Log&) {
                       tree.gravity += step * (c == 0 ? a : b);
                     });
                   }
                   return columns;
                 }});
  return all;
}

/// Share of the squares of `left` that columns follow, themselves less what the refit takes.
double share(const std::vector<MatrixXd>& columns, const Refit& refit,
             const std::vector<VectorXd>& left) {
  const Index k = columns.front().cols();
  std::vector<std::vector<VectorXd>> free;
  for (Index c = 0; c < k; ++c) {
    std::vector<VectorXd> rows;
    for (const MatrixXd& part : columns) rows.emplace_back(part.col(c));
    free.push_back(refit.residual(rows));
  }
  MatrixXd gram(k, k);
  VectorXd right(k);
  for (Index a = 0; a < k; ++a) {
    const auto inner = [&](const std::vector<VectorXd>& x, const std::vector<VectorXd>& y) {
      double sum = 0;
      for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].dot(y[i]);
      return sum;
    };
    for (Index b = 0; b < k; ++b) gram(a, b) = inner(free[at(a)], free[at(b)]);
    right[a] = inner(free[at(a)], left);
  }
  const VectorXd answer = gram.completeOrthogonalDecomposition().solve(right);
  return std::clamp(answer.dot(right) / squares(left), 0.0, 1.0);
}

}  // namespace

std::map<std::string, double> imitated_shares(const Machine& machine, const Truth& truth,
                                              const std::vector<Recording>& training,
                                              const Whitener& whitener, const Refit& refit,
                                              const std::vector<VectorXd>& left) {
  std::vector<Index> joints;
  for (Index j = 0; j < machine.joints(); ++j) {
    if (truth.joint == 0 || j + 1 == truth.joint || j + 1 == truth.other) joints.push_back(j);
  }
  std::vector<RestWhitener> white;
  for (const Recording& each : training) white.emplace_back(whitener, each.log);
  std::map<std::string, double> shares;
  for (const Rival& rival : rivals()) {
    if (rival.family == truth.family) continue;
    double& best = shares[rival.family];
    for (const Index joint : joints) {
      std::vector<MatrixXd> columns;
      for (std::size_t i = 0; i < training.size(); ++i) {
        const Recording& each = training[i];
        const MatrixXd own = rival.columns(machine, each.log, joint);
        MatrixXd rows = MatrixXd::Zero(each.log.q.size(), own.cols());
        if (rival.spread) {
          rows = own;
        } else {
          rows.middleRows(joint * each.log.q.rows(), each.log.q.rows()) = own;
        }
        columns.push_back(white[i](rows));
      }
      best = std::max(best, share(columns, refit, left));
    }
  }
  return shares;
}

}  // namespace blind
