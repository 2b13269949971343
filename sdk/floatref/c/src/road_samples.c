/* SPDX-License-Identifier: Apache-2.0
 *
 * Samples of the road-prior smoother: summed up into integrals, points and nodes.
 */
#include <math.h>

#include "road_prior.h"
#include "samples.h"

/* A constant speed is one beyond 5 m/s that changes by less than 0.4 m/s in four seconds. */
#define MOVING_M 5.0
#define STEADY_M 0.4

/* A node, with the points reached before it, goes to the clock; the next comes a sub-block later. */
static int32_t clock_node(fr_road_progress *progress, const fr_road_prior *road)
{
    progress->until = road->sub_block;
    return fr_lag_clock_node(&progress->clock, &road->lag.shape.pace, progress->reached, 1);
}

fr_status fr_road_foresee(const fr_road_prior *road, const int64_t *counts, size_t count,
                          size_t *needed)
{
    fr_road_progress progress = road->progress;
    fr_place_of_point place;
    for (size_t i = 0; i < count; i++) {
        int64_t whole = 0;
        fr_points_begin(&progress.points, counts[i]);
        while (fr_points_reached(&progress.points, counts[i]) != 0) {
            fr_points_next(&progress.points, counts[i], &place);
            whole += place.whole;
            progress.reached += 1 - place.whole;
            if (!fr_lag_clock_holds(&progress.clock, &road->lag.shape.pace,
                                    progress.reached + whole))
                return FR_BAD_SAMPLE;
        }
        if (progress.until == 0)
            (void)clock_node(&progress, road);
        progress.until--;
        progress.reached += whole;
        fr_points_pass(&progress.points, counts[i]);
    }
    *needed = (size_t)(progress.clock.released - road->progress.clock.released);
    return FR_OK;
}

/* Speeds of the last four seconds at a whole second: whether they are known and were the same. */
static int32_t is_steady(const fr_road_prior *road)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int k = 0; k < FR_QUIET_SECONDS; k++) {
        double speed = road->seconds_m[k] - road->seconds_m[k + 1];
        if (fr_missing_number(speed))
            return 0;
        least = fmin(least, speed);
        most = fmax(most, speed);
    }
    return road->travelled > FR_QUIET_SECONDS && least > MOVING_M && most - least < STEADY_M;
}

/* Whether lean and tilt begin anew at a node. */
static int32_t begins_anew(fr_road_prior *road, double place_m)
{
    if (road->nodes % road->per_second != 0)
        return 0;
    for (int k = FR_QUIET_SECONDS; k > 0; k--)
        road->seconds_m[k] = road->seconds_m[k - 1];
    road->seconds_m[0] = place_m;
    if (road->travelled <= FR_QUIET_SECONDS)
        road->travelled++;
    return road->nodes % (FR_QUIET_SECONDS * (int64_t)road->per_second) == 0 && is_steady(road);
}

static double value_of(const fr_real *values, size_t i)
{
    return values == NULL ? 0.0 : (double)values[i];
}

/* A node at sample i of a push: its integrals, and what its sensors read. */
static void make_node(fr_road_prior *road, const fr_road_input *input, size_t i)
{
    fr_road_motion *motion = &road->motion;
    fr_road_waiting *at = fr_road_waiting_at(road, road->nodes);
    int64_t gone = road->count - road->progress.points.origin;
    at->span = motion->steps * road->step;
    at->once = motion->velocity;
    at->twice = motion->height;
    at->distance_m = (double)gone * road->metres_per_count;
    at->place_m = motion->uncounted > 0 ? (double)NAN : at->distance_m;
    at->seen = (double)input->height[i];
    at->missing = fmax(value_of(input->share, i), (double)motion->lost / road->sub_block);
    at->level = value_of(input->level, i);
    at->points = road->progress.reached;
    at->anew = begins_anew(road, input->counts[i] == FR_NO_COUNT ? (double)NAN : at->distance_m);
    at->kind = clock_node(&road->progress, road);
    fr_excitation_add(&road->excitation, fr_road_room(road), at->place_m);
    motion->height = 0.0;
    motion->velocity = 0.0;
    motion->steps = 0;
    motion->lost = 0;
    motion->uncounted = 0;
    road->nodes++;
}

/* Add what accelerations linear between samples make of velocity and height. */
static void integrate(fr_road_prior *road, double a)
{
    fr_road_motion *motion = &road->motion;
    double step = road->step;
    if (road->nodes == 0) {
        motion->latest = a;
        return;
    }
    motion->height += step * motion->velocity + step * step / 6.0 * (2.0 * motion->latest + a);
    motion->velocity += 0.5 * step * (motion->latest + a);
    motion->latest = a;
    motion->steps++;
}

/* A missing acceleration is zero and counts as lost; of a missing height the last one stays. */
static void sum_sample(fr_road_prior *road, const fr_road_input *input, size_t i)
{
    fr_road_motion *motion = &road->motion;
    fr_real a = input->acceleration[i], h = input->height[i];
    motion->height_missing = fr_missing(h);
    if (!fr_missing(h))
        motion->seen = (double)h;
    /* The filter begins at the first height, and the road at 0. */
    if (road->nodes == 0) {
        road->filter.x[ROAD_R] = motion->seen;
        road->filter.x[ROAD_D] = motion->seen;
    }
    if (fr_missing(a)) {
        motion->lost++;
        motion->flags |= FR_POINT_MISSING;
    }
    integrate(road, fr_missing(a) ? 0.0 : (double)a - road->gravity);
}

/* Of a count that is missing the last one stays, and what is travelled up to the next node is not
 * known: the encoder has leapt, or lost counts. */
static void count_sample(fr_road_prior *road, int64_t count)
{
    fr_road_motion *motion = &road->motion;
    if (count == FR_NO_COUNT) {
        motion->uncounted++;
        motion->flags |= FR_POINT_MISSING;
        return;
    }
    if (road->nodes == 0 || count > road->furthest)
        road->furthest = count;
    road->count = count;
}

static void put_point(fr_road_prior *road, double elevation, double since, int32_t missing)
{
    fr_lag_view view = fr_road_view(road);
    fr_lag_point_held point = {0.0, 0.0, 0, 0};
    point.elevation = elevation;
    point.since = since;
    point.flags = road->motion.flags | (missing != 0 ? FR_POINT_MISSING : 0);
    fr_lag_point(&view, &point);
    road->motion.flags = 0;
    road->progress.reached++;
}

/* Take the points up to a sample; return how many of them lie at the sample itself. */
static int64_t take_points_between(fr_road_prior *road, int64_t count, int32_t missing_before)
{
    fr_points *points = &road->progress.points;
    const fr_road_motion *motion = &road->motion;
    double elevation = motion->height - motion->seen, before = motion->elevation;
    int32_t missing = missing_before | motion->height_missing;
    fr_place_of_point place;
    int64_t whole = 0;
    while (fr_points_reached(points, count) != 0) {
        fr_points_next(points, count, &place);
        whole += place.whole;
        if (place.whole == 0)
            put_point(road, before + (double)place.part * (elevation - before),
                      (motion->steps - 1 + (double)place.part) * road->step, missing);
    }
    fr_points_pass(points, count);
    return whole;
}

static void pass_sample(fr_road_prior *road, const fr_road_input *input, size_t i,
                        fr_lag_output *output)
{
    fr_road_motion *motion = &road->motion;
    int32_t missing_before = motion->height_missing;
    int64_t whole;
    fr_points_begin(&road->progress.points, input->counts[i]);
    count_sample(road, input->counts[i]);
    sum_sample(road, input, i);
    whole = take_points_between(road, input->counts[i], missing_before);
    if (road->progress.until == 0) {
        make_node(road, input, i);
        if (road->nodes - road->filtered > road->excitation.reach)
            fr_road_filter_next(road, output);
    }
    road->progress.until--;
    motion->elevation = motion->height - motion->seen;
    for (; whole > 0; whole--)
        put_point(road, motion->elevation, motion->steps * road->step, motion->height_missing);
}

void fr_road_samples(fr_road_prior *road, const fr_road_input *input, fr_lag_output *output)
{
    for (size_t i = 0; i < input->count; i++)
        pass_sample(road, input, i, output);
}
