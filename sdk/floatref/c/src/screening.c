/* SPDX-License-Identifier: Apache-2.0
 *
 * Screening of one sensor as its samples come: gaps that a line does not bridge well, runs of
 * identical samples while the vehicle goes on and, where an accelerometer is beside it, moves, a
 * stay at an end of the range, and spikes.
 */
#include <math.h>

#include "watch.h"

#define SCREENING_MAGIC FR_MAGIC(13)
#define LEAST_RUN 2.0
#define LEAST_STAY 3.0
#define MOST_RUN 1e15
/* Above this rate an accelerometer's own bandwidth spreads a shock over several samples. */
#define SHOCK_SPREADS_HZ 1000.0

struct fr_screening {
    fr_head head;
    fr_watch_limits limits;
    fr_watch watch;
};

fr_screening_config fr_screening_defaults(void)
{
    fr_screening_config config = {0.0, 0.0, 0.01, 0.05,  20.0, 1.0,   0.5,
                                  0.1, 0.0, 0.0,  0.002, 5.0,  0.005, 0.0};
    return config;
}

/* The longer of a time and a number of usual holds, in samples. */
static double longer(const fr_screening_config *config, double time_s, double holds)
{
    double time = floor(time_s * config->rate_hz), held = holds * config->hold;
    return time > held ? time : held;
}

static int is_run(double samples)
{
    return samples >= LEAST_RUN && samples < MOST_RUN;
}

/* Both ends 0: they are not known. */
static int range_is_possible(const fr_screening_config *config)
{
    return fr_finite(config->range_least) && fr_finite(config->range_greatest) &&
           config->range_least <= config->range_greatest && fr_above_zero(config->stay_s) &&
           fr_above_zero(config->stay_holds) && fr_above_zero(config->leap) &&
           longer(config, config->stay_s, config->stay_holds) < MOST_RUN;
}

static int screening_is_possible(const fr_screening_config *config)
{
    return fr_above_zero(config->rate_hz) && fr_above_zero(config->metres_per_count) &&
           fr_above_zero(config->longest_gap_s) && fr_above_zero(config->stuck_s) &&
           fr_above_zero(config->holds) && fr_above_zero(config->hold) &&
           fr_above_zero(config->travel_m) && fr_finite(config->spread_mps2) &&
           config->spread_mps2 >= 0.0 && is_run(longer(config, config->stuck_s, config->holds)) &&
           config->longest_gap_s * config->rate_hz < MOST_RUN && range_is_possible(config) &&
           fr_finite(config->spike) && config->spike >= 0.0 &&
           (config->spike <= 0.0 || config->rate_hz >= SHOCK_SPREADS_HZ);
}

size_t fr_screening_size(const fr_screening_config *config)
{
    return config != NULL && screening_is_possible(config) ? sizeof(fr_screening) : 0u;
}

static void set_limits(fr_watch_limits *limits, const fr_screening_config *config)
{
    double stay = longer(config, config->stay_s, config->stay_holds);
    limits->longest_gap = config->longest_gap_s * config->rate_hz + 1.0;
    limits->shortest_run = longer(config, config->stuck_s, config->holds);
    limits->metres_per_count = config->metres_per_count;
    limits->travel_m = config->travel_m;
    limits->spread = config->spread_mps2;
    limits->range = config->range_least < config->range_greatest ? 1 : 0;
    /* As the samples are rounded, so that a sample at the end is at the end. */
    limits->least = (double)FR_R(config->range_least);
    limits->greatest = (double)FR_R(config->range_greatest);
    limits->shortest_stay = stay > LEAST_STAY ? stay : LEAST_STAY;
    limits->leap = config->leap;
    limits->spike = config->spike;
}

fr_status fr_screening_init(void *memory, size_t size, const fr_screening_config *config,
                            fr_screening **out)
{
    fr_screening *screening = (fr_screening *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_screening_size(config),
                                SCREENING_MAGIC);
    if (status != FR_OK)
        return status;
    set_limits(&screening->limits, config);
    screening->watch.gap = -1;
    screening->watch.run = -1;
    *out = screening;
    return FR_OK;
}

fr_status fr_screening_push(fr_screening *screening, const fr_real *x, const fr_real *force,
                            const int64_t *counts, size_t count, fr_span *spans, size_t capacity,
                            size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(screening, SCREENING_MAGIC);
    if (status == FR_OK && written == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = fr_check_samples(x, count, FR_MISSING_BRIDGED);
    if (status == FR_OK && (force != NULL || screening->limits.spread > 0.0))
        status = fr_check_samples(force, count, FR_MISSING_BRIDGED);
    if (status == FR_OK)
        status = fr_check_counts(counts, count, FR_BACK_TAKEN, INT64_MIN);
    if (status != FR_OK)
        return status;
    /* Once without writing, to see whether there is room: the state is small. */
    fr_watch ahead = screening->watch;
    size_t needed = fr_watch_samples(&screening->limits, &ahead, x, force, counts, count, NULL);
    status = fr_room_for_spans(needed, spans, capacity, written);
    if (status != FR_OK)
        return status;
    (void)fr_watch_samples(&screening->limits, &screening->watch, x, force, counts, count, spans);
    return FR_OK;
}

fr_status fr_screening_finish(fr_screening *screening, fr_span *spans, size_t capacity,
                              size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(screening, SCREENING_MAGIC);
    if (status == FR_OK && written == NULL)
        status = FR_NULL_POINTER;
    if (status != FR_OK)
        return status;
    fr_watch ahead = screening->watch;
    status = fr_room_for_spans(fr_watch_end(&screening->limits, &ahead, NULL), spans, capacity,
                               written);
    if (status != FR_OK)
        return status;
    (void)fr_watch_end(&screening->limits, &screening->watch, spans);
    screening->head.state = FR_STATE_ENDED;
    return FR_OK;
}
