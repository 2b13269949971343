/* SPDX-License-Identifier: Apache-2.0
 *
 * Local suppression, fig. 5.10: v = d + o - K_P v - K_I integral of v, by the trapezoidal rule. The
 * integral starts at zero whenever the speed comes below the limit; o is the offset of the last
 * action, so that v goes on without a step when the speed has risen again.
 */
#include "samples.h"

#define SUPPRESSION_MAGIC FR_MAGIC(9)

struct fr_local_suppression {
    fr_head head;
    int32_t missing, active;
    fr_real limit, integral, at_once, later;
    fr_real held, moving, last, area, offset;
};

fr_local_suppression_config fr_local_suppression_defaults(void)
{
    fr_local_suppression_config config = {0.0, 4.4704, 0.001, 0.834, FR_MISSING_REFUSED};
    return config;
}

size_t fr_local_suppression_size(const fr_local_suppression_config *config)
{
    int possible = config != NULL && fr_above_zero(config->rate_hz) &&
                   fr_above_zero(1.0 / config->rate_hz) && fr_above_zero(config->below_mps) &&
                   fr_above_zero(config->proportional) && fr_above_zero(config->integral_per_s) &&
                   fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED);
    return possible ? sizeof(fr_local_suppression) : 0u;
}

fr_status fr_local_suppression_init(void *memory, size_t size,
                                    const fr_local_suppression_config *config,
                                    fr_local_suppression **out)
{
    fr_local_suppression *control = (fr_local_suppression *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_local_suppression_size(config), SUPPRESSION_MAGIC);
    if (status != FR_OK)
        return status;
    double integral = config->integral_per_s * (1.0 / config->rate_hz);
    control->missing = config->missing;
    control->limit = FR_R(config->below_mps);
    control->integral = FR_R(0.5 * integral);
    control->at_once = FR_R(1.0 / (1.0 + config->proportional));
    control->later = FR_R(1.0 / (1.0 + config->proportional + 0.5 * integral));
    *out = control;
    return FR_OK;
}

static fr_real suppress(fr_local_suppression *control)
{
    fr_real value;
    if (control->active == 0) {
        control->active = 1;
        control->area = 0;
        return (control->held + control->offset) * control->at_once;
    }
    control->area += control->integral * control->last;
    value = (control->held + control->offset - control->area) * control->later;
    control->area += control->integral * value;
    return value;
}

static fr_real control_one(fr_local_suppression *control, fr_real disturbance, fr_real speed)
{
    fr_real before = control->held;
    control->held = fr_missing(disturbance) ? before : disturbance;
    control->moving = fr_missing(speed) ? control->moving : speed;
    if (control->moving < control->limit) {
        control->last = suppress(control);
        return control->last;
    }
    if (control->active != 0) {
        control->active = 0;
        control->offset = control->last - before;
    }
    control->last = control->held + control->offset;
    return control->last;
}

fr_status fr_local_suppression_push(fr_local_suppression *control, const fr_real *velocity,
                                    const fr_real *speed, size_t count, fr_real *y, size_t capacity,
                                    size_t *written)
{
    fr_nothing(written);
    fr_local_suppression c;
    fr_status status = fr_ready(control, SUPPRESSION_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, y, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(velocity, count, control->missing);
    if (status == FR_OK)
        status = fr_check_samples(speed, count, control->missing);
    if (status != FR_OK)
        return status;
    c = *control;
    for (size_t i = 0; i < count; i++)
        y[i] = control_one(&c, velocity[i], speed[i]);
    *control = c;
    *written = count;
    return FR_OK;
}
