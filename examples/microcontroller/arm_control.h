/* SPDX-License-Identifier: MIT */
/* Control of a six-joint arm on a microcontroller: C99, float, no allocation, no library but what
 * dyngen wrote. See README.md. */
#ifndef ARM_CONTROL_H
#define ARM_CONTROL_H

#include "mcu_arm.h"

#ifdef __cplusplus
extern "C" {
#endif

enum arm_law {
  ARM_GRAVITY,    /* tau = kp e + kd e' + g(q) */
  ARM_FEEDFORWARD /* tau = kp e + kd e' + M(q_ref) ddq_ref + c + g at the reference */
};

/* All that a controller keeps. Put it into static memory and fill it once. */
struct arm_control {
  enum arm_law law;
  float kp[MCU_ARM_NQ];           /* N m/rad */
  float kd[MCU_ARM_NQ];           /* N m s/rad */
  float torque_limit[MCU_ARM_NQ]; /* N m, positive */
  float friction_band;            /* rad/s; 0: friction is not compensated */
};

struct arm_reference {
  float q[MCU_ARM_NQ];   /* rad */
  float dq[MCU_ARM_NQ];  /* rad/s */
  float ddq[MCU_ARM_NQ]; /* rad/s^2 */
};

/* One cycle of the loop.
 *   q[6] rad   dq[6] rad/s   measured    tau[6] N m, out
 * Friction is that of the model at the reference's velocity, linear in it within the band, so that
 * a joint that is asked to stand gets no jumps. Returns the number of joints at their limit. */
int arm_control_step(const struct arm_control *control, const struct arm_reference *reference,
                     const float *q, const float *dq, float *tau);

#ifdef __cplusplus
}
#endif

#endif
