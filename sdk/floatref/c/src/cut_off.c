/* SPDX-License-Identifier: Apache-2.0
 *
 * The cut-off that follows the travel speed, (5.3).
 *
 * It is v/lambda_c + (f_ls - v/lambda_c) / (1 + exp u), which cannot overflow. The exponential is
 * the Taylor polynomial of u/64, squared six times. It is exact to rounding near u = 0; farther out
 * its error is larger, but there it is negligible against 1, or 1 against it.
 */
#include <string.h>

#include "schedule.h"

/* Exponents are held within this: further out the sum of 1 and the exponential is one of them. */
#define BRIEF FR_R(40.0)
/* Shortest cut-off wavelength over distance, in intervals of the profile. */
#define SHORTEST 4.0

fr_cut_off_config fr_cut_off_defaults(void)
{
    fr_cut_off_config config = {0.45, 105.91, 2.778, 2.5};
    return config;
}

int fr_cut_off_is_possible(const fr_cut_off_config *config)
{
    return fr_above_zero(config->low_speed_hz) && fr_above_zero(config->wavelength_m) &&
           fr_above_zero(config->transition_speed_mps) && fr_above_zero(config->steepness_s_per_m);
}

fr_schedule fr_schedule_of(const fr_cut_off_config *config)
{
    fr_schedule schedule = {FR_R(config->low_speed_hz), FR_R(1.0 / config->wavelength_m),
                            FR_R(config->transition_speed_mps), FR_R(config->steepness_s_per_m)};
    return schedule;
}

fr_real fr_largest_wave_number(double interval_m)
{
    return FR_R(1.0 / (SHORTEST * interval_m));
}

static inline fr_real power_of_e(fr_real u)
{
    fr_real z = u * FR_R(0.015625), z2 = z * z;
    fr_real even = FR_R(1.0 / 40320.0), odd = FR_R(1.0 / 5040.0), power;
    even = even * z2 + FR_R(1.0 / 720.0);
    even = even * z2 + FR_R(1.0 / 24.0);
    even = even * z2 + FR_R(0.5);
    odd = odd * z2 + FR_R(1.0 / 120.0);
    odd = odd * z2 + FR_R(1.0 / 6.0);
    odd = odd * z2 + 1;
    power = 1 + (even * z2 + odd * z);
    power *= power;
    power *= power;
    power *= power;
    power *= power;
    power *= power;
    power *= power;
    return power;
}

/* Frequencies of at most a group. Each limit of the exponents has a loop of its own: in one with
 * the powers, compilers take the limits for branches of the whole. */
static inline void frequencies_here(fr_schedule s, const fr_real *speed, size_t count,
                                    fr_real *frequency)
{
    fr_real u[FR_GROUP], high[FR_GROUP];
    for (size_t i = 0; i < count; i++) {
        fr_real exponent = s.steepness * (speed[i] - s.transition);
        u[i] = exponent > BRIEF ? BRIEF : exponent;
        high[i] = speed[i] * s.per_metre;
    }
    for (size_t i = 0; i < count; i++)
        u[i] = u[i] < -BRIEF ? -BRIEF : u[i];
    for (size_t i = 0; i < count; i++)
        frequency[i] = high[i] + (s.low_speed - high[i]) / (1 + power_of_e(u[i]));
}

void fr_frequencies(const fr_schedule *schedule, const fr_real *speed, size_t count,
                    fr_real *frequency)
{
    size_t done = 0;
    if (count == 0u)
        return;
    for (; count - done >= FR_GROUP; done += FR_GROUP)
        frequencies_here(*schedule, speed + done, FR_GROUP, frequency + done);
    frequencies_here(*schedule, speed + done, count - done, frequency + done);
}

void fr_wave_numbers(const fr_real *speed, fr_real largest, size_t count, fr_real *values)
{
    for (size_t i = 0; i < count; i++) {
        int reached = values[i] >= largest * speed[i];
        fr_real moving = speed[i] > 0 ? speed[i] : 1;
        values[i] = reached ? largest : values[i] / moving;
    }
}

/* (5.3) lies between f_ls and v/lambda_c: if both are far below half the rate for the largest and
 * the smallest speed, no frequency has to be computed. */
static int far_within(const fr_schedule *schedule, const fr_tangent *tangent, const fr_real *speed,
                      size_t count)
{
    fr_real half = FR_R(0.49), scale = schedule->per_metre * tangent->step;
    /* In float the product of two small settings may be too small for a number. */
    return schedule->low_speed * tangent->step < half && scale > 0 &&
           fr_all_within(speed, count, half / scale);
}

fr_status fr_check_speeds(const fr_schedule *schedule, const fr_tangent *tangent,
                          const fr_real *speed, size_t count, int32_t missing)
{
    fr_status status = fr_check_samples(speed, count, missing);
    fr_real frequency[FR_BLOCK];
    if (status != FR_OK || far_within(schedule, tangent, speed, count))
        return status;
    for (size_t done = 0; status == FR_OK && done < count; done += FR_BLOCK) {
        size_t size = count - done < FR_BLOCK ? count - done : FR_BLOCK;
        fr_frequencies(schedule, speed + done, size, frequency);
        status = fr_check_cutoffs(tangent, frequency, size, FR_MISSING_BRIDGED);
    }
    return status;
}

static fr_status check_cut_off(const fr_cut_off_config *config, const fr_real *speed, size_t count,
                               const fr_real *out, size_t capacity, size_t *written)
{
    fr_status status = config == NULL ? FR_NULL_POINTER : FR_OK;
    if (status == FR_OK && !fr_cut_off_is_possible(config))
        status = FR_BAD_CONFIG;
    if (status == FR_OK)
        status = fr_room(count, out, capacity, written);
    return status == FR_OK ? fr_check_samples(speed, count, FR_MISSING_BRIDGED) : status;
}

fr_status fr_cut_off_frequency(const fr_cut_off_config *config, const fr_real *speed, size_t count,
                               fr_real *frequency, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_cut_off(config, speed, count, frequency, capacity, written);
    if (status != FR_OK)
        return status;
    fr_schedule schedule = fr_schedule_of(config);
    fr_frequencies(&schedule, speed, count, frequency);
    *written = count;
    return FR_OK;
}

fr_status fr_cut_off_wave_number(const fr_cut_off_config *config, double interval_m,
                                 const fr_real *speed, size_t count, fr_real *wave_number,
                                 size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_cut_off(config, speed, count, wave_number, capacity, written);
    if (status == FR_OK && !fr_above_zero(interval_m))
        status = FR_BAD_CONFIG;
    if (status != FR_OK)
        return status;
    fr_schedule schedule = fr_schedule_of(config);
    for (size_t done = 0; done < count; done += FR_BLOCK) {
        size_t size = count - done < FR_BLOCK ? count - done : FR_BLOCK;
        fr_real values[FR_BLOCK];
        fr_frequencies(&schedule, speed + done, size, values);
        fr_wave_numbers(speed + done, fr_largest_wave_number(interval_m), size, values);
        (void)memcpy(wave_number + done, values, size * sizeof *values);
    }
    *written = count;
    return FR_OK;
}
