/* SPDX-License-Identifier: Apache-2.0
 *
 * The smoothers of a wheel path, and the filter of one of them.
 */
#include "driven.h"

enum { GNSS_HZ = 20 };

static uint8_t flags[POINTS];

/* As many sections end as there are halves of a lag. */
static length of_lag(double lag_s)
{
    length run = {1.5 * lag_s, 1.5 * lag_s};
    return run;
}

static fr_status push_road_prior(void *object, size_t count, size_t *written)
{
    return fr_road_prior_push((fr_road_prior *)object, on_road.force, on_road.height,
                              on_road.counts, count, out, beside, flags, POINTS, written);
}

static fr_status end_road_prior(void *object, size_t *written)
{
    return fr_road_prior_finish((fr_road_prior *)object, out, beside, flags, POINTS, written);
}

static void try_road_prior(double lag_s, double node_rate_hz)
{
    fr_road_prior_config config = fr_road_prior_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    config.interval_m = 0.1;
    config.gravity_mps2 = GRAVITY_MPS2;
    config.node_rate_hz = node_rate_hz;
    config.lag_s = lag_s;
    config.fastest_mps = 30.0;
    begin_drive(2000);
    DRIVE(road_prior, config, of_lag(lag_s), put_bits, out);
}

void stage_road_prior_lag_2_s(void)
{
    try_road_prior(2.0, 100.0);
}

void stage_road_prior_lag_4_s(void)
{
    try_road_prior(4.0, 100.0);
}

void stage_road_prior_lag_2_s_500_nodes(void)
{
    try_road_prior(2.0, 500.0);
}

/* A reading for the next sample but ones of earlier pieces, 20 in a second. */
#define PUSH_GNSS(kind)                                                                    \
    static fr_status push_gnss_##kind(fr_##kind *object, size_t count)                     \
    {                                                                                      \
        double reading[4] = {0.0, 0.0, 0.0, 0.0};                                          \
        reading[0] = on_road.body;                                                         \
        return on_road.sample / (int64_t)count % (100 / GNSS_HZ) != 0                      \
                   ? FR_OK                                                                 \
                   : fr_##kind##_push_gnss(object, on_road.sample - 1, reading, NULL);     \
    }

PUSH_GNSS(kalman_filter)
PUSH_GNSS(kalman)

static fr_imu unit_of(const drive *d)
{
    fr_imu imu = {d->along, d->rate_of, d->up, d->rate_of, d->rate_of, d->rate_of};
    return imu;
}

static fr_status push_kalman_filter(void *object, size_t count, size_t *written)
{
    fr_kalman_filter *filter = (fr_kalman_filter *)object;
    fr_imu imu = unit_of(&on_road);
    fr_status status = push_gnss_kalman_filter(filter, count);
    return status != FR_OK ? status
                           : fr_kalman_filter_push(filter, &imu, on_road.clearance, on_road.counts,
                                                   count, heights, POINTS, written);
}

static fr_status end_kalman_filter(void *object, size_t *written)
{
    return fr_kalman_filter_finish((fr_kalman_filter *)object, heights, POINTS, written);
}

static void set_filter(fr_kalman_filter_config *config)
{
    config->travel.rate_hz = RATE_HZ;
    config->travel.metres_per_count = COUNT_M;
}

void stage_kalman_filter(void)
{
    const length half_a_second = {0.3, 0.5};
    fr_kalman_filter_config config = fr_kalman_filter_defaults();
    set_filter(&config);
    begin_drive(2000);
    DRIVE(kalman_filter, config, half_a_second, put_doubles, heights);
}

static fr_status push_kalman(void *object, size_t count, size_t *written)
{
    fr_kalman *kalman = (fr_kalman *)object;
    fr_imu imu = unit_of(&on_road);
    fr_status status = push_gnss_kalman(kalman, count);
    return status != FR_OK ? status
                           : fr_kalman_push(kalman, &imu, on_road.clearance, on_road.counts, count,
                                            out, beside, flags, POINTS, written);
}

static fr_status end_kalman(void *object, size_t *written)
{
    return fr_kalman_finish((fr_kalman *)object, out, beside, flags, POINTS, written);
}

static void try_kalman(double lag_s)
{
    fr_kalman_config config = fr_kalman_defaults();
    set_filter(&config.filter);
    config.interval_m = 0.1;
    config.lag_s = lag_s;
    config.fastest_mps = 30.0;
    begin_drive(2000);
    DRIVE(kalman, config, of_lag(lag_s), put_bits, out);
}

void stage_kalman_lag_1_s(void)
{
    try_kalman(1.0);
}

void stage_kalman_lag_2_s(void)
{
    try_kalman(2.0);
}
