// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>

#include "arm.h"
#ifdef CONSUMER_HAS_RUNTIME
#include "runtime/model/model_functions.h"
#endif

int main() {
  const double q[ARM_NQ] = {0, 0};
  double tau[ARM_NQ];
  arm_gravity(q, tau);
  std::printf("tau = %.4f %.4f\n", tau[0], tau[1]);
#ifdef CONSUMER_HAS_RUNTIME
  const dyngen::runtime::ModelFunctions arm{
      "arm",  ARM_NQ,      {arm_joint_names, arm_joint_names + ARM_NQ},
      arm_id, arm_gravity, arm_coriolis,
      arm_friction};
  arm.validate();
  const Eigen::VectorXd held = gravity(arm, Eigen::VectorXd::Zero(ARM_NQ));
  if (held[0] != tau[0] || held[1] != tau[1]) return 1;
  std::printf("runtime: %s has %d joints\n", arm.name.c_str(), arm.nq);
#endif
  return std::fabs(tau[0] - 9.81 * 3) < 1e-12 ? 0 : 2;
}
