/* SPDX-License-Identifier: Apache-2.0
 *
 * Integration by the trapezoidal rule, (5.5) and (5.6), and with the height reflected, (5.9).
 */
#include "integral.h"

#define INTEGRAL_MAGIC FR_MAGIC(3)

struct fr_integral {
    fr_head head;
    int32_t missing;
    fr_trapezoid sum;
    fr_real half_step, height;
};

fr_integral_config fr_integral_defaults(void)
{
    fr_integral_config config = {0.0, 0.0, FR_MISSING_REFUSED};
    return config;
}

/* Over points no constant step is needed; it is then 0, and the call in time is refused. */
size_t fr_integral_size(const fr_integral_config *config)
{
    int possible = config != NULL && fr_finite(config->step_s) && config->step_s >= 0.0 &&
                   fr_finite(config->start) &&
                   fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED);
    return possible ? sizeof(fr_integral) : 0u;
}

fr_status fr_integral_init(void *memory, size_t size, const fr_integral_config *config,
                           fr_integral **out)
{
    fr_integral *integral = (fr_integral *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_integral_size(config),
                                INTEGRAL_MAGIC);
    if (status != FR_OK)
        return status;
    integral->missing = config->missing;
    integral->half_step = FR_R(config->step_s / 2.0);
    integral->sum.total = FR_R(config->start);
    *out = integral;
    return FR_OK;
}

static fr_status check_integral(const fr_integral *integral, const fr_real *x, size_t count,
                                const fr_real *y, size_t capacity, size_t *written)
{
    fr_status status = fr_ready(integral, INTEGRAL_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, y, capacity, written);
    return status == FR_OK ? fr_check_samples(x, count, integral->missing) : status;
}

/* Samples from the second one on. */
static void run_constant(fr_trapezoid *sum, fr_real half_step, const fr_real *x, size_t count,
                         fr_real *y)
{
    fr_trapezoid s = *sum;
    for (size_t i = 1; i < count; i++)
        y[i] = fr_trapezoid_next(&s, fr_bridged(x[i], s.last), half_step);
    *sum = s;
}

fr_status fr_integral_push(fr_integral *integral, const fr_real *x, size_t count, fr_real *y,
                           size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_integral(integral, x, count, y, capacity, written);
    fr_trapezoid sum;
    if (status == FR_OK && !(integral->half_step > 0))
        status = FR_BAD_CONFIG;
    if (status != FR_OK)
        return status;
    sum = integral->sum;
    if (count > 0u)
        y[0] = fr_trapezoid_step(&sum, fr_bridged(x[0], sum.last), integral->half_step);
    run_constant(&sum, integral->half_step, x, count, y);
    integral->sum = sum;
    *written = count;
    return FR_OK;
}

fr_status fr_integral_push_steps(fr_integral *integral, const fr_real *x, const fr_real *time_step,
                                 size_t count, fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_integral(integral, x, count, y, capacity, written);
    fr_trapezoid sum;
    if (status == FR_OK)
        status = fr_check_steps(time_step, count);
    if (status != FR_OK)
        return status;
    sum = integral->sum;
    for (size_t i = 0; i < count; i++)
        y[i] = fr_trapezoid_step(&sum, fr_bridged(x[i], sum.last), FR_R(0.5) * time_step[i]);
    integral->sum = sum;
    *written = count;
    return FR_OK;
}

/* The change of the height in place of the part of the integral that a shorter step leaves out. */
static fr_real reflected(fr_real change, fr_real adjusted, fr_real time_step)
{
    fr_real ratio = adjusted / time_step;
    return (1 - ratio * ratio) * change;
}

static void run_reflecting(fr_integral *integral, const fr_real *velocity, const fr_real *height,
                           const fr_real *adjusted, const fr_real *time_step, size_t count,
                           fr_real *y)
{
    fr_trapezoid sum = integral->sum;
    fr_real before = integral->height;
    for (size_t i = 0; i < count; i++) {
        fr_real reading = fr_bridged(height[i], before);
        int inside = sum.started != 0 && time_step[i] > 0;
        (void)fr_trapezoid_step(&sum, fr_bridged(velocity[i], sum.last), FR_R(0.5) * adjusted[i]);
        if (inside)
            sum.total += reflected(reading - before, adjusted[i], time_step[i]);
        before = reading;
        y[i] = sum.total;
    }
    integral->sum = sum;
    integral->height = before;
}

fr_status fr_integral_push_reflecting(fr_integral *integral, const fr_real *velocity,
                                      const fr_real *height, const fr_real *adjusted,
                                      const fr_real *time_step, size_t count, fr_real *y,
                                      size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_integral(integral, velocity, count, y, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(height, count, integral->missing);
    if (status == FR_OK)
        status = fr_check_steps(adjusted, count);
    if (status == FR_OK)
        status = fr_check_steps(time_step, count);
    if (status != FR_OK)
        return status;
    run_reflecting(integral, velocity, height, adjusted, time_step, count, y);
    *written = count;
    return FR_OK;
}
