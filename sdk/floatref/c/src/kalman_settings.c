/* SPDX-License-Identifier: Apache-2.0
 *
 * Settings of the Kalman filter: defaults, what is possible, and the model that they make.
 */
#include <math.h>
#include <string.h>

#include "kalman_engine.h"

#define NODES_PER_S 100.0
/* The inputs of the filter are means over a step: below this rate they are no motion. */
#define SLOWEST_HZ 2.0
#define LATEST_S 60.0
#define MOST_READINGS 100000
/* Speeds below which a vehicle is stationary, at most, in m/s. */
#define FASTEST_STOP_MPS 10.0

static int are_densities(const double *values, size_t count)
{
    int possible = 1;
    for (size_t i = 0; i < count; i++)
        possible &= values[i] >= 0.0 && values[i] <= FR_K_LARGEST;
    return possible;
}

/* Process noise may be zero, that of a reading not: the covariance could have no inverse. */
static int noise_is_possible(const fr_kalman_noise *n)
{
    const double process[] = {n->acceleration,   n->acceleration_walk,    n->roll_rate,
                              n->pitch_rate,     n->yaw_rate,             n->roll_rate_walk,
                              n->pitch_rate_walk, n->missing_acceleration, n->lean_rad,
                              n->gnss_height_walk, n->height_m};
    const double readings[] = {n->gnss_height_m,   n->gnss_velocity_mps, n->gnss_pitch_rad,
                               n->gnss_roll_rad,   n->constant_height,   n->constant_velocity,
                               n->constant_pitch,  n->constant_roll,     n->reflection};
    int possible = are_densities(process, sizeof process / sizeof *process) &&
                   are_densities(readings, sizeof readings / sizeof *readings);
    for (size_t i = 0; i < sizeof readings / sizeof *readings; i++)
        possible &= readings[i] >= FR_K_SMALLEST;
    return possible;
}

static int arm_is_possible(const double *arm)
{
    int possible = 1;
    for (int i = 0; i < 3; i++)
        possible &= fabs(arm[i]) <= FR_K_LARGEST;
    return possible;
}

int fr_kalman_is_possible(const fr_kalman_filter_config *config)
{
    return fr_travel_window(&config->travel) > 0u && config->travel.rate_hz >= SLOWEST_HZ &&
           noise_is_possible(&config->noise) && arm_is_possible(config->antenna_m) &&
           fabs(config->gravity_mps2) <= FR_K_LARGEST && config->reflection_speed_mps >= 0.0 &&
           config->reflection_speed_mps <= FASTEST_STOP_MPS && config->late_s >= 0.0 &&
           config->late_s <= LATEST_S && fr_one_of(config->gnss, 0, 1) &&
           fr_one_of(config->attitude, 0, 1) && fr_one_of(config->reflects, 0, 1) &&
           fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) &&
           fr_one_of(config->readings, 1, MOST_READINGS) && config->reserved == 0;
}

uint32_t fr_kalman_delay(const fr_kalman_filter_config *config)
{
    return (uint32_t)rint(config->late_s * config->travel.rate_hz);
}

fr_kalman_filter_config fr_kalman_filter_defaults(void)
{
    static const fr_kalman_noise usual = {4.65e-5, 1e-4,    1.34e-5, 1.34e-5, 1.34e-5,
                                          9.27e-6, 4.86e-4, 0.3,     0.01,    0.012,
                                          0.03,    2.09e-3, 3.49e-3, 1.5e-3,  0.04,
                                          0.08,    0.0195,  0.0078,  2.64e-5, 4e-5};
    fr_kalman_filter_config config;
    (void)memset(&config, 0, sizeof config);
    config.travel = fr_travel_speed_defaults();
    config.noise = usual;
    config.gravity_mps2 = 9.80665;
    config.reflection_speed_mps = 0.16 / 3.6;
    config.gnss = 1;
    config.attitude = 1;
    config.reflects = 1;
    config.readings = 64;
    return config;
}

fr_kalman_filter_config fr_kalman_filter_inertial_defaults(void)
{
    fr_kalman_filter_config config = fr_kalman_filter_defaults();
    config.gnss = 0;
    config.attitude = 0;
    config.noise.acceleration_walk = 3e-4;
    config.noise.pitch_rate_walk = config.noise.roll_rate_walk;
    config.noise.constant_pitch = 0.1;
    config.noise.constant_roll = 0.04;
    return config;
}

static int64_t samples_of_sub_block(double step)
{
    int64_t samples = (int64_t)rint(1.0 / (NODES_PER_S * step));
    return samples > 0 ? samples : 1;
}

double fr_kalman_nodes_hz(const fr_kalman_filter_config *config)
{
    double rate_hz = config->travel.rate_hz;
    return rate_hz / (double)samples_of_sub_block(1.0 / rate_hz);
}

void fr_kalman_model_set(fr_kalman_model *model, const fr_kalman_filter_config *config)
{
    const fr_kalman_noise *n = &config->noise;
    model->step = 1.0 / config->travel.rate_hz;
    model->sub_block = samples_of_sub_block(model->step);
    model->gravity = config->gravity_mps2;
    (void)memcpy(model->arm, config->antenna_m, sizeof model->arm);
    model->white = n->acceleration * n->acceleration;
    model->white_roll = n->roll_rate * n->roll_rate;
    model->white_pitch = n->pitch_rate * n->pitch_rate;
    model->white_yaw = n->yaw_rate * n->yaw_rate;
    model->walk = n->acceleration_walk * n->acceleration_walk;
    model->walk_roll = n->roll_rate_walk * n->roll_rate_walk;
    model->walk_pitch = n->pitch_rate_walk * n->pitch_rate_walk;
    model->lost_white = n->missing_acceleration * n->missing_acceleration;
    model->lean = n->lean_rad * n->lean_rad;
}
