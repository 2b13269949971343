/* SPDX-License-Identifier: Apache-2.0
 *
 * The schedule of observations and the clock of the lag, ahead of the filter.
 */
#include "kalman_foresight.h"

/* Copies of all that the filter will change. */
typedef struct foresight {
    const fr_kalman_engine *engine;
    void *room;
    const fr_kalman_push_of *push;
    fr_kalman_references references;
    fr_points points;
    fr_lag_clock clock;
    uint32_t read;
} foresight;

/* The count at a sample that has been pushed, or will be. */
static int64_t count_ahead(const foresight *f, int64_t at)
{
    if (at < f->engine->pushed)
        return fr_kalman_engine_count(f->engine, f->room, at);
    if (at < 0)
        return f->push->counts[0];
    return f->push->counts[at - f->engine->pushed];
}

static double height_ahead(const foresight *f, int64_t at)
{
    void *room = f->room;
    if (at < f->engine->pushed)
        return fr_kalman_engine_height(f->engine, room, at);
    return f->push->height[at - f->engine->pushed];
}

static double speed_ahead(const foresight *f, int64_t at)
{
    int64_t before = at - (int64_t)f->engine->window;
    int64_t first = f->engine->pushed > 0 ? f->engine->first : count_ahead(f, 0);
    int64_t progress = count_ahead(f, at) - (before < 0 ? first : count_ahead(f, before));
    return (double)progress * f->engine->metres_per_count / f->engine->duration_s;
}

static int32_t readings_in(const fr_kalman_observation *observed)
{
    int32_t found = 0;
    for (int i = 0; i < FR_K_KINDS; i++)
        found += observed->y[i] == observed->y[i];
    return found;
}

/* Whether a node will be made at a sample, with how many updates at most. */
static int node_ahead(foresight *f, int64_t at, int32_t *updates)
{
    const fr_kalman_reading *readings = fr_kalman_readings(f->engine, f->room) + f->read;
    int read = f->read < f->engine->held && readings->at == at;
    double distance_m = (double)count_ahead(f, at) * f->engine->metres_per_count;
    fr_kalman_observation observed;
    int seen = fr_kalman_schedule(&f->references, at, height_ahead(f, at), speed_ahead(f, at),
                                  distance_m, read ? readings : NULL, &observed);
    f->read += read ? 1u : 0u;
    *updates = seen ? readings_in(&observed) : 0;
    return seen || at % f->engine->model.sub_block == 0;
}

/* Take the points that a sample reaches; return how many of them lie before it. */
static int64_t points_ahead(fr_points *points, int64_t count)
{
    fr_place_of_point place = {0, 0};
    fr_points_begin(points, count);
    while (fr_points_reached(points, count) != 0)
        fr_points_next(points, count, &place);
    fr_points_pass(points, count);
    return points->next - (place.whole != 0 ? 1 : 0);
}

/* FR_BAD_SAMPLE for a leap of ten million points and more, which no loop shall go through. */
static fr_status check_leap(const foresight *f)
{
    fr_points started = f->points;
    size_t needed = 0;
    if (f->engine->pushed > 0)
        fr_points_begin(&started, f->engine->first);
    return fr_points_needed(&started, f->push->counts, f->push->count, &needed);
}

fr_status fr_kalman_foresee(const fr_kalman_engine *engine, void *room, const fr_points *points,
                            const fr_lag_clock *clock, const fr_lag_pace *pace,
                            const fr_kalman_push_of *push, size_t ready, size_t *given_out)
{
    foresight f = {engine, room, push, engine->references, *points, *clock, 0u};
    int64_t first = engine->state.latest + 1, end = first + (int64_t)ready;
    int64_t last = engine->pushed + (int64_t)push->count;
    int32_t updates = 0;
    if (check_leap(&f) != FR_OK)
        return FR_BAD_SAMPLE;
    for (int64_t at = first; at < end; at++) {
        int64_t before = points_ahead(&f.points, count_ahead(&f, at));
        if (fr_lag_clock_holds(&f.clock, pace, f.points.next) == 0)
            return FR_BAD_SAMPLE;
        if (node_ahead(&f, at, &updates) != 0)
            (void)fr_lag_clock_node(&f.clock, pace, before, updates);
    }
    *given_out = (size_t)(f.clock.released - clock->released);
    for (int64_t at = end; at < last; at++)
        (void)points_ahead(&f.points, count_ahead(&f, at));
    return fr_lag_clock_holds(&f.clock, pace, f.points.next) != 0 ? FR_OK : FR_BAD_SAMPLE;
}

size_t fr_kalman_foresee_end(const fr_kalman_engine *engine, void *room, const fr_points *points,
                             const fr_lag_clock *clock)
{
    fr_points ahead = *points;
    for (int64_t at = engine->state.latest + 1; at < engine->pushed; at++)
        (void)points_ahead(&ahead, fr_kalman_engine_count(engine, room, at));
    return (size_t)(ahead.next - clock->released);
}
