/* SPDX-License-Identifier: Apache-2.0
 *
 * c = tan(pi f_c dt), the substitution (A.11).
 */
#include <math.h>

#include "schedule.h"

/* Largest angle for which the series of the tangent is used; its error is below rounding. */
#define SMALL FR_R(0.1)

fr_tangent fr_tangent_of(double step, int32_t form)
{
    fr_tangent tangent = {FR_R(step), FR_R(FR_PI * step), form == FR_TANGENT_SHORT ? 1 : 0};
    return tangent;
}

static fr_real tangent_of(fr_real u)
{
#ifdef FR_FLOAT
    return tanf(u);
#else
    return tan(u);
#endif
}

/* Terms of the Taylor series from u^3 on, divided by u^3. Cut off behind u^5, the first term left
 * out is 17/315 u^7: at 0.1 that is 5.4e-8 of u. */
static fr_real short_series(fr_real u2)
{
    return FR_R(2.0 / 15.0) * u2 + FR_R(1.0 / 3.0);
}

static fr_real long_series(fr_real u2)
{
    fr_real series = FR_R(21844.0 / 6081075.0);
    series = series * u2 + FR_R(1382.0 / 155925.0);
    series = series * u2 + FR_R(62.0 / 2835.0);
    series = series * u2 + FR_R(17.0 / 315.0);
    series = series * u2 + FR_R(2.0 / 15.0);
    return series * u2 + FR_R(1.0 / 3.0);
}

void fr_tangents(const fr_tangent *tangent, const fr_real *cutoff, size_t count, fr_real *c)
{
    fr_real angle = tangent->angle;
    int large = 0;
    for (size_t i = 0; i < count; i++) {
        fr_real u = angle * cutoff[i], u2 = u * u;
        fr_real series = tangent->is_short != 0 ? short_series(u2) : long_series(u2);
        c[i] = u + u * (u2 * series);
        large |= u > SMALL;
    }
    for (size_t i = 0; large != 0 && i < count; i++) {
        fr_real u = angle * cutoff[i];
        if (u > SMALL)
            c[i] = tangent_of(u);
    }
}

fr_status fr_check_cutoffs(const fr_tangent *tangent, const fr_real *cutoff, size_t count,
                           int32_t missing)
{
    fr_status status = fr_check_samples(cutoff, count, missing);
    int wrong = 0;
    for (size_t i = 0; status == FR_OK && i < count; i++)
        wrong |= cutoff[i] < 0 || tangent->step * cutoff[i] >= FR_R(0.5);
    return wrong != 0 ? FR_BAD_CUTOFF : status;
}
