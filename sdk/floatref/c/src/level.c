/* SPDX-License-Identifier: Apache-2.0
 *
 * Levelling as samples come: settings, memory and calls.
 */
#include "bell.h"
#include "bins.h"
#include "level_model.h"
#include "level_stage.h"

#define LEVEL_MAGIC FR_MAGIC(40)
#define SMOOTHED_S 0.5
#define AFTER_STOP_S 5.0
#define BEFORE_START_S 3.0
#define SIDE_S 30.0
#define SHARED_S 20.0
#define LEAST_TRAVEL_M 200.0
#define LEAST_HZ 20.0
#define FASTEST 1e6

fr_level_config fr_level_defaults(void)
{
    fr_level_config config = {0.0, 0.0, fr_level_fit_defaults(), 2, FR_BACK_REFUSED,
                              FR_MISSING_REFUSED, 0};
    return config;
}

/* The lengths in bins that follow from a configuration, all else of the object is cleared. */
static void set_lengths(fr_level *level, const fr_level_config *config)
{
    double every = fr_bin_samples(config->rate_hz);
    double step_s = every / config->rate_hz;
    level->config = *config;
    level->config.fit.step_s = step_s;
    level->step_s = step_s;
    level->every = (int32_t)every;
    level->smooth = fr_bins_in(SMOOTHED_S, step_s);
    level->reach = fr_bell_reach(step_s);
    level->ring = 2 * level->smooth + 2 * level->reach + FR_LEAST_BINS + 8;
    level->after = fr_bins_in(AFTER_STOP_S, step_s);
    level->before = fr_bins_in(BEFORE_START_S, step_s);
    level->side = fr_bins_in(SIDE_S, step_s);
    level->window = fr_bins_in(config->fit.longest_s, step_s);
    level->shared = fr_bins_in(SHARED_S, step_s);
    level->room = level->window + 2 * level->side + fr_bins_in((double)LV_SPARE_S, step_s);
}

typedef struct shelf {
    unsigned char *base; /* NULL to count alone */
    size_t used;
} shelf;

static void *put(shelf *s, int32_t count, size_t each)
{
    unsigned char *place = s->base == NULL ? NULL : s->base + s->used;
    s->used += ((size_t)count * each + 7u) / 8u * 8u;
    return (void *)place;
}

/* Where the arrays of an object lie in its memory; returns all bytes, 0 if there is no fit. */
size_t fr_lv_arrays(const fr_level *level, void *memory, lv_arrays *a)
{
    shelf s = {(unsigned char *)memory, FR_PADDED(fr_level)};
    lv_work work;
    size_t fit = fr_lv_lay_out(&work, &level->config.fit, NULL);
    a->queue = (lv_bin *)put(&s, level->room, sizeof(lv_bin));
    a->rest = (lv_bin *)put(&s, level->before, sizeof(lv_bin));
    a->distance = (double *)put(&s, level->ring, sizeof(double));
    a->height = (double *)put(&s, level->ring, sizeof(double));
    a->force = (double *)put(&s, level->ring * LV_PATHS, sizeof(double));
    a->bell = (double *)put(&s, level->reach + 1, sizeof(double));
    a->number = (int64_t *)put(&s, level->window, sizeof(int64_t));
    for (int32_t i = 0; i < 6; i++)
        a->column[i] = (double *)put(&s, level->window, sizeof(double));
    a->pitch = (double *)put(&s, level->window, sizeof(double));
    a->sigma = (double *)put(&s, level->window, sizeof(double));
    a->fit = put(&s, 0, 1u);
    return fit == 0u || fit > SIZE_MAX / 2u - s.used ? 0u : s.used + fit;
}

static int is_possible_stage(const fr_level_config *c)
{
    return c != NULL && c->rate_hz >= LEAST_HZ && c->rate_hz <= FASTEST &&
           fr_above_zero(c->metres_per_count) && c->metres_per_count <= 10.0 &&
           c->fit.longest_s >= 2.0 * SHARED_S && c->fit.longest_s <= 600.0 &&
           c->fit.most_travel_m >= LEAST_TRAVEL_M &&
           fr_one_of(c->paths, 1, LV_PATHS) &&
           fr_one_of(c->back, FR_BACK_REFUSED, FR_BACK_TAKEN) &&
           fr_one_of(c->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) && c->reserved == 0;
}

size_t fr_level_size(const fr_level_config *config)
{
    fr_level lengths;
    lv_arrays arrays;
    if (!is_possible_stage(config))
        return 0u;
    set_lengths(&lengths, config);
    return fr_lv_arrays(&lengths, NULL, &arrays);
}

fr_status fr_level_init(void *memory, size_t size, const fr_level_config *config, fr_level **out)
{
    fr_level *level = (fr_level *)memory;
    lv_arrays arrays;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_level_size(config),
                                LEVEL_MAGIC);
    if (status != FR_OK)
        return status;
    set_lengths(level, config);
    level->furthest = INT64_MIN;
    for (int32_t p = 0; p < LV_PATHS; p++)
        level->mean[p].last = (double)NAN;
    (void)fr_lv_arrays(level, memory, &arrays);
    fr_bell_set(arrays.bell, level->reach, level->step_s);
    *out = level;
    return FR_OK;
}

fr_status fr_level_every(const fr_level *level, int64_t *every)
{
    fr_status status = fr_readable(level, LEVEL_MAGIC);
    if (status == FR_OK && every == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        *every = level->every;
    return status;
}

/* Whether the bins that these samples complete have room in the queue. */
static fr_status check_queue(const fr_level *level, size_t count)
{
    double most = (double)LV_PUSH_S * level->config.rate_hz;
    int32_t ready = level->ready - level->taken;
    if ((double)count > most)
        return FR_TOO_MANY;
    return ready > fr_bins_in((double)LV_SPARE_S / 4.0, level->step_s) ? FR_OUTPUT_FULL : FR_OK;
}

static fr_status check_level_push(const fr_level *level, const fr_real *force, const fr_real *height,
                            const int64_t *counts, size_t count, const size_t *ready)
{
    fr_status status = fr_ready(level, LEVEL_MAGIC);
    if (status == FR_OK && ready == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = fr_check_paths(force, count, level->config.paths, level->config.missing);
    if (status == FR_OK)
        status = fr_check_paths(height, count, level->config.paths, level->config.missing);
    if (status == FR_OK)
        status = fr_check_counts(counts, count, level->config.back, level->furthest);
    return status == FR_OK ? check_queue(level, count) : status;
}

static void derive_all(fr_level *level, lv_arrays *a, int at_end)
{
    lv_bin bin;
    while (fr_lv_derive_bin(level, a, at_end, &bin))
        fr_lv_take_bin(level, a, &bin);
}

fr_status fr_level_push(fr_level *level, const fr_real *force, const fr_real *height,
                        const int64_t *counts, size_t count, size_t *ready)
{
    fr_nothing(ready);
    lv_arrays a;
    fr_status status = check_level_push(level, force, height, counts, count, ready);
    if (status == FR_OUTPUT_FULL)
        *ready = (size_t)(level->ready - level->taken);
    if (status != FR_OK)
        return status;
    (void)fr_lv_arrays(level, level, &a);
    for (size_t i = 0; i < count; i++) {
        size_t at = i * (size_t)level->config.paths;
        level->furthest = counts[i] > level->furthest ? counts[i] : level->furthest;
        if (fr_lv_add_sample(level, &a, force + at, height + at, counts[i]))
            derive_all(level, &a, 0);
    }
    *ready = (size_t)(level->ready - level->taken);
    return FR_OK;
}

fr_status fr_level_finish(fr_level *level, size_t *ready)
{
    fr_nothing(ready);
    lv_arrays a;
    fr_status status = fr_ready(level, LEVEL_MAGIC);
    if (status == FR_OK && ready == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = check_queue(level, 0u);
    if (status != FR_OK)
        return status;
    (void)fr_lv_arrays(level, level, &a);
    derive_all(level, &a, 1);
    fr_lv_end_queue(level, &a);
    level->head.state = FR_STATE_ENDED;
    *ready = (size_t)(level->ready - level->taken);
    return FR_OK;
}

fr_status fr_level_take(fr_level *level, fr_level_bin *bins, size_t capacity, size_t *written)
{
    fr_nothing(written);
    lv_arrays a;
    fr_status status = fr_readable(level, LEVEL_MAGIC);
    if (status != FR_OK)
        return status;
    if (written == NULL || (capacity > 0u && bins == NULL))
        return FR_NULL_POINTER;
    (void)fr_lv_arrays(level, level, &a);
    *written = 0u;
    while (*written < capacity && level->taken < level->ready) {
        fr_lv_write_bin(level, &a.queue[level->taken], &bins[*written]);
        level->taken++;
        *written += 1u;
    }
    return FR_OK;
}
