/* SPDX-License-Identifier: Apache-2.0
 *
 * The settings of the fit of a stretch, and where its arrays lie in the caller's memory.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"
#include "samples.h"

#define MOST_STEP_S 0.06
#define LEAST_STEP_S 0.002
#define MOST_LENGTH_S 600.0
#define MOST_TRAVEL_M 10000.0
#define MOST_WAVELENGTH_M 1000.0
#define MOST_PLACE_M 100.0

fr_level_fit_config fr_level_fit_defaults(void)
{
    fr_level_fit_config config = {
        0.01,  0.0,  0.0,  0.0,     105.91,  4e-6,   2e-7, 1.5e-4, 0.3, 0.03, 1e-4, 0.0, 0.0, 0.0,
        0.0,   1.6,  0.3,  120.0,   1500.0,  96,     0};
    /* The usual gain, 0.005 with a 1-sigma of 0.004, and the smoother's, 0 with 0.01, together. */
    double usual = 1.0 / (0.004 * 0.004), tilt = 1.0 / (0.01 * 0.01);
    config.gain = usual * 0.005 / (usual + tilt);
    config.gain_sigma = sqrt(1.0 / (usual + tilt));
    config.lean_sigma_rad = 0.03 / sqrt(2.0);
    return config;
}

static int is_within(double x, double least, double most)
{
    return x >= least && x <= most;
}

/* The range keeps squares and their sums far from what a double can hold. */
static int is_density(double x)
{
    return is_within(x, 1e-12, 1e6);
}

static int has_vehicle(const fr_level_fit_config *c)
{
    return is_within(c->front_m, -MOST_PLACE_M, MOST_PLACE_M) &&
           is_within(c->rear_m, -MOST_PLACE_M, MOST_PLACE_M) &&
           is_within(c->lever_m, -MOST_PLACE_M, MOST_PLACE_M) &&
           is_within(c->front_m - c->rear_m, 0.1, MOST_PLACE_M) &&
           is_within(c->pitch_hz, 0.01, 100.0) && is_within(c->pitch_damping, 1e-3, 1.0);
}

static int has_densities(const fr_level_fit_config *c)
{
    return is_density(c->road_m) && is_density(c->bends_per_m) && is_density(c->acceleration) &&
           is_density(c->missing_acceleration) && is_density(c->bias) && is_density(c->walk) &&
           is_density(c->gain_sigma) && is_density(c->lean_sigma_rad) &&
           is_within(c->gain, LV_LEAST_GAIN, LV_MOST_GAIN) && is_within(c->lean_rad, -1.0, 1.0);
}

static int is_possible(const fr_level_fit_config *c)
{
    return c != NULL && is_within(c->step_s, LEAST_STEP_S, MOST_STEP_S) && has_vehicle(c) &&
           has_densities(c) && is_within(c->wavelength_m, 1.0, MOST_WAVELENGTH_M) &&
           is_within(c->longest_s, LV_SHORTEST_S, MOST_LENGTH_S) &&
           is_within(c->most_travel_m, 1.0, MOST_TRAVEL_M) && c->most_width >= 2 * LV_PIVOTS &&
           c->most_width <= 512 && c->reserved == 0;
}

/* From the rearmost of laser and axles to the foremost. */
static double span_of(const fr_level_fit_config *c)
{
    return fmax(c->front_m, 0.0) - fmin(c->rear_m, 0.0);
}

static lv_room room_for_fit(const fr_level_fit_config *c, int32_t every)
{
    lv_room room = {0, 0, 0, 0, 0, 0, 0, 0, 0u};
    room.bins = (int32_t)rint(c->longest_s / c->step_s);
    room.nodes = room.bins / every + 1;
    room.points = (int32_t)ceil((c->most_travel_m + span_of(c) + 2.0) / LV_SPACING_M) + 3;
    room.unknowns = 2 * room.points + LV_IN_TIME * room.nodes + LV_GLOBALS;
    room.groups = (room.unknowns + LV_PIVOTS - 1) / LV_PIVOTS;
    room.rows = 9 * room.nodes + 4 * room.points + LV_PRIOR;
    room.width = (c->most_width + LV_SLOTS - 1) / LV_SLOTS * LV_SLOTS;
    room.marks = (int32_t)rint(c->most_travel_m / LV_MARKS_M) + 2;
    room.values = (size_t)room.nodes * LV_NODE_VALUES + (size_t)room.points * LV_POINT_VALUES +
                  LV_PRIOR;
    return room;
}

typedef struct arena {
    unsigned char *base; /* NULL to count alone */
    uint64_t used;
} arena;

static void *give(arena *a, size_t count, size_t each)
{
    unsigned char *place = a->base == NULL ? NULL : a->base + (size_t)a->used;
    a->used += ((uint64_t)count * each + 7u) / 8u * 8u;
    return (void *)place;
}

static double *give_reals(arena *a, int32_t count)
{
    return (double *)give(a, (size_t)count, sizeof(double));
}

static int32_t *give_wholes(arena *a, size_t count)
{
    return (int32_t *)give(a, count, sizeof(int32_t));
}

static void lay_nodes(lv_work *w, arena *a)
{
    double **arrays[] = {&w->bin,   &w->height,  &w->force, &w->place, &w->speed,
                         &w->along, &w->missing, &w->pause, &w->jolt,  &w->sharp,
                         &w->tilt,  &w->beta,    &w->pressed[0], &w->pressed[1]};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        *arrays[i] = give_reals(a, w->room.nodes);
    w->rested = give_wholes(a, (size_t)w->room.nodes);
    w->middle = give_wholes(a, (size_t)w->room.nodes);
    for (int32_t end = 0; end < LV_ENDS; end++)
        w->strip[end] = (lv_strip *)give(a, (size_t)w->room.nodes, sizeof(lv_strip));
}

static void lay_rows(lv_work *w, arena *a)
{
    w->sigma = give_reals(a, w->room.rows);
    w->misfit = give_reals(a, w->room.rows);
    w->value = (double *)give(a, w->room.values, sizeof(double));
    w->column = give_wholes(a, w->room.values);
    w->start = give_wholes(a, (size_t)w->room.rows + 1u);
    w->by_group = give_wholes(a, (size_t)w->room.rows);
}

static void lay_unknowns(lv_work *w, arena *a)
{
    double **arrays[] = {&w->y, &w->moved, &w->step, &w->right, &w->solved, &w->key};
    int32_t **wholes[] = {&w->order, &w->place_of, &w->slot, &w->enters};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        *arrays[i] = give_reals(a, w->room.groups * LV_PIVOTS);
    for (size_t i = 0; i < sizeof wholes / sizeof wholes[0]; i++)
        *wholes[i] = give_wholes(a, (size_t)w->room.unknowns);
    w->bends = give_reals(a, w->room.points);
    w->pivots = give_wholes(a, (size_t)w->room.groups * LV_PIVOTS);
    w->bounds = give_wholes(a, (size_t)w->room.groups + 1u);
}

static void lay_factors(lv_work *w, arena *a)
{
    size_t wide = (size_t)w->room.width + LV_WIDER, panel = (size_t)w->room.groups * LV_PIVOTS;
    w->taken = give_wholes(a, wide);
    w->diagonal = give_reals(a, w->room.groups * LV_PIVOTS);
    w->scaled = (double *)give(a, wide * LV_PIVOTS, sizeof(double));
    w->front = (double *)give(a, wide * wide, sizeof(double));
    w->panel = (double *)give(a, panel * (size_t)w->room.width, sizeof(double));
}

/* Every mark of the 1-sigma is a column, and so are gain and grade. */
static void lay_marks(lv_work *w, arena *a)
{
    size_t columns = (size_t)w->room.marks + 2u, wide = (size_t)w->room.width + LV_WIDER;
    w->point_of = give_wholes(a, (size_t)w->room.marks);
    w->middle_of = give_wholes(a, (size_t)w->room.points);
    w->mark = give_reals(a, w->room.marks);
    w->found = give_reals(a, w->room.marks);
    w->tails = give_reals(a, 4 * w->room.marks);
    w->high_pass = give_reals(a, w->wide + 1);
    w->with = (double *)give(a, columns * 3u, sizeof(double));
    w->carried = (double *)give(a, columns * wide, sizeof(double));
    w->rows_of = (double *)give(a, columns * LV_PIVOTS, sizeof(double));
    w->scaled_of = (double *)give(a, columns * LV_PIVOTS, sizeof(double));
}

size_t fr_lv_lay_out(lv_work *w, const fr_level_fit_config *config, void *memory)
{
    arena a = {(unsigned char *)memory, 0u};
    if (!is_possible(config))
        return 0u;
    w->config = config;
    w->every = (int32_t)fmax(1.0, rint(LV_INTERVAL_S / config->step_s));
    w->interval_s = (double)w->every * config->step_s;
    w->wide = (int32_t)ceil(LV_REACH * config->wavelength_m / LV_SPACING_M);
    w->room = room_for_fit(config, w->every);
    lay_nodes(w, &a);
    lay_rows(w, &a);
    lay_unknowns(w, &a);
    lay_factors(w, &a);
    lay_marks(w, &a);
    return a.used > (uint64_t)(SIZE_MAX / 2u) ? 0u : (size_t)a.used;
}
