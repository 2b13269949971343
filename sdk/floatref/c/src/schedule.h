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

/* Samples of a loop that has no recursion, where its length is fixed so that it can be vectorized:
 * few enough for a processor to look beyond them while a recursion beside it waits for itself. */
#define FR_GROUP (FR_BLOCK < 32 ? (size_t)FR_BLOCK : (size_t)32)

/* (A.11) at a constant step: the step itself, pi times it, and whether the polynomial is short. */
typedef struct fr_tangent {
    fr_real step, angle;
    int32_t is_short;
} fr_tangent;

fr_tangent fr_tangent_of(double step, int32_t form);

/* Largest angle for which the series of the tangent is used; its error is below rounding. */
#define FR_SMALL FR_R(0.1)

/* Terms of the Taylor series from u^3 on, divided by u^3. Cut off behind u^5, the first term left
 * out is 17/315 u^7: at 0.1 that is 5.4e-8 of u. */
static inline fr_real fr_short_series(fr_real u2)
{
    return FR_R(2.0 / 15.0) * u2 + FR_R(1.0 / 3.0);
}

static inline fr_real fr_long_series(fr_real u2)
{
    fr_real series = FR_R(21844.0 / 6081075.0);
    series = series * u2 + FR_R(1382.0 / 155925.0);
    series = series * u2 + FR_R(62.0 / 2835.0);
    series = series * u2 + FR_R(17.0 / 315.0);
    series = series * u2 + FR_R(2.0 / 15.0);
    return series * u2 + FR_R(1.0 / 3.0);
}

/* Replace c of angles for which the series is not, by tan(). */
void fr_large_tangents(const fr_tangent *tangent, const fr_real *cutoff, size_t count, fr_real *c);

/* Write c of `count` cut-offs, all within 0 to half a cycle per step, or NaN. Inline where a
 * recursion is in the same loop: it waits for its own last result, and this is computed meanwhile. */
static inline void fr_tangents_here(const fr_tangent *tangent, const fr_real *cutoff, size_t count,
                                    fr_real *c)
{
    fr_real angle = tangent->angle;
    fr_flag large = 0;
    for (size_t i = 0; tangent->is_short == 0 && i < count; i++) {
        fr_real u = angle * cutoff[i], u2 = u * u;
        c[i] = u + u * (u2 * fr_long_series(u2));
        large |= u > FR_SMALL;
    }
    for (size_t i = 0; tangent->is_short != 0 && i < count; i++) {
        fr_real u = angle * cutoff[i], u2 = u * u;
        c[i] = u + u * (u2 * fr_short_series(u2));
        large |= u > FR_SMALL;
    }
    if (large != 0)
        fr_large_tangents(tangent, cutoff, count, c);
}

/* The same in a function of its own. */
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
