/* SPDX-License-Identifier: Apache-2.0
 *
 * Bins of some 10 ms: how many samples make one, and their means.
 */
#ifndef FR_BINS_H
#define FR_BINS_H

#include <math.h>

#include "samples.h"

#define FR_BINS_HZ 100.0
#define FR_LEAST_BINS 64 /* of a run in which anything is derived from bins */

/* A force or a height beyond this is none. */
#define FR_LARGEST_VALUE 1e9

/* In the SDK's order of operations, which decides where it is a half more than a whole number. */
static inline double fr_bin_samples(double rate_hz)
{
    return fmax(1.0, rint(1.0 / (FR_BINS_HZ * (1.0 / rate_hz))));
}

static inline int32_t fr_bins_in(double time_s, double step_s)
{
    return (int32_t)rint(time_s / step_s);
}

/* The mean of what is known, NaN where that is less than half. */
static inline double fr_close_mean(double sum, int32_t count, int32_t every)
{
    return 2 * count >= every ? sum / (double)count : (double)NAN;
}

static inline void fr_add_known(double *sum, int32_t *count, fr_real x)
{
    if (!fr_missing(x)) {
        *sum += (double)x;
        *count += 1;
    }
}

/* FR_OK if `x` holds `count` samples of all paths that can be, or that may be missing. */
fr_status fr_check_paths(const fr_real *x, size_t count, int32_t paths, int32_t missing);

#endif
