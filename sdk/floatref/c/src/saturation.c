/* SPDX-License-Identifier: Apache-2.0
 *
 * An accelerometer at the end of its range: identical samples there that cut off a swing.
 *
 * The swing beside a run is looked at over as many samples as the run has. So the samples are
 * judged a constant number behind the last one, out of a ring.
 */
#include <math.h>

#include "spans.h"

#define SATURATION_MAGIC FR_MAGIC(25)
#define MOST_HOLD 4096.0
#define MOST_AHEAD (1 << 22)

/* Decision 0012. Fewest samples and holds of a run; fewest holds over which a swing is looked at; it
 * falls so many times farther than a peak that is flat by rounding; a run of so many holds is no
 * accident of noise, or the swing falls by so many usual ones, of so many holds to either side. */
enum { LEAST_SATURATED = 3, AROUND = 5, BESIDE = 250, SHORT_RUN = 12 };
#define HELD 3.0
#define STEEP 2.0
#define LONG_HOLDS 6.0
#define NOISY 8.0

struct fr_saturation {
    fr_head head;
    double hold, quantum, least, greatest;
    int64_t farthest; /* samples beside a run */
    int64_t ahead;    /* samples behind a place that are known when it is judged */
    int64_t size;     /* of the ring */
    int64_t taken;    /* samples */
    int64_t cursor;   /* the next one to judge_sample */
    int64_t run;      /* first sample_at of the one that is open, -1 without one */
    double value, drop; /* of the run; the fall_beside before it, known once it is long */
};

fr_saturation_config fr_saturation_defaults(void)
{
    fr_saturation_config config = {1.0, 0.0, 0.0, 0.0, 9.80665, 7.3549875, 1000, 0};
    return config;
}

static int64_t ahead_of(const fr_saturation_config *config)
{
    int64_t swing = (int64_t)(BESIDE + SHORT_RUN) * (int64_t)config->hold;
    return swing > config->farthest ? swing : config->farthest;
}

/* Samples before the longest run that is looked at whole, this run, and those behind it. */
static int64_t ring_of_saturation(const fr_saturation_config *config)
{
    int64_t shortest = (int64_t)(LONG_HOLDS * config->hold) + 1;
    return 2 * ahead_of(config) + (shortest > config->farthest ? shortest : config->farthest) + 1;
}

static int saturation_is_possible(const fr_saturation_config *config)
{
    return config->hold >= 1.0 && config->hold <= MOST_HOLD && fr_finite(config->quantum) &&
           config->quantum >= 0.0 && fr_finite(config->range_least) &&
           fr_finite(config->range_greatest) && config->range_least < config->range_greatest &&
           fr_finite(config->rest_mps2) && fr_above_zero(config->outermost_mps2) &&
           fr_one_of(config->farthest, 1, MOST_AHEAD) && config->reserved == 0;
}

size_t fr_saturation_size(const fr_saturation_config *config)
{
    if (config == NULL || !saturation_is_possible(config))
        return 0u;
    return FR_PADDED(fr_saturation) + (size_t)ring_of_saturation(config) * sizeof(fr_real);
}

fr_status fr_saturation_init(void *memory, size_t size, const fr_saturation_config *config,
                             fr_saturation **out)
{
    fr_saturation *s = (fr_saturation *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_saturation_size(config),
                                SATURATION_MAGIC);
    if (status != FR_OK)
        return status;
    double least = config->range_least, greatest = config->range_greatest;
    s->hold = config->hold;
    s->quantum = config->quantum;
    /* An end that is near rest is none: a vehicle at a standstill would be at it. */
    s->least = least <= config->rest_mps2 - config->outermost_mps2 ? (double)FR_R(least) : -HUGE_VAL;
    s->greatest =
        greatest >= config->rest_mps2 + config->outermost_mps2 ? (double)FR_R(greatest) : HUGE_VAL;
    s->farthest = config->farthest;
    s->ahead = ahead_of(config);
    s->size = ring_of_saturation(config);
    s->run = -1;
    *out = s;
    return FR_OK;
}

static double sample_at(const fr_saturation *s, int64_t index)
{
    const fr_real *ring = (const fr_real *)FR_BEHIND(s, fr_saturation);
    return (double)ring[index % s->size];
}

/* How far the samples from `first` up to `behind` fall_beside from the run; below zero without any. */
static double fall_beside(const fr_saturation *s, int64_t first, int64_t behind)
{
    double drop = -1.0;
    for (int64_t i = first; i < behind; i++)
        drop = fmax(drop, fabs(sample_at(s, i) - s->value));
    return drop;
}

static int64_t reach_of(const fr_saturation *s, int64_t length)
{
    int64_t held = AROUND * (int64_t)s->hold, own = length < s->farthest ? length : s->farthest;
    return own > held ? own : held;
}

static int64_t not_before(int64_t index, int64_t first)
{
    return index > first ? index : first;
}

/* Whether a fall_beside, 0 samples or more wide, is too small: a parabola that stays within a quantum for
 * as long as the run has fallen by as much beside it. */
static int is_flat(const fr_saturation *s, double drop, int64_t wide, int64_t length)
{
    double part = 1.0 + 2.0 * (double)wide / ((double)length - floor(s->hold));
    return drop >= 0.0 && drop < STEEP * s->quantum * part * part;
}

/* Bends of the samples around the line between those `reach` away: how many there are, how many of
 * these are up to a limit, the largest of these, and the smallest of the others. */
typedef struct bends {
    int64_t all, within;
    double below, above;
} bends;

static void count_bends(const fr_saturation *s, int64_t first, int64_t behind, int64_t reach,
                        double limit, bends *found)
{
    for (int64_t i = first; i + 2 * reach < behind; i++) {
        double bend = fabs(sample_at(s, i) - 2.0 * sample_at(s, i + reach) + sample_at(s, i + 2 * reach));
        if (!fr_finite(bend))
            continue;
        found->all++;
        if (bend <= limit) {
            found->within++;
            found->below = fmax(found->below, bend);
        } else {
            found->above = fmin(found->above, bend);
        }
    }
}

/* Whether the median of the bends beside is at most `limit`, by counting: no list is needed. */
static int is_calm(const fr_saturation *s, int64_t first, int64_t behind, int64_t reach,
                   double limit)
{
    int64_t far = (int64_t)BESIDE * (int64_t)s->hold + 2 * reach;
    int64_t end = behind + far < s->taken ? behind + far : s->taken;
    bends found = {0, 0, 0.0, HUGE_VAL};
    count_bends(s, not_before(first - far, 0), first, reach, limit, &found);
    count_bends(s, behind, end, reach, limit, &found);
    if (2 * found.within != found.all || found.all == 0)
        return 2 * found.within >= found.all;
    return 0.5 * (found.below + found.above) <= limit;
}

/* Whether the swing would go on beyond the run from `first` up to `behind`. */
static int goes_on(const fr_saturation *s, int64_t first, int64_t behind)
{
    int64_t length = behind - first, reach = reach_of(s, length);
    int64_t begin = not_before(first - reach, 0);
    int64_t end = behind + reach < s->taken ? behind + reach : s->taken;
    double before = length > s->farthest ? s->drop : fall_beside(s, begin, first);
    double after = fall_beside(s, behind, end);
    if (is_flat(s, before, first - begin, length) || is_flat(s, after, end - behind, length))
        return 0;
    if ((double)length >= LONG_HOLDS * floor(s->hold) || (before < 0.0 && after < 0.0))
        return 1;
    double drop = before < 0.0 ? after : (after < 0.0 ? before : fmin(before, after));
    return is_calm(s, first, behind, reach, drop / NOISY);
}

static size_t close_cut_off(fr_saturation *s, fr_span *spans, size_t made)
{
    int64_t first = s->run, length = s->cursor - first;
    s->run = -1;
    if (length < LEAST_SATURATED || (double)length < HELD * s->hold || !goes_on(s, first, s->cursor))
        return made;
    return fr_report(spans, made, first, s->cursor, FR_SATURATED);
}

/* Judge one sample_at: the run that it ends, continues or begins. */
static size_t judge_sample(fr_saturation *s, fr_span *spans, size_t made)
{
    double x = sample_at(s, s->cursor);
    size_t found = made;
    if (s->run >= 0 && x != s->value)
        found = close_cut_off(s, spans, made);
    if (s->run < 0 && (x <= s->least || x >= s->greatest)) {
        s->run = s->cursor;
        s->value = x;
    }
    s->cursor++;
    /* What lies before it leaves the ring now. */
    if (s->run >= 0 && s->cursor - s->run == s->farthest)
        s->drop = fall_beside(s, not_before(s->run - reach_of(s, s->farthest), 0), s->run);
    return found;
}

/* The most runs that end within `count` samples. */
static size_t most_spans(const fr_saturation *s, size_t count)
{
    size_t held = (size_t)(HELD * s->hold);
    return count / (held > LEAST_SATURATED ? held : LEAST_SATURATED) + 1u;
}

fr_status fr_saturation_push(fr_saturation *saturation, const fr_real *x, size_t count,
                             fr_span *spans, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(saturation, SATURATION_MAGIC);
    if (status == FR_OK && written == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = fr_check_samples(x, count, FR_MISSING_BRIDGED);
    if (status == FR_OK)
        status = fr_room_for_spans(most_spans(saturation, count), spans, capacity, written);
    if (status != FR_OK)
        return status;
    fr_real *ring = (fr_real *)FR_BEHIND(saturation, fr_saturation);
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        ring[saturation->taken % saturation->size] = x[i];
        saturation->taken++;
        if (saturation->taken - saturation->cursor > saturation->ahead)
            made = judge_sample(saturation, spans, made);
    }
    *written = made;
    return FR_OK;
}

fr_status fr_saturation_finish(fr_saturation *saturation, fr_span *spans, size_t capacity,
                               size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(saturation, SATURATION_MAGIC);
    if (status == FR_OK && written == NULL)
        status = FR_NULL_POINTER;
    if (status != FR_OK)
        return status;
    size_t rest = (size_t)(saturation->taken - saturation->cursor), made = 0;
    status = fr_room_for_spans(most_spans(saturation, rest) + 1u, spans, capacity, written);
    if (status != FR_OK)
        return status;
    while (saturation->cursor < saturation->taken)
        made = judge_sample(saturation, spans, made);
    if (saturation->run >= 0)
        made = close_cut_off(saturation, spans, made);
    saturation->head.state = FR_STATE_ENDED;
    *written = made;
    return FR_OK;
}
