/* SPDX-License-Identifier: Apache-2.0
 *
 * The farthest count of an encoder at knots, and the way to each of them.
 */
#ifndef FR_ENCODER_KNOTS_H
#define FR_ENCODER_KNOTS_H

#include "spans.h"

/* The way to a knot, indices in samples: that of the knot, with the number of rises since the last
 * one; of the largest rise its sample, the last known one before it, the first as far as that, and
 * its height; the two samples between which a rise took longest, and its height. */
typedef struct fr_way {
    int64_t at, far, rises;
    int64_t step, before_step, front, height;
    int64_t gap, behind_gap, gap_height;
} fr_way;

typedef struct fr_progress {
    fr_way coming;         /* to the next knot */
    fr_way last;           /* to the last one */
    int64_t far, far_at;   /* farthest count, and the first sample there */
    int64_t value;         /* of the last known sample */
    int64_t known;         /* this sample */
    int64_t longest;       /* longest wait for a rise since the knot */
    int64_t back, behind;  /* the samples that lie behind, or are a spike; -1 without any */
    double usual;          /* counts of a rise; infinite before the second knot */
    double apart;          /* samples between knots at least */
    int32_t started, reserved;
} fr_progress;

/* Take sample `index`, `after` being the next one, or itself at the end. Returns whether it is a
 * knot: then `last` is the way to it, and `before` the one before that. */
int fr_progress_take(fr_progress *progress, int64_t index, int64_t count, int64_t after,
                     fr_way *before);

/* The last known sample as a knot: the encoder may have been constant before it. */
int fr_progress_end(fr_progress *progress, fr_way *before);

#endif
