/* SPDX-License-Identifier: Apache-2.0
 *
 * Projection of one signal from time to distance, 5.3.
 */
#include "points.h"

#define PROJECTION_MAGIC FR_MAGIC(5)

struct fr_projection {
    fr_head head;
    fr_points points;
    fr_real last;    /* sample */
    double rate_hz;  /* 0 without time steps */
    uint64_t passed; /* samples from that of the last point to the next one */
    fr_real part;    /* of the way to that sample at which the last point lies, 1 for all of it */
};

fr_projection_config fr_projection_defaults(void)
{
    fr_projection_config config = {0.0, 0.0, 0.0};
    return config;
}

size_t fr_projection_size(const fr_projection_config *config)
{
    int possible = config != NULL &&
                   fr_points_are_possible(config->interval_m, config->metres_per_count) &&
                   (config->rate_hz == 0.0 || fr_above_zero(config->rate_hz));
    return possible ? sizeof(fr_projection) : 0u;
}

fr_status fr_projection_init(void *memory, size_t size, const fr_projection_config *config,
                             fr_projection **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_projection_size(config),
                                PROJECTION_MAGIC);
    if (status != FR_OK)
        return status;
    *out = (fr_projection *)memory;
    (*out)->rate_hz = config->rate_hz;
    fr_points_set(&(*out)->points, config->interval_m, config->metres_per_count);
    return FR_OK;
}

/* A missing sample is a missing point, which the caller may bridge. */
static fr_status check_projection(const fr_projection *projection, const int64_t *counts,
                                  const fr_real *x, size_t count, size_t *needed)
{
    fr_status status = fr_check_samples(x, count, FR_MISSING_BRIDGED);
    if (status == FR_OK)
        status = fr_check_counts(counts, count, FR_BACK_TAKEN, INT64_MIN);
    return status == FR_OK ? fr_points_needed(&projection->points, counts, count, needed) : status;
}

/* Time from the point before to one that lies `part` of the way to the sample that is passed. */
static fr_real step_to(fr_projection *projection, fr_real part)
{
    double samples = (double)projection->passed + ((double)part - (double)projection->part);
    int first = projection->points.next == 1;
    projection->passed = 0u;
    projection->part = part;
    return first ? 0 : FR_R(samples / projection->rate_hz);
}

static void run_projection(fr_projection *projection, const int64_t *counts, const fr_real *x,
                           size_t count, fr_real *y, fr_real *time_step)
{
    fr_place_of_point place;
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        fr_points_begin(&projection->points, counts[i]);
        projection->passed++;
        while (fr_points_reached(&projection->points, counts[i]) != 0) {
            fr_points_next(&projection->points, counts[i], &place);
            y[made] = fr_points_read(&place, projection->last, x[i]);
            if (time_step != NULL)
                time_step[made] = step_to(projection, place.part);
            made++;
        }
        fr_points_pass(&projection->points, counts[i]);
        projection->last = x[i];
    }
}

static fr_status push_points(fr_projection *projection, const int64_t *counts, const fr_real *x,
                             size_t count, fr_real *y, fr_real *time_step, size_t capacity,
                             size_t *written)
{
    size_t needed = 0;
    fr_status status = fr_room(0u, y, capacity, written);
    if (status == FR_OK)
        status = check_projection(projection, counts, x, count, &needed);
    if (status == FR_OK)
        status = fr_room(needed, y, capacity, written);
    if (status != FR_OK)
        return status;
    run_projection(projection, counts, x, count, y, time_step);
    *written = needed;
    return FR_OK;
}

fr_status fr_projection_push(fr_projection *projection, const int64_t *counts, const fr_real *x,
                             size_t count, fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(projection, PROJECTION_MAGIC);
    if (status != FR_OK)
        return status;
    return push_points(projection, counts, x, count, y, NULL, capacity, written);
}

fr_status fr_projection_push_timed(fr_projection *projection, const int64_t *counts,
                                   const fr_real *x, size_t count, fr_real *y, fr_real *time_step,
                                   size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(projection, PROJECTION_MAGIC);
    if (status == FR_OK && !(projection->rate_hz > 0.0))
        status = FR_BAD_CONFIG;
    if (status == FR_OK && time_step == NULL)
        status = FR_NULL_POINTER;
    if (status != FR_OK)
        return status;
    return push_points(projection, counts, x, count, y, time_step, capacity, written);
}
