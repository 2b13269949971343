/* SPDX-License-Identifier: Apache-2.0
 *
 * Pushes of the road-prior smoother: checked whole, before the first sample changes anything.
 */
#include "road_prior.h"
#include "samples.h"

/* Values beyond this are of no sensor; their squares would leave the range of numbers. */
#define FARTHEST_VALUE 1e6

static int within(const fr_real *x, size_t count, double least, double most)
{
    int wrong = 0;
    for (size_t i = 0; x != NULL && i < count; i++)
        wrong |= (double)x[i] < least || (double)x[i] > most;
    return wrong == 0;
}

/* Shares may be left out. */
static fr_status check_share(const fr_real *share, size_t count)
{
    if (share == NULL)
        return FR_OK;
    fr_status status = fr_check_samples(share, count, FR_MISSING_REFUSED);
    return status == FR_OK && !within(share, count, 0.0, 1.0) ? FR_BAD_SAMPLE : status;
}

static fr_status check_sensor(const fr_real *x, size_t count, int32_t missing)
{
    fr_status status = fr_check_samples(x, count, missing);
    if (status == FR_OK && !within(x, count, -FARTHEST_VALUE, FARTHEST_VALUE))
        status = FR_BAD_SAMPLE;
    return status;
}

/* The run begins at its first height, which the smoother takes for the level of all others. */
static fr_status check_heights(const fr_road_prior *road, const fr_road_input *input)
{
    fr_status status = check_sensor(input->height, input->count, road->missing);
    int begins = status == FR_OK && road->nodes == 0 && input->count > 0u;
    return begins && fr_missing(input->height[0]) ? FR_BAD_SAMPLE : status;
}

static fr_status check_input(const fr_road_prior *road, const fr_road_input *input, size_t *needed)
{
    int64_t before = road->nodes > 0 ? road->furthest : INT64_MIN;
    fr_status status = check_sensor(input->acceleration, input->count, road->missing);
    if (status == FR_OK)
        status = check_heights(road, input);
    if (status == FR_OK)
        status = road->missing == FR_MISSING_BRIDGED
                     ? fr_check_known_counts(input->counts, input->count, road->back, before)
                     : fr_check_counts(input->counts, input->count, road->back, before);
    if (status == FR_OK)
        status = check_share(input->level, input->count);
    if (status == FR_OK)
        status = check_share(input->share, input->count);
    return status == FR_OK ? fr_road_foresee(road, input->counts, input->count, needed) : status;
}

/* Whether output of that size has room. */
static fr_status check_output(size_t needed, const fr_lag_output *output, size_t capacity,
                              size_t *written)
{
    fr_status status = fr_room(needed, output->elevation, capacity, written);
    if (status == FR_OK && needed > 0u && (output->sigma == NULL || output->flags == NULL))
        status = FR_NULL_POINTER;
    return status;
}

static fr_status push_road(fr_road_prior *road, const fr_road_input *input, fr_lag_output *output,
                           size_t capacity, size_t *written)
{
    size_t needed = 0;
    fr_status status = fr_ready(road, FR_ROAD_MAGIC);
    if (status == FR_OK)
        status = fr_room(0u, output->elevation, capacity, written);
    if (status == FR_OK)
        status = check_input(road, input, &needed);
    if (status == FR_OK)
        status = check_output(needed, output, capacity, written);
    if (status != FR_OK)
        return status;
    fr_road_samples(road, input, output);
    *written = needed;
    return FR_OK;
}

fr_status fr_road_prior_push(fr_road_prior *road, const fr_real *acceleration,
                             const fr_real *height, const int64_t *counts, size_t count,
                             fr_real *elevation, fr_real *sigma, uint8_t *flags, size_t capacity,
                             size_t *written)
{
    fr_nothing(written);
    fr_road_input input = {acceleration, height, counts, NULL, NULL, count};
    fr_lag_output output = {elevation, sigma, flags, 0u};
    return push_road(road, &input, &output, capacity, written);
}

fr_status fr_road_prior_push_levelled(fr_road_prior *road, const fr_real *acceleration,
                                      const fr_real *height, const int64_t *counts,
                                      const fr_real *levelled, const fr_real *missing,
                                      size_t count, fr_real *elevation, fr_real *sigma,
                                      uint8_t *flags, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_road_input input = {acceleration, height, counts, levelled, missing, count};
    fr_lag_output output = {elevation, sigma, flags, 0u};
    return push_road(road, &input, &output, capacity, written);
}

fr_status fr_road_prior_finish(fr_road_prior *road, fr_real *elevation, fr_real *sigma,
                               uint8_t *flags, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_lag_output output = {elevation, sigma, flags, 0u};
    fr_status status = fr_ready(road, FR_ROAD_MAGIC);
    if (status != FR_OK)
        return status;
    size_t needed = (size_t)(road->progress.reached - road->progress.clock.released);
    status = check_output(needed, &output, capacity, written);
    if (status != FR_OK)
        return status;
    fr_road_end(road, &output);
    road->head.state = FR_STATE_ENDED;
    *written = needed;
    return FR_OK;
}
