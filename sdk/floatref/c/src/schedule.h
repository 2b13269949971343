/* SPDX-License-Identifier: Apache-2.0
 *
 * Cut-offs that follow the travel speed: (5.3), its wave number, and (A.11) of either.
 */
#ifndef FR_SCHEDULE_H
#define FR_SCHEDULE_H

#include "samples.h"

/* Elementwise loops run over at most this many samples at a time: their results lie on the stack. */
#ifndef FR_BLOCK
#define FR_BLOCK 64
#endif

/* (A.11) at a constant step: the step itself, pi times it, and whether the polynomial is short. */
typedef struct fr_tangent {
    fr_real step, angle;
    int32_t is_short;
} fr_tangent;

fr_tangent fr_tangent_of(double step, int32_t form);

/* Write c of `count` cut-offs, all within 0 to half a cycle per step, or NaN. */
void fr_tangents(const fr_tangent *tangent, const fr_real *cutoff, size_t count, fr_real *c);

/* FR_OK if all cut-offs are within 0 to half a cycle per step, and missing ones may be. */
fr_status fr_check_cutoffs(const fr_tangent *tangent, const fr_real *cutoff, size_t count,
                           int32_t missing);

/* (5.3) in fr_real: f_ls, 1 / lambda_c, v_0 and alpha. */
typedef struct fr_schedule {
    fr_real low_speed, per_metre, transition, steepness;
} fr_schedule;

int fr_cut_off_is_possible(const fr_cut_off_config *config);
fr_schedule fr_schedule_of(const fr_cut_off_config *config);

/* Largest cut-off over distance, in cycles/m, of points at an interval. */
fr_real fr_largest_wave_number(double interval_m);

void fr_frequencies(const fr_schedule *schedule, const fr_real *speed, size_t count,
                    fr_real *frequency);

/* Turn frequencies in Hz into cycles/m, at most `largest`, in place. */
void fr_wave_numbers(const fr_real *speed, fr_real largest, size_t count, fr_real *values);

/* FR_OK if the cut-offs of all speeds are within 0 to half the rate of `tangent`. */
fr_status fr_check_speeds(const fr_schedule *schedule, const fr_tangent *tangent,
                          const fr_real *speed, size_t count, int32_t missing);

#endif
