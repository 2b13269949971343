/* SPDX-License-Identifier: Apache-2.0
 *
 * The backward pass of a set at the cut-off of the speed: HPF_B3S2R, then HPF_B3S1R, in one loop.
 */
#ifndef FR_BACKWARD_PASS_H
#define FR_BACKWARD_PASS_H

#include "schedule.h"

/* Over samples in time at the step of `tangent`, or over points whose largest cut-off in cycles/m
 * is `largest`, above 0. Samples and speeds have been checked; `profile` may be `elevation`. */
void fr_pass_backward(const fr_schedule *schedule, const fr_tangent *tangent, fr_real largest,
                      const fr_real *elevation, const fr_real *speed, size_t count,
                      fr_real *profile);

#endif
