/* SPDX-License-Identifier: Apache-2.0
 *
 * Screening of one sensor as its samples come: gaps that a line does not bridge well, and runs of
 * identical samples while the vehicle goes on and, where an accelerometer is beside it, moves.
 */
#include <math.h>

#include "travel.h"

#define SCREENING_MAGIC FR_MAGIC(13)
#define LEAST_RUN 2.0
#define MOST_RUN 1e15

typedef struct watch {
    int64_t index;              /* of the next sample */
    int64_t gap, run;           /* first sample of what is open, -1 if it is not */
    int64_t before, last;       /* counts before the run and at the last sample */
    fr_real value, least, most; /* of the run; readings of the accelerometer but the last one */
    fr_real reading;            /* the last one */
    int32_t unknown;            /* whether one of these is missing */
} watch;

struct fr_screening {
    fr_head head;
    double longest_gap, shortest_run, metres_per_count, travel_m, spread; /* lengths in samples */
    watch watch;
};

fr_screening_config fr_screening_defaults(void)
{
    fr_screening_config config = {0.0, 0.0, 0.01, 0.05, 20.0, 1.0, 0.5, 0.1};
    return config;
}

static double shortest_run(const fr_screening_config *config)
{
    double time = floor(config->stuck_s * config->rate_hz), holds = config->holds * config->hold;
    return time > holds ? time : holds;
}

size_t fr_screening_size(const fr_screening_config *config)
{
    int possible = config != NULL && fr_above_zero(config->rate_hz) &&
                   fr_above_zero(config->metres_per_count) && fr_above_zero(config->longest_gap_s) &&
                   fr_above_zero(config->stuck_s) && fr_above_zero(config->holds) &&
                   fr_above_zero(config->hold) && fr_above_zero(config->travel_m) &&
                   fr_finite(config->spread_mps2) && config->spread_mps2 >= 0.0 &&
                   shortest_run(config) >= LEAST_RUN && shortest_run(config) < MOST_RUN &&
                   config->longest_gap_s * config->rate_hz < MOST_RUN;
    return possible ? sizeof(fr_screening) : 0u;
}

fr_status fr_screening_init(void *memory, size_t size, const fr_screening_config *config,
                            fr_screening **out)
{
    fr_screening *screening = (fr_screening *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_screening_size(config),
                                SCREENING_MAGIC);
    if (status != FR_OK)
        return status;
    screening->longest_gap = config->longest_gap_s * config->rate_hz + 1.0;
    screening->shortest_run = shortest_run(config);
    screening->metres_per_count = config->metres_per_count;
    screening->travel_m = config->travel_m;
    screening->spread = config->spread_mps2;
    screening->watch.gap = -1;
    screening->watch.run = -1;
    *out = screening;
    return FR_OK;
}

/* Write a span, if there is an array, and count it. */
static size_t report(fr_span *spans, size_t made, int64_t first, int64_t behind, int32_t kind)
{
    if (spans != NULL) {
        spans[made].first = first;
        spans[made].behind = behind;
        spans[made].kind = kind;
        spans[made].reserved = 0;
    }
    return made + 1u;
}

/* A gap at an end of the channel has no neighbour there, so no line bridges it. */
static int is_long(const fr_screening *s, const watch *w, int at_end)
{
    return at_end || w->gap == 0 || (double)(w->index - w->gap) > s->longest_gap;
}

static int is_stuck(const fr_screening *s, const watch *w)
{
    double travel_m = (double)(w->last - w->before) * s->metres_per_count;
    double spread = (double)w->most - (double)w->least;
    if ((double)(w->index - w->run) < s->shortest_run || travel_m < s->travel_m)
        return 0;
    return s->spread <= 0.0 || (w->unknown == 0 && spread >= s->spread);
}

/* Close what the sample `x`, or the end, does not continue. */
static size_t close_spans(const fr_screening *s, watch *w, fr_real x, int at_end, fr_span *spans,
                          size_t before)
{
    size_t made = before;
    if (w->gap >= 0 && (at_end || !fr_missing(x))) {
        if (is_long(s, w, at_end))
            made = report(spans, made, w->gap, w->index, FR_GAP);
        w->gap = -1;
    }
    if (w->run >= 0 && (at_end || x != w->value)) {
        if (is_stuck(s, w))
            made = report(spans, made, w->run, w->index, FR_STUCK);
        w->run = -1;
    }
    return made;
}

/* Widen the run by the accelerometer's reading at its last sample: that of the end is left out. */
static void widen(watch *w)
{
    w->least = w->reading < w->least ? w->reading : w->least;
    w->most = w->reading > w->most ? w->reading : w->most;
    w->unknown = w->unknown != 0 || fr_missing(w->reading) ? 1 : 0;
}

static void take_sample(watch *w, fr_real x, fr_real force, int64_t count)
{
    if (fr_missing(x)) {
        w->gap = w->gap < 0 ? w->index : w->gap;
    } else if (w->run < 0) {
        w->run = w->index;
        w->before = w->index > 0 ? w->last : count;
        w->value = x;
        w->least = force;
        w->most = force;
        w->unknown = 0;
    } else {
        widen(w);
    }
    w->reading = force;
    w->last = count;
    w->index++;
}

static size_t screen(const fr_screening *s, watch *w, const fr_real *x, const fr_real *force,
                     const int64_t *counts, size_t count, fr_span *spans)
{
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        made = close_spans(s, w, x[i], 0, spans, made);
        take_sample(w, x[i], force != NULL ? force[i] : 0, counts[i]);
    }
    return made;
}

/* Refuse, or say how many spans there is room for. */
static fr_status room_for(size_t needed, const fr_span *spans, size_t capacity, size_t *written)
{
    *written = 0u;
    if (needed > 0u && spans == NULL)
        return FR_NULL_POINTER;
    *written = needed;
    return needed > capacity ? FR_OUTPUT_FULL : FR_OK;
}

fr_status fr_screening_push(fr_screening *screening, const fr_real *x, const fr_real *force,
                            const int64_t *counts, size_t count, fr_span *spans, size_t capacity,
                            size_t *written)
{
    fr_status status = fr_ready(screening, SCREENING_MAGIC);
    if (status == FR_OK && written == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = fr_check_samples(x, count, FR_MISSING_BRIDGED);
    if (status == FR_OK && (force != NULL || screening->spread > 0.0))
        status = fr_check_samples(force, count, FR_MISSING_BRIDGED);
    if (status == FR_OK)
        status = fr_check_counts(counts, count, FR_BACK_TAKEN, INT64_MIN);
    if (status != FR_OK)
        return status;
    /* Once without writing, to see whether there is room: the state is small. */
    watch ahead = screening->watch;
    size_t needed = screen(screening, &ahead, x, force, counts, count, NULL);
    status = room_for(needed, spans, capacity, written);
    if (status != FR_OK)
        return status;
    (void)screen(screening, &screening->watch, x, force, counts, count, spans);
    return FR_OK;
}

fr_status fr_screening_finish(fr_screening *screening, fr_span *spans, size_t capacity,
                              size_t *written)
{
    fr_status status = fr_ready(screening, SCREENING_MAGIC);
    if (status == FR_OK && written == NULL)
        status = FR_NULL_POINTER;
    if (status != FR_OK)
        return status;
    watch ahead = screening->watch;
    status = room_for(close_spans(screening, &ahead, 0, 1, NULL, 0u), spans, capacity, written);
    if (status != FR_OK)
        return status;
    (void)close_spans(screening, &screening->watch, 0, 1, spans, 0u);
    screening->head.state = FR_STATE_ENDED;
    return FR_OK;
}
