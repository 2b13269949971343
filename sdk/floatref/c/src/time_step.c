/* SPDX-License-Identifier: Apache-2.0
 *
 * The time between triggers, (5.4), as a difference of timer counts: exact however long the run.
 */
#include "travel.h"

#define TIME_STEP_MAGIC FR_MAGIC(12)

struct fr_time_step {
    fr_head head;
    int32_t started;
    fr_real seconds_per_tick;
    int64_t last;
};

fr_time_step_config fr_time_step_defaults(void)
{
    fr_time_step_config config = {0.0};
    return config;
}

size_t fr_time_step_size(const fr_time_step_config *config)
{
    return config != NULL && fr_above_zero(config->seconds_per_tick) ? sizeof(fr_time_step) : 0u;
}

fr_status fr_time_step_init(void *memory, size_t size, const fr_time_step_config *config,
                            fr_time_step **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_time_step_size(config),
                                TIME_STEP_MAGIC);
    if (status != FR_OK)
        return status;
    *out = (fr_time_step *)memory;
    (*out)->seconds_per_tick = FR_R(config->seconds_per_tick);
    return FR_OK;
}

fr_status fr_time_step_push(fr_time_step *timer, const int64_t *ticks, size_t count,
                            fr_real *time_step, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(timer, TIME_STEP_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, time_step, capacity, written);
    if (status == FR_OK)
        status = fr_check_counts(ticks, count, FR_BACK_REFUSED,
                                 timer->started != 0 ? timer->last : INT64_MIN);
    if (status != FR_OK)
        return status;
    for (size_t i = 0; i < count; i++) {
        int64_t before = timer->started != 0 ? timer->last : ticks[i];
        time_step[i] = FR_R(ticks[i] - before) * timer->seconds_per_tick;
        timer->started = 1;
        timer->last = ticks[i];
    }
    *written = count;
    return FR_OK;
}
