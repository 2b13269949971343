/* SPDX-License-Identifier: Apache-2.0
 *
 * The acceleration of a distance that is smoothed by a Gaussian, from bin to bin.
 */
#ifndef FR_BELL_H
#define FR_BELL_H

#include <stddef.h>
#include <stdint.h>

/* Distances of the bins so far: bin k is at k modulo `ring`. */
typedef struct fr_bell {
    const double *weight, *distance;
    int32_t reach, ring;
    int64_t bins;
} fr_bell;

/* Bins to either side that count. */
int32_t fr_bell_reach(double step_s);
/* Weights from the middle to `reach` bins beside it. */
void fr_bell_set(double *weight, int32_t reach, double step_s);
/* Acceleration in m/s^2 at a bin; beyond the ends of the run the vehicle goes on as next to them. */
double fr_bell_along(const fr_bell *bell, int64_t bin);

#endif
