/* SPDX-License-Identifier: Apache-2.0
 *
 * One sample of the trapezoidal rule.
 */
#ifndef FR_INTEGRAL_H
#define FR_INTEGRAL_H

#include "samples.h"

typedef struct fr_trapezoid {
    int32_t started;
    fr_real last, total;
} fr_trapezoid;

/* The same behind the first sample: an object that is known to have started. */
static inline fr_real fr_trapezoid_next(fr_trapezoid *sum, fr_real value, fr_real half_step)
{
    sum->total = sum->total + half_step * (value + sum->last);
    sum->last = value;
    return sum->total;
}

static inline fr_real fr_trapezoid_step(fr_trapezoid *sum, fr_real value, fr_real half_step)
{
    if (sum->started != 0)
        sum->total = sum->total + half_step * (value + sum->last);
    sum->started = 1;
    sum->last = value;
    return sum->total;
}

#endif
