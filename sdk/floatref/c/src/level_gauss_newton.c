/* SPDX-License-Identifier: Apache-2.0
 *
 * Gauss-Newton over a stretch: the unknowns of least squares.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"

#define PASSES 40
#define FEWEST 7
#define WHOLE_STEPS 10
#define HALVINGS 5
#define SETTLED_RAD 3e-4
#define LOOSEST 30.0
#define TIGHTER 0.5
#define ALLOWED 1.001
#define MORE 1.0

/* Keep the constants of the vehicle in the ranges outside of which there is none. */
static void keep_range(const lv_work *w, double *y)
{
    const double least[] = {LV_LEAST_GAIN, -LV_INFINITE, -0.1,     log(6.0),
                            log(6.0),      log(0.1),     log(0.1), log(0.4)};
    const double most[] = {LV_MOST_GAIN, LV_INFINITE, 1.1,       log(200.0),
                           log(200.0),   log(20.0),   log(20.0), log(1.6)};
    for (int32_t i = 0; i < LV_GLOBALS; i++) {
        double *value = y + lv_global(w, i);
        *value = fmin(fmax(*value, least[i]), most[i]);
    }
}

/* Renew the intensity of each segment by the steps of its slope: the weight of what is known of a
 * plain road, and one more. */
static void renew_bends(lv_work *w)
{
    const double *slope = w->y + w->points;
    double plain = w->config->bends_per_m;
    for (int32_t first = 0; first + 1 < w->points; first += LV_SEGMENT) {
        int32_t end = first + LV_SEGMENT < w->points - 1 ? first + LV_SEGMENT : w->points - 1;
        double total = 0.0, found;
        for (int32_t j = first; j < end; j++)
            total += (slope[j + 1] - slope[j]) * (slope[j + 1] - slope[j]) / LV_SPACING_M;
        found = (LV_BEND_WEIGHT * plain + total) / (LV_BEND_WEIGHT + 1.0);
        found = fmin(fmax(found, plain), LV_MOST_BEND * plain);
        for (int32_t j = first; j < end; j++)
            w->bends[j] = found;
    }
}

/* The step to the least sum of squares of the rows; 0 where rounding leaves no positive matrix. */
static int find_step(lv_work *w)
{
    fr_lv_derive(w, 0);
    for (int32_t i = 0; i < w->unknowns; i++)
        w->right[i] = 0.0;
    for (int32_t row = 0; row < w->rows; row++)
        for (int32_t a = w->start[row]; a < w->start[row + 1]; a++)
            w->right[w->column[a]] += w->value[a] * w->misfit[row];
    if (!fr_lv_factor(w))
        return 0;
    fr_lv_solve(w, w->right, w->step);
    return 1;
}

/* Go by the share of the step, or by a part of it that does not make the sum of squares worse. */
static void go(lv_work *w, double share, double before)
{
    double part = 1.0, after = LV_INFINITE;
    for (int32_t i = 0; i < HALVINGS && !(after <= ALLOWED * before + MORE); i++) {
        for (int32_t j = 0; j < w->unknowns; j++)
            w->moved[j] = w->y[j] + part * (share * w->step[j]);
        keep_range(w, w->moved);
        fr_lv_find_misfits(w, w->moved, &after);
        part *= 0.5;
    }
    for (int32_t j = 0; j < w->unknowns; j++)
        w->y[j] = w->moved[j];
}

static double largest_turn(const lv_work *w)
{
    const double *pitch = w->step + lv_in_time(w, LV_PITCH);
    double most = 0.0;
    for (int32_t k = 0; k < w->nodes; k++)
        most = fmax(most, fabs(pitch[k]));
    return most;
}

/* One pass; returns the largest change of a pitch by its whole step, or infinity without one. */
static double pass(lv_work *w, int32_t number)
{
    double before, loose = fmax(1.0, LOOSEST * pow(TIGHTER, (double)number));
    fr_lv_hold(w, loose, number == 0);
    fr_lv_find_misfits(w, w->y, &before);
    if (!find_step(w))
        return LV_INFINITE;
    go(w, number < WHOLE_STEPS ? 1.0 : 0.5, before);
    renew_bends(w);
    return largest_turn(w);
}

int32_t fr_lv_fit(lv_work *w, double *changed)
{
    int32_t number = 0;
    *changed = LV_INFINITE;
    while (number < PASSES && !(*changed < SETTLED_RAD && number >= FEWEST)) {
        *changed = pass(w, number);
        if (!(*changed < LV_INFINITE))
            return number;
        number++;
    }
    return number;
}

double fr_lv_prior_misfit(const lv_work *w)
{
    double sum = 0.0;
    for (int32_t i = 0; i < LV_PRIOR; i++) {
        int32_t column;
        double mean, sigma;
        fr_lv_prior(w, i, &column, &mean, &sigma);
        sum += (w->y[column] - mean) / sigma * ((w->y[column] - mean) / sigma);
    }
    return sum;
}

double fr_lv_grade(const lv_work *w)
{
    double sum = 0.0;
    for (int32_t j = 0; j < w->points; j++)
        sum += w->y[w->points + j];
    return sum / (double)w->points;
}
