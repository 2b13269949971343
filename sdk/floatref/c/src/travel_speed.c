/* SPDX-License-Identifier: Apache-2.0
 *
 * Travel speed from the encoder: v_k = (d_k - d_{k-n}) / (n dt), as the suppression algorithms of
 * 5.6 and 5.7 use it. The difference is one of counts, so it is exact at any distance.
 */
#include <math.h>

#include "travel.h"

#define TRAVEL_MAGIC FR_MAGIC(4)
#define WIDEST_S 60.0
#define FASTEST_HZ 1e7

struct fr_travel_speed {
    fr_head head;
    fr_travel travel;
};

fr_travel_speed_config fr_travel_speed_defaults(void)
{
    fr_travel_speed_config config = {0.0, 0.0, 0.05, FR_BACK_REFUSED};
    return config;
}

uint32_t fr_travel_window(const fr_travel_speed_config *config)
{
    int possible = fr_above_zero(config->rate_hz) && config->rate_hz <= FASTEST_HZ &&
                   fr_above_zero(config->metres_per_count) && fr_above_zero(config->window_s) &&
                   config->window_s <= WIDEST_S &&
                   fr_one_of(config->back, FR_BACK_REFUSED, FR_BACK_TAKEN);
    double samples = possible ? rint(config->window_s * config->rate_hz) : 0.0;
    return possible && samples < 1.0 ? 1u : (uint32_t)samples;
}

void fr_travel_set(fr_travel *travel, const fr_travel_speed_config *config)
{
    travel->window = fr_travel_window(config);
    travel->back = config->back;
    travel->missing = FR_MISSING_REFUSED;
    travel->metres_per_count = FR_R(config->metres_per_count);
    travel->duration_s = FR_R((double)travel->window / config->rate_hz);
}

fr_status fr_check_counts(const int64_t *counts, size_t count, int32_t back, int64_t before)
{
    int64_t furthest = before;
    int beyond = 0, behind = 0;
    if (count > 0u && counts == NULL)
        return FR_NULL_POINTER;
    if (count > FR_MOST_SAMPLES)
        return FR_TOO_MANY;
    for (size_t i = 0; i < count; i++) {
        beyond |= counts[i] > FR_MOST_COUNTS || counts[i] < -FR_MOST_COUNTS;
        behind |= counts[i] < furthest;
        furthest = counts[i] > furthest ? counts[i] : furthest;
    }
    if (beyond != 0)
        return FR_BAD_SAMPLE;
    return behind != 0 && back == FR_BACK_REFUSED ? FR_GOES_BACK : FR_OK;
}

fr_status fr_check_known_counts(const int64_t *counts, size_t count, int32_t back, int64_t before)
{
    int64_t furthest = before;
    fr_status status = count > 0u && counts == NULL ? FR_NULL_POINTER : FR_OK;
    if (count > FR_MOST_SAMPLES)
        status = FR_TOO_MANY;
    for (size_t i = 0; status == FR_OK && i < count; i++) {
        if (counts[i] == FR_NO_COUNT && furthest != INT64_MIN)
            continue;
        status = fr_check_counts(counts + i, 1u, back, furthest);
        furthest = counts[i] > furthest ? counts[i] : furthest;
    }
    return status;
}

fr_status fr_travel_check(const fr_travel *travel, const int64_t *counts, size_t count)
{
    int64_t furthest = travel->started != 0 ? travel->furthest : INT64_MIN;
    if (travel->missing == FR_MISSING_BRIDGED)
        return fr_check_known_counts(counts, count, travel->back, furthest);
    return fr_check_counts(counts, count, travel->back, furthest);
}

/* The count one window before sample i of a push; before the run the vehicle is stationary. */
static int64_t count_before(const fr_travel *travel, const int64_t *ring, const int64_t *counts,
                            size_t i)
{
    size_t at = travel->oldest + i;
    if (i >= travel->window)
        return counts[i - travel->window];
    return travel->started != 0 ? ring[at < travel->window ? at : at - travel->window] : counts[0];
}

/* The same where counts may be missing: while the window has one, the last speed is repeated. */
static void speeds_of_known(fr_travel *travel, const int64_t *ring, const int64_t *counts,
                            size_t first, size_t size, fr_real *speed)
{
    for (size_t k = 0; k < size; k++) {
        int64_t now = counts[first + k], before = count_before(travel, ring, counts, first + k);
        uint32_t left = travel->unknown > 0u ? travel->unknown - 1u : 0u;
        travel->unknown = now == FR_NO_COUNT ? travel->window + 1u : left;
        if (travel->unknown == 0u)
            travel->held = FR_R(now - before) * travel->metres_per_count / travel->duration_s;
        speed[k] = travel->held;
    }
}

void fr_travel_speeds(fr_travel *travel, const int64_t *ring, const int64_t *counts, size_t first,
                      size_t size, fr_real *speed)
{
    if (travel->missing == FR_MISSING_BRIDGED) {
        speeds_of_known(travel, ring, counts, first, size, speed);
        return;
    }
    for (size_t k = 0; k < size; k++) {
        int64_t progress = counts[first + k] - count_before(travel, ring, counts, first + k);
        speed[k] = FR_R(progress) * travel->metres_per_count / travel->duration_s;
    }
}

void fr_travel_keep(fr_travel *travel, int64_t *ring, const int64_t *counts, size_t count)
{
    size_t window = travel->window, skipped = count > window ? count - window : 0u;
    if (count > 0u && travel->started == 0) {
        for (size_t i = 0; i < window; i++)
            ring[i] = counts[0];
        travel->started = 1;
        travel->furthest = counts[0];
    }
    for (size_t i = 0; i < count; i++)
        travel->furthest = counts[i] > travel->furthest ? counts[i] : travel->furthest;
    for (size_t i = skipped; i < count; i++) {
        ring[travel->oldest] = counts[i];
        travel->oldest = travel->oldest + 1u < travel->window ? travel->oldest + 1u : 0u;
    }
}

size_t fr_travel_speed_size(const fr_travel_speed_config *config)
{
    uint32_t window = config == NULL ? 0u : fr_travel_window(config);
    return window == 0u ? 0u : FR_PADDED(fr_travel_speed) + window * sizeof(int64_t);
}

fr_status fr_travel_speed_init(void *memory, size_t size, const fr_travel_speed_config *config,
                               fr_travel_speed **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_travel_speed_size(config), TRAVEL_MAGIC);
    if (status != FR_OK)
        return status;
    *out = (fr_travel_speed *)memory;
    fr_travel_set(&(*out)->travel, config);
    return FR_OK;
}

fr_status fr_travel_speed_push(fr_travel_speed *travel, const int64_t *counts, size_t count,
                               fr_real *speed, size_t capacity, size_t *written)
{
    fr_status status = fr_ready(travel, TRAVEL_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, speed, capacity, written);
    if (status == FR_OK)
        status = fr_travel_check(&travel->travel, counts, count);
    if (status != FR_OK)
        return status;
    int64_t *ring = (int64_t *)FR_BEHIND(travel, fr_travel_speed);
    fr_travel_speeds(&travel->travel, ring, counts, 0u, count, speed);
    fr_travel_keep(&travel->travel, ring, counts, count);
    *written = count;
    return FR_OK;
}
