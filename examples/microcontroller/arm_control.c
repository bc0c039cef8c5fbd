/* SPDX-License-Identifier: MIT */
#include "arm_control.h"

static void add_friction(float band, const float *dq, float *tau) {
  float at_velocity[MCU_ARM_NQ], upper[MCU_ARM_NQ], lower[MCU_ARM_NQ], end[MCU_ARM_NQ];
  int j;
  mcu_arm_friction(dq, at_velocity);
  for (j = 0; j < MCU_ARM_NQ; ++j) end[j] = band;
  mcu_arm_friction(end, upper);
  for (j = 0; j < MCU_ARM_NQ; ++j) end[j] = -band;
  mcu_arm_friction(end, lower);
  for (j = 0; j < MCU_ARM_NQ; ++j) {
    if (dq[j] > -band && dq[j] < band) {
      const float share = (dq[j] + band) / (2.0f * band);
      tau[j] += (1.0f - share) * lower[j] + share * upper[j];
    } else {
      tau[j] += at_velocity[j];
    }
  }
}

int arm_control_step(const struct arm_control *control, const struct arm_reference *reference,
                     const float *q, const float *dq, float *tau) {
  int saturated = 0, j;
  if (control->law == ARM_GRAVITY) {
    mcu_arm_gravity(q, tau);
  } else {
    mcu_arm_id_rigid(reference->q, reference->dq, reference->ddq, tau);
  }
  if (control->friction_band > 0.0f) add_friction(control->friction_band, reference->dq, tau);
  for (j = 0; j < MCU_ARM_NQ; ++j) {
    const float limit = control->torque_limit[j];
    tau[j] +=
        control->kp[j] * (reference->q[j] - q[j]) + control->kd[j] * (reference->dq[j] - dq[j]);
    if (tau[j] > limit) {
      tau[j] = limit;
      ++saturated;
    } else if (tau[j] < -limit) {
      tau[j] = -limit;
      ++saturated;
    }
  }
  return saturated;
}
