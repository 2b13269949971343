/* SPDX-License-Identifier: Apache-2.0
 *
 * The search for profile points along the encoder, by counts from the first one.
 *
 * A count has reached point k if k times the interval is at most its distance and a millionth of
 * the interval: counts and points often fall on the same decimal, and without it the rounding of
 * either would decide which sample is taken. The comparison is made once for each point, in double,
 * and turned into the smallest count that passes; samples compare integers.
 */
#include <math.h>

#include "points.h"

#define TIE 1e-6
#define MOST_POINTS 1e7
/* Beyond these an index or a count would not fit into 63 bits, or a distance into a number. */
#define FINEST 1e3
#define COARSEST 1e9
#define MOST_INDEX 1e19

int fr_points_are_possible(double interval_m, double metres_per_count)
{
    return fr_above_zero(interval_m) && fr_above_zero(metres_per_count) &&
           metres_per_count / interval_m <= FINEST && interval_m / metres_per_count <= COARSEST &&
           fr_finite(MOST_INDEX * interval_m);
}

void fr_points_set(fr_points *points, double interval_m, double metres_per_count)
{
    points->interval_m = interval_m;
    points->metres_per_count = metres_per_count;
    points->slack_m = TIE * interval_m;
}

static double point_m(const fr_points *points, int64_t point)
{
    return (double)point * points->interval_m;
}

static double count_m(const fr_points *points, int64_t count)
{
    return (double)count * points->metres_per_count;
}

static int has_reached(const fr_points *points, int64_t point, int64_t count)
{
    return point_m(points, point) <= count_m(points, count) + points->slack_m;
}

static int64_t threshold_of(const fr_points *points, int64_t point)
{
    double count = ceil((point_m(points, point) - points->slack_m) / points->metres_per_count);
    int64_t threshold = (int64_t)count;
    while (!has_reached(points, point, threshold))
        threshold++;
    while (has_reached(points, point, threshold - 1))
        threshold--;
    return threshold;
}

static int64_t furthest_of(const fr_points *points, const int64_t *counts, size_t count)
{
    int64_t origin = points->started != 0 ? points->origin : counts[0];
    int64_t furthest = points->started != 0 ? points->furthest : 0;
    for (size_t i = 0; i < count; i++) {
        if (counts[i] != FR_NO_COUNT && counts[i] - origin > furthest)
            furthest = counts[i] - origin;
    }
    return furthest;
}

fr_status fr_points_needed(const fr_points *points, const int64_t *counts, size_t count,
                           size_t *needed)
{
    int64_t last, furthest;
    double reach;
    *needed = 0u;
    if (count == 0u)
        return FR_OK;
    furthest = furthest_of(points, counts, count);
    reach = floor((count_m(points, furthest) + points->slack_m) / points->interval_m);
    if (!(reach - (double)points->next < MOST_POINTS))
        return FR_BAD_SAMPLE;
    last = (int64_t)reach;
    while (has_reached(points, last + 1, furthest))
        last++;
    while (last >= points->next && !has_reached(points, last, furthest))
        last--;
    *needed = last >= points->next ? (size_t)(last - points->next + 1) : 0u;
    return FR_OK;
}

void fr_points_begin(fr_points *points, int64_t count)
{
    if (points->started == 0) {
        points->started = 1;
        points->origin = count;
        points->threshold = threshold_of(points, 0);
    }
}

void fr_points_next(fr_points *points, int64_t count, fr_place_of_point *place)
{
    int64_t now = count - points->origin;
    double step_m, way_m;
    step_m = count_m(points, now) - count_m(points, points->furthest);
    way_m = point_m(points, points->next);
    place->whole = !(step_m > points->interval_m + points->slack_m &&
                     way_m < count_m(points, now) - points->slack_m);
    place->part = 1;
    if (!place->whole)
        place->part = FR_R((way_m - count_m(points, points->furthest)) / step_m);
    points->next++;
    points->threshold = threshold_of(points, points->next);
}
