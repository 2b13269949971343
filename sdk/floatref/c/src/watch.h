/* SPDX-License-Identifier: Apache-2.0
 *
 * What the screening of one sensor remembers, and its limits.
 */
#ifndef FR_WATCH_H
#define FR_WATCH_H

#include "spans.h"
#include "travel.h"

/* Lengths in samples; `range` is whether the ends of the sensor's range are known. */
typedef struct fr_watch_limits {
    double longest_gap, shortest_run, metres_per_count, travel_m, spread;
    double least, greatest, shortest_stay, leap, spike;
    int32_t range, reserved;
} fr_watch_limits;

typedef struct fr_watch {
    int64_t index;              /* of the next sample */
    int64_t gap, run;           /* first sample of what is open, -1 if it is not */
    int64_t before, last;       /* counts before the run and at the last sample */
    fr_real value, least, most; /* of the run; readings of the accelerometer but the last one */
    fr_real reading;            /* the last one */
    fr_real x1, x2;             /* the last sample and the one before it */
    fr_real step;               /* into the run; missing if it is not known */
    int32_t unknown;            /* whether a reading is missing */
} fr_watch;

/* Go through samples; `force` may be NULL, and so may `spans`, for their number alone. */
size_t fr_watch_samples(const fr_watch_limits *limits, fr_watch *watch, const fr_real *x,
                        const fr_real *force, const int64_t *counts, size_t count, fr_span *spans);

/* Close what is open at the end of the run. */
size_t fr_watch_end(const fr_watch_limits *limits, fr_watch *watch, fr_span *spans);

#endif
