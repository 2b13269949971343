/* SPDX-License-Identifier: Apache-2.0
 *
 * When a fixed-lag smoother gives points out: whole numbers alone, no state of a filter. A push
 * first runs a copy of the clock over its counts, to learn how many points will come out, and then
 * the clock itself.
 *
 * Nodes that are stored belong to sections of half a lag. A section ends at its last node, or at
 * the first one behind which it has so many points; with the third section that has ended the
 * points of the oldest come out, and its room is free again. A point has at least two sections
 * behind it, the lag, and three at most.
 *
 * Where the vehicle is stationary, that is, where `patience` nodes in a row brought no point, nodes
 * are composed into one record, which takes no further room however long the standstill lasts.
 */
#ifndef FR_LAG_CLOCK_H
#define FR_LAG_CLOCK_H

#include "object.h"

enum { FR_LAG_SECTIONS = 3, FR_LAG_UPDATES = 8 };

/* What happens at a node, bit by bit. */
enum {
    FR_LAG_MARK = 1,     /* it carries how covariances pass on; others do every few metres */
    FR_LAG_COMPOSED = 2, /* it is composed with those before it */
    FR_LAG_ENDS = 4      /* a section ends with it */
};

typedef struct fr_lag_pace {
    int32_t nodes;    /* stored nodes of a section, 8 or more */
    int32_t updates;  /* updates of a section, of which a node has FR_LAG_UPDATES at most */
    int32_t points;   /* points of a section at the fastest speed; four times that are held */
    int32_t stops;    /* standstills of a section that are composed; later ones are stored */
    int32_t patience; /* nodes without a point behind which the vehicle is stationary */
    int32_t delay;    /* nodes from the samples to the filter: fewer than `nodes` */
} fr_lag_pace;

typedef struct fr_lag_clock {
    int32_t nodes, updates, stops; /* of the section in the making */
    int32_t empty;                 /* nodes in a row that brought no point */
    int32_t marked;                /* whether the last node is a mark, for a standstill to begin */
    int32_t due;                   /* nodes until the filter is where a section has ended, or 0 */
    int32_t sections;              /* that have ended and are held, 0 to 3 */
    int32_t composing;             /* whether the last node is part of a standstill's record */
    int64_t points;                /* points at the last node, from the first of the run */
    int64_t ends[FR_LAG_SECTIONS]; /* points at the end of each of those sections, oldest first */
    int64_t released;              /* points that have come out */
} fr_lag_clock;

/* Whether points up to number `points` can be held. Where not, the encoder leaps. */
int fr_lag_clock_holds(const fr_lag_clock *clock, const fr_lag_pace *pace, int64_t points);

/* Take the next node, with the points reached before it and the number of its updates, and say
 * what happens there. `released` goes up `delay` nodes behind the end of a third section: at the
 * node at which fr_lag_end_node() says for that end that points have to come out. */
int32_t fr_lag_clock_node(fr_lag_clock *clock, const fr_lag_pace *pace, int64_t points,
                          int32_t updates);

#endif
