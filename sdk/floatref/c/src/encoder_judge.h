/* SPDX-License-Identifier: Apache-2.0
 *
 * Whether a vehicle can have gone the way to a knot.
 */
#ifndef FR_ENCODER_JUDGE_H
#define FR_ENCODER_JUDGE_H

#include "encoder_knots.h"

/* A way in m and s. */
typedef struct fr_travelled {
    double m, s, rises;
} fr_travelled;

typedef struct fr_judge {
    double period_s, metres_per_count, usual_m, off_m;
    fr_travelled older, newer; /* the last two sound ways */
    fr_moment sound_at;        /* the knot at the end of the last one */
    int32_t ways, reserved;    /* sound ones so far, two at most */
} fr_judge;

/* FR_SILENT, FR_LEAPT, FR_TOO_MANY_COUNTS, FR_LOST, or 0 for a sound way from knot `from`. With
 * FR_LOST, `*stalled` is whether it was lost while one rise was waited for. `hidden_m` is how much
 * farther the vehicle may be than the counts. */
int32_t fr_judge_way(fr_judge *judge, const fr_way *from, const fr_way *way, double hidden_m,
                     int *stalled);

#endif
