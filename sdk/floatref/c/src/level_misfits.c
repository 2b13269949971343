/* SPDX-License-Identifier: Apache-2.0
 *
 * How far the rows are off at some unknowns, over their 1-sigma.
 */
#include "level_model.h"
#include "level_work.h"

static void miss(lv_work *w, int32_t row, double off)
{
    w->misfit[row] = off / w->sigma[row];
}

static void miss_steps(lv_work *w, int32_t group, const double *x, int32_t count)
{
    for (int32_t i = 0; i + 1 < count; i++)
        miss(w, w->begin[group] + i, -(x[i + 1] - x[i]));
}

static void miss_each(lv_work *w, int32_t group, const double *x, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        miss(w, w->begin[group] + i, -x[i]);
}

static void miss_before(lv_work *w, const double *y)
{
    int32_t K = w->nodes, N = w->points;
    miss_steps(w, LV_WALK, y + lv_in_time(w, LV_BIAS), K);
    miss_each(w, LV_HEAVES, y + lv_in_time(w, LV_HEAVE), K);
    miss_each(w, LV_NODS, y + lv_in_time(w, LV_NOD), K);
    for (int32_t i = 0; i < LV_PRIOR; i++) {
        int32_t column;
        double mean, sigma;
        fr_lv_prior(w, i, &column, &mean, &sigma);
        miss(w, w->begin[LV_PRIORS] + i, mean - y[column]);
    }
    for (int32_t j = 0; j + 1 < N; j++)
        miss(w, w->begin[LV_RISES] + j, -(y[j + 1] - y[j] - LV_SPACING_M * y[N + j]));
    miss_each(w, LV_MEANS, y + N, N);
    miss_steps(w, LV_BENDS, y + N, N);
}

static void miss_heights(lv_work *w, const double *y)
{
    const double *height = y + lv_in_time(w, LV_HEIGHT), *pitch = y + lv_in_time(w, LV_PITCH);
    int32_t row = w->begin[LV_READ];
    for (int32_t k = 0; k < w->nodes; k++) {
        const lv_strip *strip = &w->strip[LV_LASER][k];
        double lever = w->config->lever_m - LV_SWAY_M * lv_passed(strip, y + w->points);
        double body = height[k] + lever * pitch[k];
        if (w->height[k] == w->height[k]) {
            miss(w, row, w->height[k] - (body - lv_passed(strip, y)));
            row++;
        }
    }
}

/* What the force is more than that of a level axis without a bias. */
static double tilted(const lv_work *w, const double *y, int32_t k)
{
    double tilt = y[lv_in_time(w, LV_PITCH) + k] + y[lv_global(w, LV_LEAN)];
    return w->along[k] * tilt + 0.5 * LV_GRAVITY * (tilt * tilt) - y[lv_in_time(w, LV_BIAS) + k];
}

static void miss_forces(lv_work *w, const double *y)
{
    for (int32_t at = 0; at < w->middles; at++) {
        int32_t k = w->middle[at];
        double level[3] = {tilted(w, y, k - 1), tilted(w, y, k), tilted(w, y, k + 1)};
        double height = lv_second(w, y + lv_in_time(w, LV_HEIGHT), k);
        miss(w, w->begin[LV_FORCES] + at, w->force[k] + lv_triple(level, 1) - height);
    }
}

static void miss_springs(lv_work *w, const double *y)
{
    lv_car car;
    fr_lv_set_car(w, y, &car);
    fr_lv_press(w, &car, y);
    for (int32_t at = 0; at < w->middles; at++) {
        miss(w, w->begin[LV_BOUNCES] + at, -fr_lv_bounce(w, &car, y, w->middle[at]));
        miss(w, w->begin[LV_PITCHES] + at, -fr_lv_pitch(w, &car, y, at));
    }
}

/* Misfits at the unknowns `y`, and the sum of their squares. */
void fr_lv_find_misfits(lv_work *w, const double *y, double *sum)
{
    miss_before(w, y);
    miss_heights(w, y);
    miss_steps(w, LV_SAGS, y + lv_in_time(w, LV_OFFSET), w->nodes);
    miss_steps(w, LV_TURNS, y + lv_in_time(w, LV_MOMENT), w->nodes);
    miss_forces(w, y);
    miss_springs(w, y);
    *sum = 0.0;
    for (int32_t row = 0; row < w->begin[LV_KNOWN]; row++)
        *sum += w->misfit[row] * w->misfit[row];
}
