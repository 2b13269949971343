/* SPDX-License-Identifier: Apache-2.0
 *
 * Samples and settings: what is infinite or missing, and the order in which an array is passed.
 */
#ifndef FR_SAMPLES_H
#define FR_SAMPLES_H

#include <math.h>

#include "object.h"

#define FR_R(number) ((fr_real)(number))
#define FR_PI 3.14159265358979323846

/* NaN differs from itself; a difference to itself is NaN for an infinite number too. */
static inline int fr_missing(fr_real x)
{
    return x != x;
}

/* The same of a number that is double in both builds. */
static inline int fr_missing_number(double x)
{
    return x != x;
}

/* A sample, or the one before it where it is missing. */
static inline fr_real fr_bridged(fr_real x, fr_real before)
{
    return fr_missing(x) ? before : x;
}

static inline int fr_finite(double x)
{
    return x - x == 0.0;
}

static inline int fr_above_zero(double x)
{
    return x > 0.0 && fr_finite(x);
}

static inline int fr_one_of(int32_t value, int32_t first, int32_t last)
{
    return value >= first && value <= last;
}

/* The next whole number, from `least` up to what 32 bits hold eight times over. */
static inline int32_t fr_whole_at_least(double number, int32_t least)
{
    double most = (double)(INT32_MAX / 8), whole = ceil(number);
    if (!(whole > (double)least))
        return least;
    return whole < most ? (int32_t)whole : (int32_t)most;
}

/* Truth of a comparison in as many bits as fr_real, so that loops over both can be vectorized. */
#ifdef FR_FLOAT
typedef int32_t fr_flag;
#else
typedef int64_t fr_flag;
#endif

/* Index of the k-th sample that is passed. */
static inline size_t fr_index(size_t k, size_t count, int backward)
{
    return backward != 0 ? count - 1u - k : k;
}

/* FR_OK if `x` holds finite samples, and missing ones only where these are bridged. */
fr_status fr_check_samples(const fr_real *x, size_t count, int32_t missing);

/* Whether all samples are there and lie within 0 to `most`, which is finite. A negative zero is not
 * taken for one of them, so no is an answer for a slower check. */
int fr_all_within(const fr_real *x, size_t count, fr_real most);

/* The same for time steps: zero or above, never missing. */
fr_status fr_check_steps(const fr_real *x, size_t count);

#endif
