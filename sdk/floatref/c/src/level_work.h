/* SPDX-License-Identifier: Apache-2.0
 *
 * The fit of a stretch: what its parts share. Everything is in double, also in the float build.
 *
 * The unknowns are z and s at `points` points of the road, r, theta, b, u, n, o and mu at `nodes`
 * nodes in time, and the constants of the vehicle, in that order (docs/road-prior-slope.md).
 */
#ifndef FR_LEVEL_WORK_H
#define FR_LEVEL_WORK_H

#include "object.h"

enum { LV_HEIGHT, LV_PITCH, LV_BIAS, LV_HEAVE, LV_NOD, LV_OFFSET, LV_MOMENT, LV_IN_TIME };
enum {
    LV_GAIN, LV_LEAN, LV_PLACE, LV_STIFF_FRONT, LV_STIFF_REAR, LV_DAMP_FRONT, LV_DAMP_REAR,
    LV_TURNING, LV_GLOBALS
};
enum { LV_LASER, LV_FRONT, LV_REAR, LV_ENDS };
/* Groups of rows, in their order. LV_KNOWN are those of the road outside of the brake. */
enum {
    LV_WALK, LV_HEAVES, LV_NODS, LV_PRIORS, LV_RISES, LV_MEANS, LV_BENDS, LV_READ, LV_SAGS,
    LV_TURNS,
    LV_FORCES, LV_BOUNCES, LV_PITCHES, LV_KNOWN, LV_GROUPS
};

enum { LV_PIVOTS = 8, LV_SLOTS = 4, LV_STRIP = 6, LV_ROW = 64, LV_PRIOR = 12, LV_NODE_VALUES = 143,
       LV_POINT_VALUES = 9, LV_SIDE = 32, LV_WIDER = 72 };

#define LV_SPACING_M 0.25
#define LV_GRAVITY 9.80665
#define LV_SHARE (1.0 / 12.0)
#define LV_MIDDLE (10.0 / 12.0)
#define LV_INFINITE 1e300

/* The mean of the road over what passes at a node: shares of points that follow each other. */
typedef struct lv_strip {
    int32_t count;
    int32_t column[LV_STRIP];
    double value[LV_STRIP];
} lv_strip;

/* The memory that a configuration needs, in numbers of things. */
typedef struct lv_room {
    int32_t bins, nodes, points, unknowns, groups, rows, width, marks;
    size_t values;
} lv_room;

typedef struct lv_row {
    int32_t count;
    int32_t column[LV_ROW];
    double value[LV_ROW];
} lv_row;

/* What the unknowns make of the vehicle. */
typedef struct lv_car {
    double stiffness[2], damping[2], ahead_m[2], soft[2], by[2];
    double shares[2][3];   /* from compression at three nodes to push */
    double centre_m, moment;
} lv_car;

typedef struct lv_work {
    const fr_level_fit_config *config;
    lv_room room;
    int32_t nodes, points, unknowns, middles, rows, width, groups, every, wide;
    int32_t begin[LV_GROUPS + 1]; /* the first row of each group */
    double interval_s, first_m;
    double mean[LV_GLOBALS], sigma_of[LV_GLOBALS];
    /* Nodes. */
    double *bin, *height, *force, *place, *speed, *along, *missing, *pause, *jolt, *sharp;
    double *pressed[2], *tilt, *beta;
    int32_t *rested, *middle;
    lv_strip *strip[LV_ENDS];
    /* Rows: 1-sigma, misfit, and the derivatives by rows. */
    double *sigma, *misfit, *value;
    int32_t *column, *start, *by_group;
    /* Unknowns. */
    double *y, *moved, *step, *right, *solved, *bends, *key;
    int32_t *order, *place_of, *slot, *enters, *pivots, *bounds, *taken;
    double *panel, *diagonal, *front, *scaled;
    /* The elevation's 1-sigma. */
    int32_t marks;
    int32_t *point_of, *middle_of; /* points of marks, and of the middles of rows outside */
    double *mark, *found, *high_pass, *tails, *carried, *rows_of, *scaled_of, *with;
} lv_work;

static inline double lv_triple(const double *x, int32_t k)
{
    return LV_SHARE * x[k - 1] + LV_MIDDLE * x[k] + LV_SHARE * x[k + 1];
}

/* Where a row of a matrix of so many columns begins. */
static inline size_t lv_at(int32_t row, int32_t columns)
{
    return (size_t)row * (size_t)columns;
}

static inline int32_t lv_in_time(const lv_work *w, int32_t name)
{
    return 2 * w->points + name * w->nodes;
}

static inline int32_t lv_global(const lv_work *w, int32_t name)
{
    return w->unknowns - LV_GLOBALS + name;
}

static inline double lv_second(const lv_work *w, const double *x, int32_t k)
{
    return (x[k - 1] - 2.0 * x[k] + x[k + 1]) / (w->interval_s * w->interval_s);
}

static inline double lv_passed(const lv_strip *strip, const double *road)
{
    double sum = 0.0;
    for (int32_t i = 0; i < strip->count; i++)
        sum += strip->value[i] * road[strip->column[i]];
    return sum;
}

static inline void lv_add(lv_row *row, int32_t column, double value)
{
    row->column[row->count] = column;
    row->value[row->count] = value;
    row->count++;
}

/* Bytes of a workspace and, unless `memory` is NULL, its arrays; 0 for a bad configuration. */
size_t fr_lv_lay_out(lv_work *w, const fr_level_fit_config *config, void *memory);

/* Nodes from bins; returns their number, or -1 if there is no room. */
int32_t fr_lv_read(lv_work *w, const fr_level_bins *bins);

/* The road's points, strips, jolts and rests; 0 if there is no room. */
int fr_lv_lay_road(lv_work *w);

/* `x` in order, by a sort without recursion; `keys` ascending and stable over `index`. */
void fr_lv_sort(int32_t *index, const double *keys, int32_t *spare, int32_t count);

/* The line through values at rising places; held beyond the ends. */
double fr_lv_line(const double *places, const double *values, int32_t count, double x);

void fr_lv_start(lv_work *w);
void fr_lv_prior(const lv_work *w, int32_t which, int32_t *column, double *mean, double *sigma);
void fr_lv_fix_sigmas(lv_work *w);
void fr_lv_hold(lv_work *w, double loose, int first);
void fr_lv_find_misfits(lv_work *w, const double *y, double *sum);
void fr_lv_derive(lv_work *w, int known);
void fr_lv_end_row(lv_work *w, lv_row *row, int32_t number);

void fr_lv_set_car(const lv_work *w, const double *y, lv_car *car);
void fr_lv_press(lv_work *w, const lv_car *car, const double *y);
double fr_lv_bounce(const lv_work *w, const lv_car *car, const double *y, int32_t k);
double fr_lv_pitch(const lv_work *w, const lv_car *car, const double *y, int32_t at);
void fr_lv_derive_springs(lv_work *w, const double *y);

/* The order of elimination, slots and groups of the rows there are; 0 if the front has no room. */
int fr_lv_plan(lv_work *w, int32_t most_width);
int fr_lv_factor(lv_work *w);
void fr_lv_solve(lv_work *w, const double *right, double *x);
int fr_lv_eliminate_group(lv_work *w, int32_t group, double *panel, double *diagonal);

/* Fit bins that are in their ranges: see fr_level_fit(). */
void fr_lv_fit_bins(lv_work *w, const fr_level_bins *bins, fr_level_result *result, double *pitch,
                    double *sigma_m);

int32_t fr_lv_fit(lv_work *w, double *changed);
double fr_lv_prior_misfit(const lv_work *w);
double fr_lv_grade(const lv_work *w);

/* Put shares of the rows of `s` out of a row: see level_fronts.c. */
void fr_lv_take_products(double *out, const double *s, int32_t stride,
                         const double *shares, int32_t count);

/* 1-sigma in `found` at the `marks`; 0 if it is lost in rounding or has no room. */
int fr_lv_elevation_sigma(lv_work *w);

/* Rows of the road outside of the brake, and by how much the slope turns in a wheelbase. */
void fr_lv_lay_known(lv_work *w);
double fr_lv_turn(lv_work *w);

#endif
