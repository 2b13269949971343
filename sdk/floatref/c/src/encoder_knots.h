/* SPDX-License-Identifier: Apache-2.0
 *
 * The farthest count of an encoder at knots, and the way to each of them.
 */
#ifndef FR_ENCODER_KNOTS_H
#define FR_ENCODER_KNOTS_H

#include "spans.h"

/* A sample, and when it was taken in ticks. */
typedef struct fr_moment {
    int64_t index, tick;
} fr_moment;

/* The way to a knot: its moment, and the number of rises since the last one; of the largest rise its
 * moment, the last known one before it, the first as far as that, and its height; the two moments
 * between which a rise took longest, and its height. */
typedef struct fr_way {
    fr_moment at, step, before_step, front, gap, behind_gap;
    int64_t far, rises, height, gap_height;
} fr_way;

typedef struct fr_progress {
    fr_way coming;         /* to the next knot */
    fr_way last;           /* to the last one */
    fr_moment far_at;      /* the first sample at the farthest count */
    fr_moment known;       /* the last known sample */
    int64_t far, value;    /* farthest count, and that of the last known sample */
    int64_t longest;       /* longest wait for a rise since the knot, in ticks */
    int64_t back, behind;  /* the samples that lie behind, or are a spike; -1 without any */
    double usual;          /* counts of a rise; infinite before the second knot */
    double apart;          /* ticks between knots at least */
    int32_t started, reserved;
} fr_progress;

/* Take the sample `now`, `after` being the next one, or itself at the end. Returns whether it is a
 * knot: then `last` is the way to it, and `before` the one before that. */
int fr_progress_take(fr_progress *progress, fr_moment now, int64_t count, int64_t after,
                     fr_way *before);

/* The last known sample as a knot: the encoder may have been constant before it. */
int fr_progress_end(fr_progress *progress, fr_way *before);

#endif
