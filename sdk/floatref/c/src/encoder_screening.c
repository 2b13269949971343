/* SPDX-License-Identifier: Apache-2.0
 *
 * Screening of an encoder as its counts come: counts that lie behind, leap, are silent, too many or
 * lost. Constant memory; a count is judged when the next one is there.
 */
#include "encoder_judge.h"
#include "travel.h"

#define ENCODER_MAGIC FR_MAGIC(26)
#define MOST_APART 1e9
/* Spans that one count can end: the way to its knot, and what lay behind before it. */
#define SPANS_OF_COUNT 2u
/* Those at the end: of the last count, of the last knot, and of what lies behind. */
#define SPANS_OF_END 4u

struct fr_encoder_screening {
    fr_head head;
    fr_judge judge;
    fr_progress progress;
    int64_t index;  /* of the next count */
    int64_t ticks;  /* of the last one */
    int64_t held;   /* the count that waits for the next one */
    fr_moment when; /* of it; index -1 without one */
};

fr_encoder_screening_config fr_encoder_screening_defaults(void)
{
    fr_encoder_screening_config config = {0.0, 0.0, 0.0, 0.0, 0.025};
    return config;
}

static int encoder_is_possible(const fr_encoder_screening_config *config)
{
    return fr_above_zero(config->rate_hz) && fr_above_zero(1.0 / config->rate_hz) &&
           fr_above_zero(config->metres_per_count) && fr_finite(config->usual_m) &&
           config->usual_m >= 0.0 && fr_finite(config->off_m) && config->off_m >= 0.0 &&
           fr_above_zero(config->knot_s) && config->knot_s * config->rate_hz < MOST_APART;
}

size_t fr_encoder_screening_size(const fr_encoder_screening_config *config)
{
    return config != NULL && encoder_is_possible(config) ? sizeof(fr_encoder_screening) : 0u;
}

static void set_judge(fr_judge *judge, const fr_encoder_screening_config *config)
{
    judge->period_s = 1.0 / config->rate_hz;
    judge->metres_per_count = config->metres_per_count;
    judge->usual_m = config->usual_m > 0.0 ? config->usual_m : config->metres_per_count;
    judge->off_m = config->off_m > 0.0 ? config->off_m : judge->usual_m;
}

fr_status fr_encoder_screening_init(void *memory, size_t size,
                                    const fr_encoder_screening_config *config,
                                    fr_encoder_screening **out)
{
    fr_encoder_screening *s = (fr_encoder_screening *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_encoder_screening_size(config), ENCODER_MAGIC);
    if (status != FR_OK)
        return status;
    set_judge(&s->judge, config);
    s->progress.apart = config->knot_s * config->rate_hz;
    s->progress.usual = 1e300;
    s->progress.back = -1;
    s->when.index = -1;
    *out = s;
    return FR_OK;
}

/* Samples between two of a way; if there are none, the later one, on which the line depends. */
static size_t report_between(fr_span *spans, size_t made, fr_moment before, fr_moment after,
                             int32_t kind)
{
    int64_t first = before.index + 1, behind = after.index;
    return fr_report(spans, made, first, behind > first + 1 ? behind : first + 1, kind);
}

static size_t judge_knot(fr_encoder_screening *s, const fr_way *from, double hidden_m,
                         fr_span *spans, size_t made)
{
    const fr_way *way = &s->progress.last;
    int stalled = 0;
    int32_t kind = fr_judge_way(&s->judge, from, way, hidden_m, &stalled);
    if (kind == 0)
        return made;
    if (kind == FR_SILENT)
        return report_between(spans, made, way->front, way->step, kind);
    if (kind == FR_LEAPT)
        return fr_report(spans, made, way->before_step.index + 1, way->step.index + 1, kind);
    if (stalled)
        return report_between(spans, made, way->gap, way->behind_gap, kind);
    return fr_report(spans, made, from->at.index + 1, way->at.index + 1, kind);
}

/* What lay behind ends where a later count does not. */
static size_t close_back(fr_progress *p, int64_t index, fr_span *spans, size_t made)
{
    if (p->back < 0 || p->behind == index + 1)
        return made;
    size_t found = fr_report(spans, made, p->back, p->behind, FR_BACK);
    p->back = -1;
    return found;
}

/* A stretch that lies behind also ends at a missing count, so it is closed before a new one. */
static size_t take_count(fr_encoder_screening *s, int64_t after, fr_span *spans, size_t before)
{
    fr_progress *p = &s->progress;
    fr_way from;
    size_t made = before;
    if (p->back >= 0 && p->behind != s->when.index)
        made = close_back(p, s->when.index, spans, made);
    if (fr_progress_take(p, s->when, s->held, after, &from) != 0)
        made = judge_knot(s, &from, 0.0, spans, made);
    return close_back(p, s->when.index, spans, made);
}

static size_t run_encoder(fr_encoder_screening *s, const int64_t *counts, const int64_t *ticks,
                          size_t count, fr_span *spans)
{
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        /* Before a missing count none is known to return at once. */
        if (s->when.index >= 0)
            made = take_count(s, counts[i] != FR_NO_COUNT ? counts[i] : s->held, spans, made);
        s->ticks = ticks != NULL ? ticks[i] : s->index;
        s->held = counts[i];
        s->when.index = counts[i] != FR_NO_COUNT ? s->index : -1;
        s->when.tick = s->ticks;
        s->index++;
    }
    return made;
}

static fr_status push_counts(fr_encoder_screening *s, const int64_t *counts, const int64_t *ticks,
                             size_t count, fr_span *spans, size_t capacity, size_t *written)
{
    fr_status status = written == NULL ? FR_NULL_POINTER : FR_OK;
    if (status == FR_OK)
        status = fr_check_known_counts(counts, count, FR_BACK_TAKEN, 0);
    if (status == FR_OK && ticks != NULL)
        status = fr_check_counts(ticks, count, FR_BACK_REFUSED,
                                 s->index > 0 ? s->ticks : INT64_MIN);
    if (status == FR_OK)
        status = fr_room_for_spans(SPANS_OF_COUNT * count, spans, capacity, written);
    if (status == FR_OK)
        *written = run_encoder(s, counts, ticks, count, spans);
    return status;
}

fr_status fr_encoder_screening_push(fr_encoder_screening *screening, const int64_t *counts,
                                    size_t count, fr_span *spans, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(screening, ENCODER_MAGIC);
    if (status != FR_OK)
        return status;
    return push_counts(screening, counts, NULL, count, spans, capacity, written);
}

fr_status fr_encoder_screening_push_timed(fr_encoder_screening *screening, const int64_t *counts,
                                          const int64_t *ticks, size_t count, fr_span *spans,
                                          size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(screening, ENCODER_MAGIC);
    if (status == FR_OK && ticks == NULL)
        status = FR_NULL_POINTER;
    if (status != FR_OK)
        return status;
    return push_counts(screening, counts, ticks, count, spans, capacity, written);
}

fr_status fr_encoder_screening_finish(fr_encoder_screening *screening, fr_span *spans,
                                      size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(screening, ENCODER_MAGIC);
    fr_way from;
    size_t made = 0;
    if (status == FR_OK && written == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = fr_room_for_spans(SPANS_OF_END, spans, capacity, written);
    if (status != FR_OK)
        return status;
    if (screening->when.index >= 0)
        made = take_count(screening, screening->held, spans, made);
    made = close_back(&screening->progress, INT64_MAX - 1, spans, made);
    if (fr_progress_end(&screening->progress, &from) != 0)
        made = judge_knot(screening, &from, screening->judge.usual_m, spans, made);
    screening->head.state = FR_STATE_ENDED;
    *written = made;
    return FR_OK;
}
