/* SPDX-License-Identifier: Apache-2.0
 *
 * Where the vehicle brakes, stands and sets off: the queue of bins, and the stretches in it.
 */
#include <string.h>

#include "level_model.h"
#include "level_stage.h"

#define BEFORE_M 60.0
#define BEHIND_M 90.0

/* Whether a bin is so far before another one that it is in no stretch with it. */
static int is_before(const fr_level *level, const lv_bin *bin, const lv_bin *other)
{
    return bin->distance < other->distance - BEFORE_M || bin->moved < other->moved - level->side;
}

static int is_behind(const fr_level *level, const lv_bin *bin, const lv_bin *other)
{
    return bin->distance > other->distance + BEHIND_M || bin->moved > other->moved + level->side;
}

/* The first bin at or behind `from` that is not too far before the one at `at`. */
static int32_t side_of(const fr_level *level, const lv_arrays *a, int32_t from, int32_t at)
{
    int32_t first = from;
    while (first < at && is_before(level, &a->queue[first], &a->queue[at]))
        first++;
    return first;
}

/* Fit the window that begins the stretch, and let go of what it does not share with the next. */
static void end_window(fr_level *level, lv_arrays *a, int32_t behind)
{
    double most_m = 0.5 * level->config.fit.most_travel_m;
    fr_lv_fit_window(level, a, level->first, behind);
    if (level->first < behind - level->shared)
        level->first = behind - level->shared;
    while (a->queue[behind].distance - a->queue[level->first].distance > most_m)
        level->first++;
    level->ready = level->first;
}

static void close_stretch(fr_level *level, lv_arrays *a)
{
    double least = LV_SHORTEST_S / level->step_s;
    if ((double)(level->behind - level->first) >= least)
        fr_lv_fit_window(level, a, level->first, level->behind);
    level->ready = level->behind;
    level->open = 0;
}

/* Whether the memory of a fit is for no more bins or road than those before `behind`. */
static int is_full(const fr_level *level, const lv_arrays *a, int32_t behind)
{
    double road = a->queue[behind].distance - a->queue[level->first].distance;
    return behind - level->first >= level->window || road > level->config.fit.most_travel_m;
}

static void grow(fr_level *level, lv_arrays *a, int32_t at)
{
    for (int32_t i = level->behind; i <= at; i++) {
        if (i > level->first && is_full(level, a, i))
            end_window(level, a, i);
        level->behind = i + 1;
    }
}

/* A brake opens a stretch or goes on with it. */
static void brake(fr_level *level, lv_arrays *a, int32_t at)
{
    if (level->open == 0) {
        level->open = 1;
        level->first = side_of(level, a, level->ready, at);
        level->ready = level->first;
        level->behind = level->first;
    }
    level->last = at;
    grow(level, a, at);
}

/* Without a brake a stretch ends, once no brake that is still to come may join it. */
static void go_on(fr_level *level, lv_arrays *a, int32_t at)
{
    const lv_bin *bin = &a->queue[at];
    if (level->behind == at && !is_behind(level, bin, &a->queue[level->last])) {
        grow(level, a, at);
        return;
    }
    if (is_before(level, &a->queue[level->behind], bin) || at - level->behind > 2 * level->side)
        close_stretch(level, a);
}

/* Let go of bins that are before any brake to come, or more than there is room for. */
static void leave_behind(fr_level *level, const lv_arrays *a, int32_t at)
{
    level->ready = side_of(level, a, level->ready, at);
    if (at - level->ready > 2 * level->side)
        level->ready = at - 2 * level->side;
}

/* Move the bins that are not taken to the begin of the queue, where its end is reached. */
static void make_room(fr_level *level, lv_arrays *a)
{
    int32_t gone = level->taken;
    if (level->end < level->room)
        return;
    (void)memmove(a->queue, a->queue + gone, (size_t)(level->end - gone) * sizeof *a->queue);
    level->taken = 0;
    level->end -= gone;
    level->ready -= gone;
    level->first -= level->open != 0 ? gone : 0;
    level->behind -= level->open != 0 ? gone : 0;
    level->last -= level->open != 0 ? gone : 0;
}

static void append(fr_level *level, lv_arrays *a, const lv_bin *bin)
{
    int32_t at;
    make_room(level, a);
    at = level->end;
    a->queue[at] = *bin;
    level->end++;
    if (bin->active != 0)
        brake(level, a, at);
    if (bin->active == 0 && level->open != 0)
        go_on(level, a, at);
    if (level->open == 0)
        leave_behind(level, a, at);
}

/* Those that may be the last of a standstill have turned out to be. */
static void end_rest(fr_level *level, lv_arrays *a)
{
    for (int32_t i = 0; i < level->resting; i++)
        append(level, a, &a->rest[(level->rest + i) % level->before]);
    level->resting = 0;
    level->stood = 0;
}

static void add_rest(fr_level *level, lv_arrays *a, const lv_bin *bin)
{
    a->rest[(level->rest + level->resting) % level->before] = *bin;
    if (level->resting < level->before)
        level->resting++;
    else
        level->rest = (level->rest + 1) % level->before;
}

void fr_lv_take_bin(fr_level *level, lv_arrays *a, const lv_bin *bin)
{
    if (bin->speed >= LV_STANDING_MPS)
        end_rest(level, a);
    else
        level->stood += level->stood <= level->after ? 1 : 0;
    if (level->stood > level->after)
        add_rest(level, a, bin);
    else
        append(level, a, bin);
}

void fr_lv_end_queue(fr_level *level, lv_arrays *a)
{
    end_rest(level, a);
    if (level->open != 0)
        close_stretch(level, a);
    level->ready = level->end;
}
