/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>

#include "arm.h"
#include "small_arm.h"

int main(void) {
  const double q[ARM_NQ] = {0, 0}, zero[ARM_NQ] = {0, 0};
  const float q_small[SMALL_NQ] = {0, 0};
  float chi[SMALL_NCHI], tau_small[SMALL_NQ];
  double tau[ARM_NQ], tau_id[ARM_NQ];
  int k;
  for (k = 0; k < SMALL_NCHI; ++k) chi[k] = (float)small_chi_values[k];
  arm_gravity(q, tau);
  arm_id(q, zero, zero, tau_id);
  small_gravity(q_small, chi, tau_small);
  printf("tau = %.4f %.4f\n", tau[0], tau[1]);
  for (k = 0; k < ARM_NQ; ++k) {
    if (fabs(tau_id[k] - tau[k]) > 1e-12 || fabs(tau_small[k] - tau[k]) > 1e-5) return 1;
  }
  return fabs(tau[0] - 9.81 * 3) < 1e-12 && fabs(tau[1] - 9.81) < 1e-12 ? 0 : 2;
}
