/* SPDX-License-Identifier: Apache-2.0
 *
 * Travel speed from the encoder: v_k = (d_k - d_{k-n}) / (n dt), as the suppression algorithms of
 * 5.6 and 5.7 use it. The difference is one of counts, so it is exact at any distance.
 */
#include <math.h>
#include <string.h>

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
    int64_t beyond = 0, behind;
    if (count > 0u && counts == NULL)
        return FR_NULL_POINTER;
    if (count > FR_MOST_SAMPLES)
        return FR_TOO_MANY;
    /* The first count that is behind the furthest one is behind its neighbour. */
    for (size_t i = 0; i < count; i++) {
        beyond |= counts[i] > FR_MOST_COUNTS;
        beyond |= counts[i] < -FR_MOST_COUNTS;
    }
    behind = count > 0u && counts[0] < before;
    for (size_t i = 1; i < count; i++)
        behind |= counts[i] < counts[i - 1u];
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

/* Where the counts one window before sample i of a push and those behind it are, `*run` of them in
 * one piece; before the run the vehicle is stationary. */
static const int64_t *counts_before(const fr_travel *travel, const int64_t *ring,
                                    const int64_t *counts, size_t i, size_t *run)
{
    size_t window = travel->window, at = travel->oldest + i;
    *run = i >= window ? SIZE_MAX : 1u;
    if (i >= window)
        return counts + (i - window);
    if (travel->started == 0)
        return counts;
    *run = at < window ? window - at : window - i;
    return ring + (at < window ? at : at - window);
}

/* A core with a single-precision unit alone converts 32 bits in one instruction, and calls a
 * function for 64; the result is the same. */
static inline fr_real real_of(int64_t progress)
{
#ifdef FR_FLOAT
    if (progress >= INT32_MIN && progress <= INT32_MAX)
        return FR_R((int32_t)progress);
#endif
    return FR_R(progress);
}

/* Speeds where counts may be missing: while the window has a missing one, the last is repeated. */
static void speeds_of_known(fr_travel *travel, const int64_t *ring, const int64_t *counts,
                            size_t first, size_t size, fr_real *speed)
{
    size_t run;
    for (size_t k = 0; k < size; k++) {
        int64_t now = counts[first + k];
        int64_t before = *counts_before(travel, ring, counts, first + k, &run);
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
    fr_real scale = travel->metres_per_count, duration_s = travel->duration_s;
    size_t done = 0, run;
    while (done < size) {
        const int64_t *before = counts_before(travel, ring, counts, first + done, &run);
        const int64_t *now = counts + first + done;
        size_t some = run < size - done ? run : size - done;
        for (size_t k = 0; k < some; k++)
            speed[done + k] = real_of(now[k] - before[k]) * scale / duration_s;
        done += some;
    }
}

/* Write the newest counts into the ring, which ends once at most on the way. */
static void keep_newest(fr_travel *travel, int64_t *ring, const int64_t *counts, size_t count)
{
    size_t left = travel->window - travel->oldest, first = count < left ? count : left;
    (void)memcpy(ring + travel->oldest, counts, first * sizeof *counts);
    (void)memcpy(ring, counts + first, (count - first) * sizeof *counts);
    travel->oldest = (uint32_t)(count < left ? travel->oldest + count : count - left);
}

void fr_travel_keep(fr_travel *travel, int64_t *ring, const int64_t *counts, size_t count)
{
    size_t window = travel->window, skipped = count > window ? count - window : 0u;
    int64_t furthest = travel->furthest;
    if (count > 0u && travel->started == 0) {
        for (size_t i = 0; i < window; i++)
            ring[i] = counts[0];
        travel->started = 1;
        furthest = counts[0];
    }
    for (size_t i = 0; i < count; i++)
        furthest = counts[i] > furthest ? counts[i] : furthest;
    travel->furthest = furthest;
    if (count > 0u)
        keep_newest(travel, ring, counts + skipped, count - skipped);
}

size_t fr_travel_speed_size(const fr_travel_speed_config *config)
{
    uint32_t window = config == NULL ? 0u : fr_travel_window(config);
    return window == 0u ? 0u : fr_sized(FR_PADDED(fr_travel_speed), window, sizeof(int64_t));
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
    fr_nothing(written);
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
