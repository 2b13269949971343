/* SPDX-License-Identifier: Apache-2.0
 *
 * What is known before the readings, and the 1-sigma of every row.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"
#include "samples.h"

static void know_vehicle(lv_work *w)
{
    double omega = 2.0 * FR_PI * w->config->pitch_hz, squared = LV_GYRATION * LV_GYRATION;
    double stiffness = log(0.5 * omega * omega * squared);
    double damping = log(w->config->pitch_damping * omega * squared);
    const double means[] = {w->config->gain, w->config->lean_rad, LV_CENTRE, stiffness,
                      stiffness,       damping,             damping,   log(LV_GYRATION)};
    const double sigmas[] = {w->config->gain_sigma, w->config->lean_sigma_rad, LV_CENTRE_SIGMA,
                       LV_STIFFNESS_SIGMA,    LV_STIFFNESS_SIGMA,        LV_DAMPING_SIGMA,
                       LV_DAMPING_SIGMA,      LV_GYRATION_SIGMA};
    for (int32_t i = 0; i < LV_GLOBALS; i++) {
        w->mean[i] = means[i];
        w->sigma_of[i] = sigmas[i];
    }
}

void fr_lv_prior(const lv_work *w, int32_t which, int32_t *column, double *mean, double *sigma)
{
    const int32_t first[] = {lv_in_time(w, LV_BIAS), lv_in_time(w, LV_OFFSET),
                             lv_in_time(w, LV_MOMENT), 0};
    const double sigmas[] = {w->config->bias, LV_OFFSET_M, LV_MOMENT_SIGMA, LV_START_M};
    if (which < 4) {
        *column = first[which];
        *mean = 0.0;
        *sigma = sigmas[which];
    } else {
        *column = lv_global(w, which - 4);
        *mean = w->mean[which - 4];
        *sigma = w->sigma_of[which - 4];
    }
}

static int32_t count_read(const lv_work *w)
{
    int32_t count = 0;
    for (int32_t k = 0; k < w->nodes; k++)
        count += w->height[k] == w->height[k] ? 1 : 0;
    return count;
}

/* The first row of each group; those outside of the brake are counted when they are laid. */
static void count_rows(lv_work *w)
{
    int32_t K = w->nodes, N = w->points;
    const int32_t counts[LV_GROUPS] = {K - 1, K, K, LV_PRIOR, N - 1, N, N - 1, count_read(w),
                                       K - 1, K - 1, w->middles, w->middles, w->middles, 0};
    w->begin[0] = 0;
    for (int32_t group = 0; group < LV_GROUPS; group++)
        w->begin[group + 1] = w->begin[group] + counts[group];
    w->rows = w->begin[LV_GROUPS];
}

void fr_lv_start(lv_work *w)
{
    know_vehicle(w);
    count_rows(w);
    for (int32_t i = 0; i < w->unknowns; i++)
        w->y[i] = 0.0;
    for (int32_t i = 0; i < LV_GLOBALS; i++)
        w->y[lv_global(w, i)] = w->mean[i];
    for (int32_t j = 0; j + 1 < w->points; j++)
        w->bends[j] = LV_FIRST_BEND * w->config->bends_per_m;
}

static void fill_group(lv_work *w, int32_t group, double sigma)
{
    for (int32_t row = w->begin[group]; row < w->begin[group + 1]; row++)
        w->sigma[row] = sigma;
}

static double square(double x)
{
    return x * x;
}

static void fix_sensors(lv_work *w)
{
    double *read = w->sigma + w->begin[LV_READ], *force = w->sigma + w->begin[LV_FORCES];
    double known = square(w->config->acceleration);
    double missed = square(w->config->missing_acceleration);
    for (int32_t k = 0; k < w->nodes; k++) {
        double between_m = fmin(w->speed[k] * w->interval_s, LV_SPACING_M);
        *read = sqrt(square(LV_READING_M) + w->config->road_m * between_m / 3.0);
        read += w->height[k] == w->height[k] ? 1 : 0;
    }
    for (int32_t m = 0; m < w->middles; m++) {
        const double *share = w->missing + w->middle[m];
        double missing = fmax(fmax(share[-1], share[0]), share[1]);
        double noise = (known + missing * (missed - known)) / w->interval_s;
        force[m] = sqrt(noise + square(LV_FORCE_SHARE * w->force[w->middle[m]]));
    }
}

void fr_lv_fix_sigmas(lv_work *w)
{
    double *walk = w->sigma + w->begin[LV_WALK];
    for (int32_t k = 0; k < w->nodes; k++) {
        if (k > 0)
            walk[k - 1] = w->config->walk * sqrt(w->pause[k]);
        w->sigma[w->begin[LV_HEAVES] + k] = LV_HEAVE_M + LV_HEAVE_SPEED * w->speed[k];
        w->sigma[w->begin[LV_NODS] + k] = LV_NOD_RAD + LV_NOD_SPEED * w->speed[k];
    }
    for (int32_t i = 0; i < LV_PRIOR; i++) {
        int32_t column;
        double mean;
        fr_lv_prior(w, i, &column, &mean, w->sigma + w->begin[LV_PRIORS] + i);
    }
    fill_group(w, LV_RISES, sqrt(w->config->road_m * LV_SPACING_M));
    fill_group(w, LV_MEANS, LV_SLOPE * sqrt(LV_SLOPE_REACH_M / LV_SPACING_M));
    fix_sensors(w);
}

/* The 1-sigma of bounce in m/s^2 and of pitch in rad/s^2, of all middles. */
static void hold_springs(lv_work *w, double loose)
{
    double root = sqrt(w->interval_s);
    double *bounce = w->sigma + w->begin[LV_BOUNCES], *pitch = w->sigma + w->begin[LV_PITCHES];
    for (int32_t m = 0; m < w->middles; m++) {
        double speed = w->speed[w->middle[m]], jolt = w->jolt[w->middle[m]];
        bounce[m] =
            loose * hypot((LV_BOUNCE + LV_BOUNCE_SPEED * speed) / root, LV_JOLT_BOUNCE * jolt);
        pitch[m] = loose * hypot((LV_SWING + LV_SWING_SPEED * speed) / root, LV_JOLT_PITCH * jolt);
    }
}

static double sag_sigma(const lv_work *w, int32_t k, int first)
{
    const double *offset = w->y + lv_in_time(w, LV_OFFSET);
    double variance = square(LV_OFFSET_WALK) * w->pause[k];
    double sagged = first != 0 ? LV_FIRST_SAG_M : offset[k] - offset[k - 1];
    return sqrt(w->rested[k] != 0 ? 0.5 * (variance + square(sagged)) : variance);
}

/* What is held while a pass finds the unknowns. */
void fr_lv_hold(lv_work *w, double loose, int first)
{
    lv_car car;
    double *sags = w->sigma + w->begin[LV_SAGS], *turns = w->sigma + w->begin[LV_TURNS];
    fr_lv_set_car(w, w->y, &car);
    fr_lv_press(w, &car, w->y);
    for (int32_t j = 0; j + 1 < w->points; j++)
        w->sigma[w->begin[LV_BENDS] + j] = sqrt(w->bends[j] * LV_SPACING_M);
    for (int32_t k = 1; k < w->nodes; k++) {
        double turned = LV_MOMENT_SHARE * LV_GRAVITY * (w->beta[k] - w->beta[k - 1]);
        sags[k - 1] = sag_sigma(w, k, first);
        turns[k - 1] = hypot(LV_MOMENT_WALK * sqrt(w->pause[k]), turned);
    }
    hold_springs(w, loose);
}
