// SPDX-License-Identifier: MIT
#include "tests/blind/simulation/loop.h"

#include <cmath>
#include <memory>

namespace blind {

using Eigen::Index;
using Eigen::VectorXd;

void close_loop(Plant& plant, const LoopOptions& options, const Engine& believed,
                const VectorXd& armature, const VectorXd& inertia, const VectorXd& friction,
                const Motion& motion) {
  const Index n = plant.joints();
  const double w = options.bandwidth;
  const std::vector<Index> drive = plant.drive;
  const auto measured = [drive, n](const Moment& m, VectorXd& q, VectorXd& dq) {
    for (Index j = 0; j < n; ++j) {
      const Index c = drive[static_cast<std::size_t>(j)];
      const double since = m.t - m.t_error;
      q[j] = m.x[c] + m.q_error[j] + since * m.q_error_rate[j];
      dq[j] = m.v[c] + m.dq_error[j] + since * m.dq_error_rate[j];
    }
  };
  const Index first = static_cast<Index>(plant.states.size());
  if (options.kind == Loop::kPid) {
    for (Index j = 0; j < n; ++j) {
      plant.states.push_back({0, [=](const Moment& m) {
                                const Index c = drive[static_cast<std::size_t>(j)];
                                return motion.at(m.t).q[j] - m.x[c] - m.q_error[j];
                              }});
    }
  }
  plant.command = [=, dynamics = std::make_shared<Dynamics>()](const Moment& m) -> VectorXd {
    const Wanted wanted = motion.at(m.t);
    VectorXd q(n), dq(n);
    measured(m, q, dq);
    const VectorXd e = wanted.q - q, de = wanted.dq - dq;
    if (options.kind == Loop::kComputedTorque) {
      believed.dynamics(q, dq, *dynamics);
      dynamics->M.diagonal() += armature;
      VectorXd tau = dynamics->M * (wanted.ddq + w * w * e + 2 * w * de) + dynamics->bias;
      for (Index j = 0; j < n; ++j) tau[j] += friction[j] * std::tanh(wanted.dq[j] / 0.05);
      return tau;
    }
    // gravity is compensated where the arm should be
    believed.dynamics(wanted.q, VectorXd::Zero(n), *dynamics);
    VectorXd tau = dynamics->bias + inertia.cwiseProduct(w * w * e + 2 * w * de);
    if (options.kind == Loop::kPid) {
      tau += inertia.cwiseProduct(0.3 * w * w * w * m.z.segment(first, n));
    }
    return tau;
  };
}

}  // namespace blind
