/* SPDX-License-Identifier: Apache-2.0
 *
 * The schedule of observations, sample by sample: (6.48), (6.58) and (6.65).
 */
#include <math.h>

#include "kalman_references.h"

/* Without a usable GNSS reading for so long, constants take its place. */
#define GNSS_PATIENCE_S 0.5
/* Readings at shorter intervals count for less: their errors are those of the one before. */
#define READING_S 0.045
#define USUAL_S 0.05
/* Interval that the first reading is taken to have, and those after a gap. */
#define LONGEST_S 1.0
/* Variance of a new datum of the GNSS height, after an outage, in m^2. */
#define DATUM_VARIANCE 1e4
/* A constant speed is one beyond 5 m/s that changes by less than 0.4 m/s in four seconds. */
#define MOVING_MPS 5.0
#define STEADY_MPS 0.4

void fr_kalman_references_set(fr_kalman_references *r, const fr_kalman_model *model,
                              const fr_kalman_filter_config *config)
{
    const fr_kalman_noise *n = &config->noise;
    const double reading[] = {n->gnss_height_m, n->gnss_velocity_mps, n->gnss_pitch_rad,
                              n->gnss_roll_rad};
    const double constant[] = {n->constant_height, n->constant_velocity, n->constant_pitch,
                               n->constant_roll};
    for (int i = 0; i < FR_K_KINDS; i++) {
        r->reading[i] = reading[i] * reading[i];
        r->constant[i] = constant[i] * constant[i];
    }
    r->usual_pitch = r->constant[FR_K_PITCH] / USUAL_S;
    r->usual_roll = r->constant[FR_K_ROLL] / USUAL_S;
    r->walk = n->gnss_height_walk * n->gnss_height_walk;
    r->reflection = n->reflection * n->reflection / ((double)model->sub_block * model->step);
    r->step = model->step;
    r->arm_up = model->arm[2];
    r->reflection_speed = config->reflection_speed_mps;
    r->sub_block = model->sub_block;
    r->patience = (int64_t)rint(GNSS_PATIENCE_S / model->step);
    r->second = (int64_t)rint(1.0 / model->step);
    r->before = -1;
    r->gnss = config->gnss;
    r->attitude = config->attitude;
    r->reflects = config->reflects;
}

static void observe_nothing(fr_kalman_observation *out)
{
    for (int i = 0; i < FR_K_KINDS; i++) {
        out->y[i] = (double)NAN;
        out->variance[i] = (double)NAN;
    }
    out->drifted = 0.0;
    out->mark = 0;
    out->reserved = 0;
}

/* The errors of a reading that comes soon behind another count for more. */
static double crowding(const fr_kalman_references *r, int64_t at)
{
    double interval_s = r->before < 0 ? LONGEST_S : (double)(at - r->before) * r->step;
    interval_s = interval_s < LONGEST_S ? interval_s : LONGEST_S;
    return interval_s < READING_S ? USUAL_S / interval_s : 1.0;
}

/* Variance that the datum of the GNSS height gains since the reading before: it may have moved
 * slowly, and anywhere in an outage. */
static double moved(const fr_kalman_references *r, int64_t at)
{
    if (r->holds != 0 || at - r->latest > r->patience)
        return DATUM_VARIANCE;
    return r->walk * (double)(at - r->observed) * r->step;
}

static void observe_reading(const fr_kalman_references *r, const fr_kalman_reading *reading,
                            fr_kalman_observation *out)
{
    double crowded = crowding(r, reading->at);
    for (int i = 0; i < FR_K_KINDS; i++) {
        double own = reading->variance[i];
        out->y[i] = reading->y[i];
        out->variance[i] = (own == own ? own : r->reading[i]) * crowded;
    }
    if (r->attitude == 0) {
        out->y[FR_K_PITCH] = 0.0;
        out->y[FR_K_ROLL] = 0.0;
        out->variance[FR_K_PITCH] = r->usual_pitch * crowded;
        out->variance[FR_K_ROLL] = r->usual_roll * crowded;
    }
    out->y[FR_K_HEIGHT] -= r->datum;
    out->drifted = moved(r, reading->at);
}

/* Take a reading, its height only if `heights`; the first one sets the datum. */
static void take_reading(fr_kalman_references *r, const fr_kalman_reading *reading, int heights,
                         fr_kalman_observation *out)
{
    if (r->has_datum == 0)
        r->datum = reading->y[FR_K_HEIGHT] - r->arm_up - r->start;
    r->has_datum = 1;
    observe_reading(r, reading, out);
    r->before = reading->at;
    r->latest = reading->at;
    if (heights != 0) {
        r->observed = reading->at;
        r->holds = 0;
    }
}

/* What replaces GNSS, once for each sub-block, (6.65). */
static void take_constants(fr_kalman_references *r, int64_t at, fr_kalman_observation *out)
{
    double weight = at == 0 ? 0.5 * (double)(r->sub_block + 1) : (double)r->sub_block;
    for (int i = 0; i < FR_K_KINDS; i++) {
        out->y[i] = 0.0;
        out->variance[i] = r->constant[i] / (weight * r->step);
    }
    out->mark = FR_K_RELATIVE | FR_K_TRUSTED | (r->holds != 0 ? 0 : FR_K_CAPTURE);
    r->holds = 1;
}

/* The height sensor as a measure of the reference point's motion at a stop, (6.58)-(6.60). */
static void take_reflection(fr_kalman_references *r, double height, fr_kalman_observation *out)
{
    if (r->stands == 0)
        r->origin = height;
    out->mark |= FR_K_TRUSTED | FR_K_REFLECTED | (r->stands != 0 ? 0 : FR_K_RENEW);
    r->stands = 1;
    out->y[FR_K_HEIGHT] = height - r->origin;
    out->variance[FR_K_HEIGHT] = r->reflection;
}

/* Whether the vehicle has been travelling at a constant speed for four seconds; looked for at every
 * fourth second of the run. */
static int is_quiet(fr_kalman_references *r, int64_t at, double distance_m)
{
    double slowest, fastest;
    if (at % r->second != 0)
        return 0;
    for (int i = 0; i < FR_K_SECONDS; i++)
        r->travelled[i] = r->travelled[i + 1];
    r->travelled[FR_K_SECONDS] = distance_m;
    r->seconds += r->seconds <= FR_K_SECONDS ? 1 : 0;
    slowest = r->travelled[1] - r->travelled[0];
    fastest = slowest;
    for (int i = 1; i < FR_K_SECONDS; i++) {
        double speed = r->travelled[i + 1] - r->travelled[i];
        slowest = speed < slowest ? speed : slowest;
        fastest = speed > fastest ? speed : fastest;
    }
    return at % (FR_K_SECONDS * r->second) == 0 && r->seconds > FR_K_SECONDS &&
           slowest > MOVING_MPS && fastest - slowest < STEADY_MPS;
}

/* GNSS, or what replaces it; 1 if anything. */
static int take_absolute(fr_kalman_references *r, int64_t at, const fr_kalman_reading *reading,
                         int heights, fr_kalman_observation *out)
{
    int ends = at % r->sub_block == 0;
    if (r->gnss != 0 && reading != NULL) {
        take_reading(r, reading, heights, out);
        return 1;
    }
    if (ends == 0 || (r->gnss != 0 && at - r->latest < r->patience))
        return 0;
    take_constants(r, at, out);
    return 1;
}

/* At a stop the height sensor's readings take the place of heights, the rest is as ever. */
static int take_standing(fr_kalman_references *r, int64_t at, double height,
                         fr_kalman_observation *out)
{
    out->y[FR_K_HEIGHT] = (double)NAN;
    out->drifted = 0.0;
    if (at % r->sub_block != 0 || height != height)
        return 0;
    take_reflection(r, height, out);
    return 1;
}

int fr_kalman_schedule(fr_kalman_references *r, int64_t at, double height, double speed,
                       double distance_m, const fr_kalman_reading *reading,
                       fr_kalman_observation *out)
{
    int standing = r->reflects != 0 && speed < r->reflection_speed, seen;
    int quiet = is_quiet(r, at, distance_m);
    observe_nothing(out);
    r->start = at == 0 && height == height ? height : r->start;
    seen = take_absolute(r, at, reading, !standing, out);
    if (standing != 0)
        seen |= take_standing(r, at, height, out);
    else
        r->stands = 0;
    if (quiet != 0 && standing == 0)
        out->mark |= FR_K_FORGET;
    if (seen != 0 && out->mark != FR_K_FORGET) {
        r->last_at = at;
        r->last_mark = out->mark;
    }
    return seen != 0 || out->mark != 0;
}

int fr_kalman_schedule_end(const fr_kalman_references *r, int64_t at, fr_kalman_observation *out)
{
    double behind = (double)(at - r->last_at);
    double weight = 0.5 * (2.0 * behind + 1.0 - (double)r->sub_block);
    observe_nothing(out);
    if ((r->last_mark & FR_K_RELATIVE) == 0 || at - r->last_at >= r->sub_block || weight == 0.0)
        return 0;
    for (int i = 0; i < FR_K_KINDS; i++) {
        out->y[i] = 0.0;
        out->variance[i] = r->constant[i] / (weight * r->step);
    }
    if ((r->last_mark & FR_K_REFLECTED) != 0)
        out->y[FR_K_HEIGHT] = (double)NAN;
    return 1;
}
