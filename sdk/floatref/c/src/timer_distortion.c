/* SPDX-License-Identifier: Apache-2.0
 *
 * Timer distortion, (5.7) and (5.8): about dt where dt is short, and dt_0 where dt is long.
 */
#include <math.h>

#include "samples.h"

/* Least sharpness of (5.8): at 1 the time step is zero, below 1 it is negative. */
#define BLUNTEST 2.0

fr_timer_distortion_config fr_timer_distortion_defaults(void)
{
    fr_timer_distortion_config config = {0.0, 3.576, 25.0};
    return config;
}

/* (1 + x)^(1/beta) - 1, without a difference of numbers that are nearly one. */
static fr_real root(fr_real x, fr_real sharpness)
{
#ifdef FR_FLOAT
    return expm1f(log1pf(x) / sharpness);
#else
    return expm1(log1p(x) / sharpness);
#endif
}

static fr_real power(fr_real x, fr_real sharpness)
{
#ifdef FR_FLOAT
    return powf(x, sharpness);
#else
    return pow(x, sharpness);
#endif
}

/* No power of a number above one is taken, so nothing overflows however long the stop. */
static fr_real adjust(fr_real time_step, fr_real limit, fr_real sharpness)
{
    fr_real ratio = time_step / limit;
    if (ratio > 1)
        return limit * (1 - ratio * root(power(1 / ratio, sharpness), sharpness));
    return limit * (ratio - root(power(ratio, sharpness), sharpness));
}

fr_status fr_timer_distortion_steps(const fr_timer_distortion_config *config,
                                    const fr_real *time_step, size_t count, fr_real *adjusted,
                                    size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = config == NULL ? FR_NULL_POINTER : FR_OK;
    if (status == FR_OK &&
        !(fr_above_zero(config->interval_m) && fr_above_zero(config->slow_speed_mps) &&
          fr_above_zero(config->interval_m / config->slow_speed_mps) &&
          fr_finite(config->sharpness) && config->sharpness >= BLUNTEST))
        status = FR_BAD_CONFIG;
    if (status == FR_OK)
        status = fr_room(count, adjusted, capacity, written);
    if (status == FR_OK)
        status = fr_check_steps(time_step, count);
    if (status != FR_OK)
        return status;
    fr_real limit = FR_R(config->interval_m / config->slow_speed_mps);
    for (size_t i = 0; i < count; i++)
        adjusted[i] = adjust(time_step[i], limit, FR_R(config->sharpness));
    *written = count;
    return FR_OK;
}
