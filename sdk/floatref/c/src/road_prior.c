/* SPDX-License-Identifier: Apache-2.0
 *
 * The road-prior smoother: its configuration, and its calls.
 */
#include <math.h>
#include <string.h>

#include "road_prior.h"
#include "samples.h"

#define LEAST_RATE_HZ 10.0
#define MOST_NODES_HZ 1000.0
/* One second difference over the longer distance; over less there is no mean. */
#define LEAST_MEMORY_M 32.0
#define MOST_LAG_S 3600.0
#define MOST_POINTS_OF_LAG 4e8
/* Marks are so many metres apart, and their number has to fit into 32 bits. */
#define MOST_INTERVAL_M 1e6
#define MOST_LAG_M 1e9
/* The SDK's segments, but for the power of two in samples. */
#define SEGMENT_S 4.0
/* A vehicle that brings no point for so long is stationary; so many stops of a section compose. */
#define PATIENCE_S 0.25
#define STOPS 8
#define LARGEST_VALUE 1e6

fr_road_prior_config fr_road_prior_defaults(void)
{
    fr_road_prior_config config;
    (void)memset(&config, 0, sizeof config);
    config.node_rate_hz = 500.0;
    config.lag_s = 60.0;
    config.fastest_mps = 40.0;
    config.tolerance_m = 1e-4;
    config.wavelength_m = 105.91;
    config.acceleration = 1.5e-4;
    config.acceleration_bias = 0.03;
    config.acceleration_walk = 1e-4;
    config.walk_along = 1.6e-3;
    config.missing_acceleration = 0.3;
    config.reading_m = 1e-4;
    config.road_m = 4e-6;
    config.long_waves_per_m = 2e-7;
    config.road_reach_m = 150.0;
    config.road_memory_m = 300.0;
    config.edge_sigmas = 6.0;
    config.lean_sigma_rad = 0.03;
    config.tilt_sigma = 0.01;
    config.pitch_hz = 1.6;
    config.pitch_damping = 0.3;
    config.height_m = 4e-5;
    config.most_sigma_share = 0.3;
    return config;
}

static int not_below_zero(double x)
{
    return x >= 0.0 && fr_finite(x);
}

/* Whether all of the model can be: its squares too, so that nothing overflows. */
static int model_is_possible(const fr_road_prior_config *c)
{
    const double above[] = {c->reading_m, c->road_m, c->long_waves_per_m, c->road_reach_m,
                            c->pitch_hz, c->lean_sigma_rad, c->tilt_sigma, c->acceleration_bias};
    const double others[] = {c->acceleration, c->acceleration_walk, c->walk_along,
                             c->missing_acceleration, c->edge_sigmas, c->height_m,
                             c->most_sigma_share, fabs(c->lean_expected_rad),
                             fabs(c->tilt_expected)};
    int possible = c->road_memory_m >= LEAST_MEMORY_M && c->road_memory_m <= 1e18 &&
                   c->pitch_damping >= 0.0 && c->pitch_damping < 1.0;
    for (size_t i = 0; i < sizeof above / sizeof above[0]; i++)
        possible = possible && above[i] >= 1e-15 && above[i] <= LARGEST_VALUE;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        possible = possible && others[i] >= 0.0 && others[i] <= 1e9;
    return possible;
}

static int stream_is_possible(const fr_road_prior_config *c)
{
    return c->rate_hz >= LEAST_RATE_HZ && c->rate_hz <= 1e7 && fr_finite(c->gravity_mps2) &&
           fabs(c->gravity_mps2) <= LARGEST_VALUE &&
           fr_points_are_possible(c->interval_m, c->metres_per_count) &&
           c->node_rate_hz >= LEAST_RATE_HZ && c->node_rate_hz <= MOST_NODES_HZ &&
           fr_above_zero(c->lag_s) && c->lag_s <= MOST_LAG_S && fr_above_zero(c->fastest_mps) &&
           c->interval_m <= MOST_INTERVAL_M && c->lag_s * c->fastest_mps <= MOST_LAG_M &&
           c->lag_s * c->fastest_mps / c->interval_m <= MOST_POINTS_OF_LAG &&
           not_below_zero(c->tolerance_m) && c->wavelength_m >= 1e-3 &&
           c->wavelength_m <= LARGEST_VALUE &&
           fr_one_of(c->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) &&
           fr_one_of(c->back, FR_BACK_REFUSED, FR_BACK_TAKEN);
}

static int32_t sub_block_of(const fr_road_prior_config *config)
{
    return fr_whole_at_least(rint(config->rate_hz / config->node_rate_hz), 1);
}

static fr_lag_shape shape_of(const fr_road_prior_config *config)
{
    double nodes_hz = config->rate_hz / sub_block_of(config);
    fr_lag_shape shape;
    (void)memset(&shape, 0, sizeof shape);
    shape.interval_m = config->interval_m;
    shape.wavelength_m = config->wavelength_m;
    shape.noise_m = config->height_m;
    shape.tolerance_m = config->tolerance_m;
    shape.pace.delay = fr_excitation_reach(1.0 / nodes_hz);
    shape.pace.nodes = fr_whole_at_least(0.5 * config->lag_s * nodes_hz, shape.pace.delay + 8);
    shape.pace.updates = shape.pace.nodes + FR_LAG_UPDATES;
    shape.pace.points =
        fr_whole_at_least(0.5 * config->lag_s * config->fastest_mps / config->interval_m, 16);
    shape.pace.stops = STOPS < shape.pace.nodes ? STOPS : shape.pace.nodes;
    shape.pace.patience = fr_whole_at_least(PATIENCE_S * nodes_hz, 4);
    shape.node_s = 1.0 / nodes_hz;
    return shape;
}

size_t fr_road_prior_size(const fr_road_prior_config *config)
{
    if (config == NULL || !stream_is_possible(config) || !model_is_possible(config))
        return 0u;
    fr_lag_shape shape = shape_of(config);
    uint64_t numbers = fr_lag_numbers(&fr_road_lag_model, &shape);
    numbers += fr_excitation_numbers(shape.pace.delay);
    numbers += ((uint64_t)shape.pace.delay + 1u) * FR_WAITING_NUMBERS;
    return fr_sized(FR_PADDED(fr_road_prior), numbers, sizeof(double));
}

static fr_road_model model_of(const fr_road_prior_config *c)
{
    fr_road_model model;
    (void)memset(&model, 0, sizeof model);
    model.white = c->acceleration * c->acceleration;
    model.walk = c->acceleration_walk * c->acceleration_walk;
    model.walk_along = c->walk_along * c->walk_along;
    model.gap = c->missing_acceleration * c->missing_acceleration;
    model.reading = c->reading_m * c->reading_m;
    model.road = c->road_m;
    model.slope = c->long_waves_per_m;
    model.reach = c->road_reach_m;
    model.lean = c->lean_expected_rad;
    model.tilt = c->tilt_expected;
    model.lean_prior = c->lean_sigma_rad * c->lean_sigma_rad;
    model.tilt_prior = c->tilt_sigma * c->tilt_sigma;
    model.edge = c->edge_sigmas * c->edge_sigmas;
    return model;
}

/* The covariance before the first reading; height and road are those of a flat road. */
static void begin_states(const fr_road_prior_config *c, fr_road_filter *filter)
{
    double reach = c->road_reach_m, half = reach / 2.0;
    double road_m2 = c->road_m * half + c->long_waves_per_m * (reach * reach * reach) / 4.0;
    double(*p)[FR_ROAD_STATES] = filter->p;
    p[ROAD_R][ROAD_R] = 1.0;
    p[ROAD_V][ROAD_V] = 1.0;
    p[ROAD_BIAS][ROAD_BIAS] = c->acceleration_bias * c->acceleration_bias;
    p[ROAD_D][ROAD_D] = 1.0 + road_m2;
    p[ROAD_D][ROAD_R] = 1.0;
    p[ROAD_R][ROAD_D] = 1.0;
    p[ROAD_SLOPE][ROAD_SLOPE] = c->long_waves_per_m * half;
    p[ROAD_D][ROAD_SLOPE] = -c->long_waves_per_m * (half * half);
    p[ROAD_SLOPE][ROAD_D] = p[ROAD_D][ROAD_SLOPE];
    p[ROAD_LEAN][ROAD_LEAN] = c->lean_sigma_rad * c->lean_sigma_rad;
    p[ROAD_TILT][ROAD_TILT] = c->tilt_sigma * c->tilt_sigma;
    filter->x[ROAD_LEAN] = c->lean_expected_rad;
    filter->x[ROAD_TILT] = c->tilt_expected;
}

static void begin_road(fr_road_prior *road, const fr_road_prior_config *config)
{
    fr_lag_shape shape = shape_of(config);
    double interval_s;
    road->step = 1.0 / config->rate_hz;
    road->sub_block = sub_block_of(config);
    interval_s = road->step * road->sub_block;
    road->segment = (int64_t)ldexp(1.0, fr_whole_at_least(rint(log2(SEGMENT_S * config->rate_hz)), 0));
    road->per_second = fr_whole_at_least(rint(1.0 / interval_s), 1);
    road->model = model_of(config);
    road->reading = road->model.reading;
    begin_states(config, &road->filter);
    fr_excitation_begin(&road->excitation, fr_road_room(road), interval_s, config->pitch_hz,
                        config->pitch_damping);
    fr_spectrum_begin(&road->spectrum, config->road_m, config->long_waves_per_m, config->reading_m,
                      config->road_memory_m, interval_s);
    road->largest = road->most_share * fr_spectrum_bend_m(&road->spectrum);
    fr_lag_view view = fr_road_view(road);
    fr_lag_begin(&view, &shape);
}

fr_status fr_road_prior_init(void *memory, size_t size, const fr_road_prior_config *config,
                             fr_road_prior **out)
{
    fr_road_prior *road = (fr_road_prior *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_road_prior_size(config), FR_ROAD_MAGIC);
    if (status != FR_OK)
        return status;
    road->missing = config->missing;
    road->back = config->back;
    road->gravity = config->gravity_mps2;
    road->metres_per_count = config->metres_per_count;
    road->most_share = config->most_sigma_share;
    fr_points_set(&road->progress.points, config->interval_m, config->metres_per_count);
    begin_road(road, config);
    *out = road;
    return FR_OK;
}
