/* SPDX-License-Identifier: Apache-2.0
 *
 * c = tan(pi f_c dt), the substitution (A.11).
 */
#include <math.h>

#include "schedule.h"

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

void fr_large_tangents(const fr_tangent *tangent, const fr_real *cutoff, size_t count, fr_real *c)
{
    for (size_t i = 0; i < count; i++) {
        fr_real u = tangent->angle * cutoff[i];
        if (u > FR_SMALL)
            c[i] = tangent_of(u);
    }
}

void fr_tangents(const fr_tangent *tangent, const fr_real *cutoff, size_t count, fr_real *c)
{
    fr_tangents_here(tangent, cutoff, count, c);
}

fr_status fr_check_cutoffs(const fr_tangent *tangent, const fr_real *cutoff, size_t count,
                           int32_t missing)
{
    fr_status status;
    fr_real step = tangent->step;
    int wrong = 0;
    if (count > 0u && cutoff == NULL)
        return FR_NULL_POINTER;
    /* In float a step may be too small for a number. */
    if (count <= FR_MOST_SAMPLES && step > 0 && fr_all_within(cutoff, count, FR_R(0.49) / step))
        return FR_OK;
    status = fr_check_samples(cutoff, count, missing);
    for (size_t i = 0; status == FR_OK && i < count; i++)
        wrong |= cutoff[i] < 0 || step * cutoff[i] >= FR_R(0.5);
    return wrong != 0 ? FR_BAD_CUTOFF : status;
}
