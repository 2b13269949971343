/* SPDX-License-Identifier: Apache-2.0
 *
 * A section at a fixed cut-off, as sets of filters hold it.
 */
#ifndef FR_FILTER_H
#define FR_FILTER_H

#include "samples.h"

struct fr_filter {
    fr_head head;
    int32_t kind; /* twice the order, and 1 for a low-pass */
    int32_t backward;
    int32_t missing;
    int32_t started;
    fr_real c, gain, p, k1, k2, k3, first, band, low; /* coefficients; the last three at a start */
    fr_real held, s1, s2;
};

/* Set a cleared filter to a configuration that is possible. */
void fr_filter_set(fr_filter *filter, const fr_filter_config *config);

/* Filter samples that have been checked; `y` may be `x`. */
void fr_filter_run(fr_filter *filter, const fr_real *x, size_t count, fr_real *y);

#endif
