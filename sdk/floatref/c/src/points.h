/* SPDX-License-Identifier: Apache-2.0
 *
 * Points of the profile along the encoder: integers of intervals, found by integers of counts.
 */
#ifndef FR_POINTS_H
#define FR_POINTS_H

#include "travel.h"

typedef struct fr_points {
    double interval_m, metres_per_count, slack_m;
    int64_t origin;    /* first count of the run */
    int64_t furthest;  /* largest count so far, from the origin */
    int64_t next;      /* index of the next point */
    int64_t threshold; /* smallest count from the origin that has reached it */
    int32_t started;
} fr_points;

/* Where a point lies: the sample of the push that it is read from, or a part of the way to it. */
typedef struct fr_place_of_point {
    int whole;
    fr_real part;
} fr_place_of_point;

int fr_points_are_possible(double interval_m, double metres_per_count);
void fr_points_set(fr_points *points, double interval_m, double metres_per_count);

/* Say how many points a push would reach; FR_BAD_SAMPLE for a leap of ten million and more. */
fr_status fr_points_needed(const fr_points *points, const int64_t *counts, size_t count,
                           size_t *needed);

/* Start at the first sample of the run; does nothing later. */
void fr_points_begin(fr_points *points, int64_t count);

/* Take the next point, which the sample has reached. */
void fr_points_next(fr_points *points, int64_t count, fr_place_of_point *place);

/* Whether a sample has reached the next point, and is the farthest so far. */
static inline int fr_points_reached(const fr_points *points, int64_t count)
{
    int64_t now = count != FR_NO_COUNT ? count - points->origin : -1;
    return now >= points->threshold && now >= points->furthest;
}

/* Leave a sample whose points have all been taken. */
static inline void fr_points_pass(fr_points *points, int64_t count)
{
    int64_t now = count != FR_NO_COUNT ? count - points->origin : -1;
    points->furthest = now > points->furthest ? now : points->furthest;
}

static inline fr_real fr_points_read(const fr_place_of_point *place, fr_real before, fr_real now)
{
    return place->whole ? now : before + place->part * (now - before);
}

#endif
