/* SPDX-License-Identifier: Apache-2.0
 *
 * The rows of what is known before and of both sensors: derivatives, and misfits of all rows, over
 * their 1-sigma.
 */
#include "level_model.h"
#include "level_work.h"

/* Store a row over its 1-sigma, by slots once these are known: rows are short enough
 * for a sort by insertion. */
void fr_lv_end_row(lv_work *w, lv_row *row, int32_t number)
{
    int32_t *column = w->column + w->start[number];
    double *value = w->value + w->start[number], sure = 1.0 / w->sigma[number];
    for (int32_t i = 0; i < row->count; i++) {
        int32_t at = i;
        while (w->width > 0 && at > 0 && w->slot[column[at - 1]] > w->slot[row->column[i]]) {
            column[at] = column[at - 1];
            value[at] = value[at - 1];
            at--;
        }
        column[at] = row->column[i];
        value[at] = row->value[i] * sure;
    }
    w->start[number + 1] = w->start[number] + row->count;
}

/* A row of up to three unknowns; those with a column below 0 are left out. */
static void end_three(lv_work *w, int32_t number, const int32_t *columns, const double *values)
{
    lv_row row;
    row.count = 0;
    for (int32_t i = 0; i < 3; i++)
        if (columns[i] >= 0)
            lv_add(&row, columns[i], values[i]);
    fr_lv_end_row(w, &row, number);
}

/* Steps from each value to the next of `count`, in the group of rows. */
static void derive_steps(lv_work *w, int32_t group, int32_t first, int32_t count)
{
    const double values[3] = {-1.0, 1.0, 0.0};
    for (int32_t i = 0; i + 1 < count; i++) {
        int32_t columns[3] = {first + i, first + i + 1, -1};
        end_three(w, w->begin[group] + i, columns, values);
    }
}

static void derive_each(lv_work *w, int32_t group, int32_t first, int32_t count)
{
    const double values[3] = {1.0, 0.0, 0.0};
    for (int32_t i = 0; i < count; i++) {
        int32_t columns[3] = {first + i, -1, -1};
        end_three(w, w->begin[group] + i, columns, values);
    }
}

static void derive_priors(lv_work *w)
{
    const double values[3] = {1.0, 0.0, 0.0};
    for (int32_t i = 0; i < LV_PRIOR; i++) {
        int32_t columns[3] = {0, -1, -1};
        double mean, sigma;
        fr_lv_prior(w, i, &columns[0], &mean, &sigma);
        end_three(w, w->begin[LV_PRIORS] + i, columns, values);
    }
}

static void derive_rises(lv_work *w)
{
    const double values[3] = {-1.0, 1.0, -LV_SPACING_M};
    for (int32_t j = 0; j + 1 < w->points; j++) {
        int32_t columns[3] = {j, j + 1, w->points + j};
        end_three(w, w->begin[LV_RISES] + j, columns, values);
    }
}

static double lever_at(const lv_work *w, const double *y, int32_t k)
{
    return w->config->lever_m - LV_SWAY_M * lv_passed(&w->strip[LV_LASER][k], y + w->points);
}

static void derive_reading(lv_work *w, const double *y, int32_t k, int32_t number)
{
    const lv_strip *strip = &w->strip[LV_LASER][k];
    double swayed = -LV_SWAY_M * y[lv_in_time(w, LV_PITCH) + k];
    lv_row row;
    row.count = 0;
    lv_add(&row, lv_in_time(w, LV_HEIGHT) + k, 1.0);
    lv_add(&row, lv_in_time(w, LV_PITCH) + k, lever_at(w, y, k));
    for (int32_t i = 0; i < strip->count; i++)
        lv_add(&row, strip->column[i], -strip->value[i]);
    for (int32_t i = 0; i < strip->count; i++)
        lv_add(&row, w->points + strip->column[i], swayed * strip->value[i]);
    fr_lv_end_row(w, &row, number);
}

static void derive_readings(lv_work *w)
{
    int32_t row = w->begin[LV_READ];
    for (int32_t k = 0; k < w->nodes; k++) {
        if (w->height[k] == w->height[k]) {
            derive_reading(w, w->y, k, row);
            row++;
        }
    }
}

static double tilt_of(const lv_work *w, const double *y, int32_t k)
{
    return y[lv_in_time(w, LV_PITCH) + k] + y[lv_global(w, LV_LEAN)];
}

static void derive_force(lv_work *w, const double *y, int32_t at)
{
    const double seconds[3] = {1.0, -2.0, 1.0}, means[3] = {LV_SHARE, LV_MIDDLE, LV_SHARE};
    double step = w->interval_s * w->interval_s, leaned = 0.0;
    lv_row row;
    row.count = 0;
    for (int32_t i = 0; i < 3; i++) {
        int32_t k = w->middle[at] + i - 1;
        double by_pitch = means[i] * (w->along[k] + LV_GRAVITY * tilt_of(w, y, k));
        leaned += by_pitch;
        lv_add(&row, lv_in_time(w, LV_HEIGHT) + k, seconds[i] / step);
        lv_add(&row, lv_in_time(w, LV_PITCH) + k, -by_pitch);
        lv_add(&row, lv_in_time(w, LV_BIAS) + k, means[i]);
    }
    lv_add(&row, lv_global(w, LV_LEAN), -leaned);
    fr_lv_end_row(w, &row, w->begin[LV_FORCES] + at);
}

static void derive_known_before(lv_work *w)
{
    derive_steps(w, LV_WALK, lv_in_time(w, LV_BIAS), w->nodes);
    derive_each(w, LV_HEAVES, lv_in_time(w, LV_HEAVE), w->nodes);
    derive_each(w, LV_NODS, lv_in_time(w, LV_NOD), w->nodes);
    derive_priors(w);
    derive_rises(w);
    derive_each(w, LV_MEANS, w->points, w->points);
    derive_steps(w, LV_BENDS, w->points, w->points);
}

/* Second differences of the road over 8 m to both sides; the sigma of each is that of its row. */
static void derive_known_outside(lv_work *w)
{
    const double values[3] = {1.0, -2.0, 1.0};
    for (int32_t row = w->begin[LV_KNOWN]; row < w->begin[LV_KNOWN + 1]; row++) {
        int32_t middle = w->middle_of[row - w->begin[LV_KNOWN]];
        int32_t columns[3] = {middle - LV_SIDE, middle, middle + LV_SIDE};
        end_three(w, row, columns, values);
    }
}

/* Derivatives of all rows at the unknowns there are; `known` adds those outside of the brake. */
void fr_lv_derive(lv_work *w, int known)
{
    w->start[0] = 0;
    derive_known_before(w);
    derive_readings(w);
    derive_steps(w, LV_SAGS, lv_in_time(w, LV_OFFSET), w->nodes);
    derive_steps(w, LV_TURNS, lv_in_time(w, LV_MOMENT), w->nodes);
    for (int32_t at = 0; at < w->middles; at++)
        derive_force(w, w->y, at);
    fr_lv_derive_springs(w, w->y);
    if (known != 0)
        derive_known_outside(w);
}
