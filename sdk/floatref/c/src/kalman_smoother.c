/* SPDX-License-Identifier: Apache-2.0
 *
 * The Kalman smoother of chapter 6 with a fixed lag: settings, memory, and calls.
 */
#include <math.h>

#include "kalman_smoother.h"

#define KALMAN_MAGIC FR_MAGIC(21)
#define SHORTEST_LAG_S 1.0
#define LONGEST_LAG_S 3600.0
#define FASTEST_MPS 200.0
#define MOST_GNSS_HZ 1000.0
/* Without a point for so long the vehicle is stationary. */
#define STATIONARY_S 1.0
/* The SDK's segments, but for the power of two in samples. */
#define KALMAN_SEGMENT_S 4.0
/* Standstills of a section that take no further room: one in so many seconds. */
#define STOP_S 5.0

fr_kalman_config fr_kalman_defaults(void)
{
    fr_kalman_config config = {fr_kalman_filter_defaults(), 0.0, 60.0, 40.0, 20.0, 105.91, 1e-4};
    return config;
}

fr_kalman_config fr_kalman_inertial_defaults(void)
{
    fr_kalman_config config = fr_kalman_defaults();
    config.filter = fr_kalman_filter_inertial_defaults();
    config.lag_s = 180.0;
    return config;
}

static int lies_within(double value, double least, double most)
{
    return value >= least && value <= most;
}

static int smoother_is_possible(const fr_kalman_config *config)
{
    return fr_kalman_engine_room(&config->filter) > 0u &&
           fr_points_are_possible(config->interval_m, config->filter.travel.metres_per_count) &&
           lies_within(config->lag_s, SHORTEST_LAG_S, LONGEST_LAG_S) &&
           lies_within(config->fastest_mps, 0.1, FASTEST_MPS) &&
           lies_within(config->gnss_hz, 0.0, MOST_GNSS_HZ) &&
           lies_within(config->wavelength_m, config->interval_m, FR_K_LARGEST) &&
           lies_within(config->tolerance_m, 0.0, FR_K_LARGEST);
}

static fr_lag_pace kalman_pace(const fr_kalman_config *config)
{
    double nodes_hz = fr_kalman_nodes_hz(&config->filter), section_s = 0.5 * config->lag_s;
    double most_hz = nodes_hz + (config->filter.gnss != 0 ? config->gnss_hz : 0.0) + 1.0;
    fr_lag_pace pace;
    pace.nodes = fr_whole_at_least(section_s * most_hz, 8);
    pace.updates = FR_K_KINDS * pace.nodes + FR_LAG_UPDATES;
    pace.points = fr_whole_at_least(section_s * config->fastest_mps / config->interval_m, 1);
    pace.stops = fr_whole_at_least(section_s / STOP_S, 1);
    pace.patience = fr_whole_at_least(STATIONARY_S * nodes_hz, 1);
    pace.delay = 0;
    return pace;
}

static fr_lag_shape kalman_shape(const fr_kalman_config *config)
{
    fr_lag_shape shape;
    shape.pace = kalman_pace(config);
    shape.node_s = 1.0 / fr_kalman_nodes_hz(&config->filter);
    shape.interval_m = config->interval_m;
    shape.wavelength_m = config->wavelength_m;
    shape.noise_m = config->filter.noise.height_m;
    shape.tolerance_m = config->tolerance_m;
    return shape;
}

size_t fr_kalman_size(const fr_kalman_config *config)
{
    fr_lag_model model = fr_kalman_lag_model();
    fr_lag_shape shape;
    uint64_t numbers;
    if (config == NULL || !smoother_is_possible(config))
        return 0u;
    shape = kalman_shape(config);
    numbers = fr_lag_numbers(&model, &shape);
    if (numbers == 0u)
        return 0u;
    size_t engine = fr_sized(FR_PADDED(fr_kalman), fr_kalman_engine_room(&config->filter), 1u);
    return engine == 0u ? 0u : fr_sized(engine, numbers, sizeof(double));
}

static int64_t segment_of(const fr_kalman_config *config)
{
    double samples = KALMAN_SEGMENT_S * config->filter.travel.rate_hz;
    return (int64_t)ldexp(1.0, fr_whole_at_least(rint(log2(samples)), 0));
}

static void look_at(fr_kalman *kalman, fr_kalman_view *view)
{
    size_t room = fr_kalman_engine_bytes(&kalman->engine);
    view->kalman = kalman;
    view->room = FR_BEHIND(kalman, fr_kalman);
    view->model = fr_kalman_lag_model();
    view->lag.model = &view->model;
    view->lag.lag = &kalman->lag;
    view->lag.room = (double *)(void *)((unsigned char *)view->room + room);
}

fr_status fr_kalman_init(void *memory, size_t size, const fr_kalman_config *config,
                         fr_kalman **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_kalman_size(config),
                                KALMAN_MAGIC);
    fr_kalman_view view;
    fr_lag_shape shape;
    if (status != FR_OK)
        return status;
    *out = (fr_kalman *)memory;
    shape = kalman_shape(config);
    fr_kalman_engine_set(&(*out)->engine, &config->filter);
    fr_points_set(&(*out)->points, config->interval_m, config->filter.travel.metres_per_count);
    (*out)->progress.segment = segment_of(config);
    look_at(*out, &view);
    fr_lag_begin(&view.lag, &shape);
    return FR_OK;
}

fr_status fr_kalman_push_gnss(fr_kalman *kalman, int64_t sample, const double values[4],
                              const double variances[4])
{
    fr_status status = fr_ready(kalman, KALMAN_MAGIC);
    if (status != FR_OK)
        return status;
    return fr_kalman_engine_read(&kalman->engine, FR_BEHIND(kalman, fr_kalman), sample, values,
                                 variances);
}

/* Whether `needed` points fit. */
static fr_status points_fit(size_t needed, const fr_lag_output *output, size_t capacity,
                            size_t *written)
{
    fr_status status = fr_room(needed, output->elevation, capacity, written);
    if (status == FR_OK && needed > 0u && (output->sigma == NULL || output->flags == NULL))
        status = FR_NULL_POINTER;
    return status;
}

static fr_status foresee(const fr_kalman_view *view, const fr_kalman_push_of *push,
                         size_t *given_out)
{
    const fr_kalman *kalman = view->kalman;
    size_t ready = fr_kalman_engine_ready(&kalman->engine, push->count);
    void *room = view->room;
    return fr_kalman_foresee(&kalman->engine, room, &kalman->points, &kalman->clock,
                             &kalman->lag.shape.pace, push, ready, given_out);
}

static fr_status check_push(fr_kalman *kalman, const fr_imu *imu, const fr_kalman_push_of *push,
                            fr_kalman_view *view, size_t *needed)
{
    fr_status status = fr_kalman_engine_check(&kalman->engine, imu, push->height, push->counts,
                                              push->count);
    if (status != FR_OK)
        return status;
    look_at(kalman, view);
    return foresee(view, push, needed);
}

static void run_push(const fr_kalman_view *view, const fr_imu *imu, const fr_kalman_push_of *push,
                     fr_lag_output *output)
{
    fr_kalman_engine *engine = &view->kalman->engine;
    void *room = view->room;
    fr_kalman_step step;
    fr_kalman_node node;
    for (size_t i = 0; i < push->count; i++) {
        fr_kalman_sample sample = fr_kalman_sample_of(engine, imu, push->height, i);
        if (fr_kalman_engine_take(engine, room, &sample, push->counts[i], &step, &node) != 0)
            fr_kalman_hand_over(view, &step, &node, output);
    }
}

fr_status fr_kalman_push(fr_kalman *kalman, const fr_imu *imu, const double *height,
                         const int64_t *counts, size_t count, fr_real *elevation, fr_real *sigma,
                         uint8_t *flags, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_lag_output output = {elevation, sigma, flags, 0u};
    fr_kalman_push_of push = {height, counts, count};
    fr_status status = fr_ready(kalman, KALMAN_MAGIC);
    fr_kalman_view view;
    size_t needed = 0;
    if (status == FR_OK)
        status = fr_room(0u, elevation, capacity, written);
    if (status == FR_OK)
        status = check_push(kalman, imu, &push, &view, &needed);
    if (status == FR_OK)
        status = points_fit(needed, &output, capacity, written);
    if (status != FR_OK)
        return status;
    run_push(&view, imu, &push, &output);
    *written = output.made;
    return FR_OK;
}

fr_status fr_kalman_finish(fr_kalman *kalman, fr_real *elevation, fr_real *sigma, uint8_t *flags,
                           size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_lag_output output = {elevation, sigma, flags, 0u};
    fr_status status = fr_ready(kalman, KALMAN_MAGIC);
    fr_kalman_view view;
    fr_kalman_step step;
    fr_kalman_node node;
    if (status != FR_OK)
        return status;
    look_at(kalman, &view);
    status = points_fit(fr_kalman_foresee_end(&kalman->engine, view.room, &kalman->points,
                                              &kalman->clock),
                        &output, capacity, written);
    if (status != FR_OK)
        return status;
    while (fr_kalman_engine_drain(&kalman->engine, view.room, &step, &node) != 0)
        fr_kalman_hand_over(&view, &step, &node, &output);
    fr_kalman_hand_over_end(&view, &output);
    kalman->head.state = FR_STATE_ENDED;
    *written = output.made;
    return FR_OK;
}

fr_status fr_kalman_left_out(const fr_kalman *kalman, int64_t count[4])
{
    fr_status status = fr_readable(kalman, KALMAN_MAGIC);
    return status == FR_OK ? fr_kalman_engine_left_out(&kalman->engine, count) : status;
}
