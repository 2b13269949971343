/* SPDX-License-Identifier: Apache-2.0
 *
 * The order in which unknowns are eliminated, so that few are together in rows at a time, and the
 * slot that each has in the front meanwhile.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"

/* The slope at a point is eliminated before, the elevation behind the last node to touch it. */
#define BEFORE (-0.75)
#define BEHIND 0.25

/* Between points that were touched as if evenly, beyond them as the outermost; -1 is untouched. */
static void spread_touch(double *last, int32_t count)
{
    int32_t before = -1;
    for (int32_t j = 0; j < count; j++) {
        if (last[j] < 0.0)
            continue;
        for (int32_t i = before + 1; i < j; i++) {
            double slope = before < 0 ? 0.0 : (last[j] - last[before]) / (double)(j - before);
            last[i] = before < 0 ? last[j] : slope * (double)(i - before) + last[before];
        }
        before = j;
    }
    for (int32_t i = before + 1; i < count && before >= 0; i++)
        last[i] = last[before];
}

/* The last touch of all ends up to `ends`, by the nodes they touch, as a key of order. */
static void key_road(lv_work *w, double *last, int32_t ends, double shift)
{
    for (int32_t j = 0; j < w->points; j++)
        last[j] = -1.0;
    for (int32_t k = 0; k < w->nodes; k++)
        for (int32_t end = 0; end < ends; end++)
            for (int32_t i = 0; i < w->strip[end][k].count; i++)
                last[w->strip[end][k].column[i]] = (double)k;
    spread_touch(last, w->points);
    for (int32_t j = 0; j < w->points; j++)
        last[j] += shift;
}

static void find_order(lv_work *w)
{
    key_road(w, w->key, LV_ENDS, BEHIND);
    key_road(w, w->key + w->points, 1, BEFORE);
    for (int32_t name = 0; name < LV_IN_TIME; name++)
        for (int32_t k = 0; k < w->nodes; k++)
            w->key[lv_in_time(w, name) + k] = (double)k;
    for (int32_t i = 0; i < LV_GLOBALS; i++)
        w->key[lv_global(w, i)] = LV_INFINITE;
    for (int32_t i = 0; i < w->unknowns; i++)
        w->order[i] = i;
    fr_lv_sort(w->order, w->key, w->enters, w->unknowns);
    for (int32_t i = 0; i < w->unknowns; i++)
        w->place_of[w->order[i]] = i;
}

/* The group with which a row comes: that of its first unknown. */
static int32_t group_of(const lv_work *w, int32_t row)
{
    int32_t first = w->unknowns;
    for (int32_t a = w->start[row]; a < w->start[row + 1]; a++)
        if (w->place_of[w->column[a]] < first)
            first = w->place_of[w->column[a]];
    return first / LV_PIVOTS;
}

/* The rows by their groups, in their order within each: a sort by counting. */
static void group_rows(lv_work *w)
{
    for (int32_t g = 0; g <= w->groups; g++)
        w->bounds[g] = 0;
    for (int32_t row = 0; row < w->rows; row++)
        w->bounds[group_of(w, row) + 1]++;
    for (int32_t g = 0; g < w->groups; g++)
        w->bounds[g + 1] += w->bounds[g];
    for (int32_t row = 0; row < w->rows; row++) {
        int32_t *next = w->bounds + group_of(w, row);
        w->by_group[*next] = row;
        *next += 1;
    }
    for (int32_t g = w->groups; g > 0; g--)
        w->bounds[g] = w->bounds[g - 1];
    w->bounds[0] = 0;
}

/* The group at which each unknown comes into the front. */
static void find_entries(lv_work *w)
{
    for (int32_t i = 0; i < w->unknowns; i++)
        w->enters[i] = w->place_of[i] / LV_PIVOTS;
    for (int32_t row = 0; row < w->rows; row++) {
        int32_t group = group_of(w, row);
        for (int32_t a = w->start[row]; a < w->start[row + 1]; a++)
            if (w->enters[w->column[a]] > group)
                w->enters[w->column[a]] = group;
    }
}

/* Let an unknown into the first slot that is free; 0 if there is none. */
static int enter(lv_work *w, int32_t unknown, int32_t *free, int32_t most)
{
    while (*free < most && w->taken[*free] != 0)
        (*free)++;
    if (*free == most)
        return 0;
    w->taken[*free] = 1;
    w->slot[unknown] = *free;
    if (*free + 1 > w->width)
        w->width = *free + 1;
    return 1;
}

/* Those that are eliminated with the group leave their slots. */
static void leave(lv_work *w, int32_t group)
{
    for (int32_t p = 0; p < LV_PIVOTS; p++) {
        int32_t place = group * LV_PIVOTS + p;
        w->pivots[place] = place < w->unknowns ? w->slot[w->order[place]] : -1;
        if (place < w->unknowns)
            w->taken[w->pivots[place]] = 0;
    }
}

/* Unknowns by the group in which they enter, then by their place, by counting. */
static void sort_entries(lv_work *w)
{
    int32_t *entering = w->by_group, *keys = w->bounds;
    for (int32_t g = 0; g <= w->groups; g++)
        keys[g] = 0;
    for (int32_t i = 0; i < w->unknowns; i++)
        keys[w->enters[i] + 1]++;
    for (int32_t g = 0; g < w->groups; g++)
        keys[g + 1] += keys[g];
    for (int32_t place = 0; place < w->unknowns; place++) {
        int32_t *next = keys + w->enters[w->order[place]];
        entering[*next] = w->order[place];
        *next += 1;
    }
    for (int32_t g = w->groups; g > 0; g--)
        keys[g] = keys[g - 1];
    keys[0] = 0;
}

static int give_slots(lv_work *w, int32_t most)
{
    sort_entries(w);
    w->width = 0;
    for (int32_t i = 0; i < most; i++)
        w->taken[i] = 0;
    for (int32_t g = 0; g < w->groups; g++) {
        int32_t free = 0;
        for (int32_t e = w->bounds[g]; e < w->bounds[g + 1]; e++)
            if (!enter(w, w->by_group[e], &free, most))
                return 0;
        leave(w, g);
    }
    w->width = (w->width + LV_SLOTS - 1) / LV_SLOTS * LV_SLOTS;
    return 1;
}

int fr_lv_plan(lv_work *w, int32_t most_width)
{
    w->groups = (w->unknowns + LV_PIVOTS - 1) / LV_PIVOTS;
    find_order(w);
    find_entries(w);
    if (!give_slots(w, most_width))
        return 0;
    group_rows(w);
    return 1;
}
