/* SPDX-License-Identifier: Apache-2.0
 *
 * The Kalman filter alone (6.6.1): its height steps at every reading.
 */
#include <string.h>

#include "kalman_engine.h"

#define KALMAN_FILTER_MAGIC FR_MAGIC(20)

struct fr_kalman_filter {
    fr_head head;
    fr_kalman_engine engine;
};

size_t fr_kalman_filter_size(const fr_kalman_filter_config *config)
{
    size_t room = fr_kalman_engine_room(config);
    return room > 0u ? fr_sized(FR_PADDED(fr_kalman_filter), room, 1u) : 0u;
}

fr_status fr_kalman_filter_init(void *memory, size_t size, const fr_kalman_filter_config *config,
                                fr_kalman_filter **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_kalman_filter_size(config), KALMAN_FILTER_MAGIC);
    if (status != FR_OK)
        return status;
    *out = (fr_kalman_filter *)memory;
    fr_kalman_engine_set(&(*out)->engine, config);
    return FR_OK;
}

static void *room_of(fr_kalman_filter *filter)
{
    return FR_BEHIND(filter, fr_kalman_filter);
}

/* Whether `needed` heights fit. */
static fr_status heights_fit(size_t needed, const double *heights, size_t capacity,
                             size_t *written)
{
    if (written == NULL || (needed > 0u && heights == NULL))
        return FR_NULL_POINTER;
    *written = needed > capacity ? needed : 0u;
    return needed > capacity ? FR_OUTPUT_FULL : FR_OK;
}

fr_status fr_kalman_filter_push_gnss(fr_kalman_filter *filter, int64_t sample,
                                     const double values[4], const double variances[4])
{
    fr_status status = fr_ready(filter, KALMAN_FILTER_MAGIC);
    if (status != FR_OK)
        return status;
    return fr_kalman_engine_read(&filter->engine, room_of(filter), sample, values, variances);
}

static void run_filter(fr_kalman_filter *filter, const fr_imu *imu, const double *height,
                       const int64_t *counts, size_t count, double *heights)
{
    fr_kalman_engine *engine = &filter->engine;
    fr_kalman_step step;
    fr_kalman_node node;
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        fr_kalman_sample sample = fr_kalman_sample_of(engine, imu, height, i);
        if (fr_kalman_engine_take(engine, room_of(filter), &sample, counts[i], &step, &node) != 0) {
            heights[made] = step.reference_height;
            made++;
        }
    }
}

fr_status fr_kalman_filter_push(fr_kalman_filter *filter, const fr_imu *imu, const double *height,
                                const int64_t *counts, size_t count, double *reference_height,
                                size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(filter, KALMAN_FILTER_MAGIC);
    size_t needed = 0;
    if (status == FR_OK && written != NULL)
        *written = 0u;
    if (status == FR_OK)
        status = fr_kalman_engine_check(&filter->engine, imu, height, counts, count);
    if (status == FR_OK) {
        needed = fr_kalman_engine_ready(&filter->engine, count);
        status = heights_fit(needed, reference_height, capacity, written);
    }
    if (status != FR_OK)
        return status;
    run_filter(filter, imu, height, counts, count, reference_height);
    *written = needed;
    return FR_OK;
}

fr_status fr_kalman_filter_finish(fr_kalman_filter *filter, double *reference_height,
                                  size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(filter, KALMAN_FILTER_MAGIC);
    fr_kalman_step step;
    fr_kalman_node node;
    size_t made = 0;
    if (status == FR_OK)
        status = heights_fit(fr_kalman_engine_waiting(&filter->engine), reference_height, capacity,
                             written);
    if (status != FR_OK)
        return status;
    while (fr_kalman_engine_drain(&filter->engine, room_of(filter), &step, &node) != 0) {
        reference_height[made] = step.reference_height;
        made++;
    }
    filter->head.state = FR_STATE_ENDED;
    *written = made;
    return FR_OK;
}

fr_status fr_kalman_filter_left_out(const fr_kalman_filter *filter, int64_t count[4])
{
    fr_status status = fr_readable(filter, KALMAN_FILTER_MAGIC);
    return status == FR_OK ? fr_kalman_engine_left_out(&filter->engine, count) : status;
}
