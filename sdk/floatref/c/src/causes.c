/* SPDX-License-Identifier: Apache-2.0
 *
 * Causes by which points are not valid: slow travel and braking, from the encoder, and what the
 * screening of the sensors gives, carried from samples to points.
 */
#include <math.h>

#include "points.h"

#define CAUSES_MAGIC FR_MAGIC(24)
#define MOST_CAUSES 127u
#define MOST_WINDOW 1e7
#define LASTING_CAUSES ((unsigned)FR_CAUSE_DRIFT | (unsigned)FR_CAUSE_SLOW | (unsigned)FR_CAUSE_BRAKING)

/* Counts of two windows and one more look, and the rises among them. */
typedef struct marks {
    uint32_t window, size, oldest, seen; /* looks */
    uint32_t steps;                      /* looks at which the distance had grown, of two windows */
    uint32_t every, until;               /* samples between looks, and until the next one */
    uint32_t now;                        /* the marks */
    double slow_m, stopping, metres_per_count;
} marks;

struct fr_causes {
    fr_head head;
    fr_points points;
    marks marks;
    uint32_t before, pending; /* causes of the sample before, and lasting ones since the last point */
};

fr_causes_config fr_causes_defaults(void)
{
    fr_causes_config config = {0.0, 0.0, 0.0, 4.4704, 5.0, 0.25, 1, 0};
    return config;
}

static double window_of_looks(const fr_causes_config *config)
{
    double looks = rint(config->window_s * (config->rate_hz / (double)config->every));
    return looks < 1.0 ? 1.0 : looks;
}

static int causes_are_possible(const fr_causes_config *config)
{
    return fr_above_zero(config->rate_hz) && config->every >= 1 &&
           fr_points_are_possible(config->interval_m, config->metres_per_count) &&
           fr_above_zero(config->slow_mps) && fr_above_zero(config->stopping_time_s) &&
           fr_above_zero(config->window_s) && window_of_looks(config) <= MOST_WINDOW &&
           config->reserved == 0;
}

static uint32_t looks_of(const fr_causes_config *config)
{
    return 2u * (uint32_t)window_of_looks(config) + 1u;
}

size_t fr_causes_size(const fr_causes_config *config)
{
    if (config == NULL || !causes_are_possible(config))
        return 0u;
    return fr_sized(FR_PADDED(fr_causes), looks_of(config), sizeof(int64_t));
}

static void set_marks(marks *m, const fr_causes_config *config)
{
    double looks = window_of_looks(config), window_s = looks * (double)config->every / config->rate_hz;
    m->window = (uint32_t)looks;
    m->size = looks_of(config);
    m->every = (uint32_t)config->every;
    m->slow_m = config->slow_mps * 2.0 * window_s;
    m->stopping = 2.0 * config->stopping_time_s / window_s;
    m->metres_per_count = config->metres_per_count;
}

fr_status fr_causes_init(void *memory, size_t size, const fr_causes_config *config, fr_causes **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_causes_size(config),
                                CAUSES_MAGIC);
    if (status != FR_OK)
        return status;
    *out = (fr_causes *)memory;
    set_marks(&(*out)->marks, config);
    fr_points_set(&(*out)->points, config->interval_m, config->metres_per_count);
    return FR_OK;
}

/* The count of a number of looks ago, 0 for the latest. */
static int64_t look_back(const marks *m, const int64_t *ring, uint32_t ago)
{
    uint32_t at = m->oldest + m->size - 1u - ago;
    return ring[at < m->size ? at : at - m->size];
}

/* Whether the distance had grown at a look; a missing count is smaller than any. */
static uint32_t grew(const marks *m, const int64_t *ring, uint32_t ago)
{
    int64_t now = look_back(m, ring, ago), before = look_back(m, ring, ago + 1u);
    return before != FR_NO_COUNT && now > before ? 1u : 0u;
}

static double metres_between(const marks *m, int64_t from, int64_t to)
{
    return (double)(to - from) * m->metres_per_count;
}

/* Whether braking is known: a distance that is held between counts has to lose two of them. */
static int is_braking(const marks *m, double before, double last)
{
    double steps = (double)m->steps;
    if (!(last + before < m->stopping * (before - last)))
        return 0;
    return m->steps > m->window || (before - last) * steps > 2.0 * (before + last);
}

static uint32_t marks_now(const marks *m, const int64_t *ring)
{
    int64_t now = look_back(m, ring, 0u), middle = look_back(m, ring, m->window);
    int64_t first = look_back(m, ring, 2u * m->window);
    double before, last;
    if (m->seen < m->size || now == FR_NO_COUNT || middle == FR_NO_COUNT || first == FR_NO_COUNT)
        return 0u;
    before = metres_between(m, first, middle);
    last = metres_between(m, middle, now);
    if (last + before < m->slow_m)
        return FR_CAUSE_SLOW;
    return is_braking(m, before, last) ? FR_CAUSE_BRAKING : 0u;
}

/* Take a look at every N-th sample: the first of the two windows leaves the ring as it comes. */
static void take_look(marks *m, int64_t *ring, int64_t count)
{
    if (m->until > 0u) {
        m->until--;
        return;
    }
    m->until = m->every - 1u;
    if (m->seen >= m->size)
        m->steps -= grew(m, ring, m->size - 2u);
    ring[m->oldest] = count;
    m->oldest = m->oldest + 1u < m->size ? m->oldest + 1u : 0u;
    m->seen += m->seen < m->size ? 1u : 0u;
    if (m->seen > 1u)
        m->steps += grew(m, ring, 0u);
    m->now = marks_now(m, ring);
}

static size_t run_causes(fr_causes *causes, const int64_t *counts, const uint8_t *of_samples,
                         size_t count, uint8_t *of_points)
{
    int64_t *ring = (int64_t *)FR_BEHIND(causes, fr_causes);
    fr_place_of_point place;
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        take_look(&causes->marks, ring, counts[i]);
        uint32_t here = causes->marks.now | (of_samples != NULL ? of_samples[i] : 0u);
        causes->pending |= here & LASTING_CAUSES;
        fr_points_begin(&causes->points, counts[i]);
        while (fr_points_reached(&causes->points, counts[i]) != 0) {
            fr_points_next(&causes->points, counts[i], &place);
            of_points[made] = (uint8_t)(here | causes->pending | (place.whole ? 0u : causes->before));
            causes->pending = 0u;
            made++;
        }
        fr_points_pass(&causes->points, counts[i]);
        causes->before = here;
    }
    return made;
}

/* Whether a sample has a bit that is no cause: fr_validity refuses it with the whole run. */
static int has_no_cause(const uint8_t *of_samples, size_t count)
{
    unsigned all = 0u;
    for (size_t i = 0; of_samples != NULL && i < count; i++)
        all |= of_samples[i];
    return all > MOST_CAUSES;
}

fr_status fr_causes_push(fr_causes *causes, const int64_t *counts, const uint8_t *of_samples,
                         size_t count, uint8_t *of_points, size_t capacity, size_t *written)
{
    fr_nothing(written);
    size_t needed = 0;
    fr_status status = fr_ready(causes, CAUSES_MAGIC);
    if (status == FR_OK)
        status = fr_room(0u, of_points, capacity, written);
    if (status == FR_OK)
        status = fr_check_known_counts(counts, count, FR_BACK_TAKEN,
                                       causes->points.started != 0 ? 0 : INT64_MIN);
    if (status == FR_OK && has_no_cause(of_samples, count))
        status = FR_BAD_SAMPLE;
    if (status == FR_OK)
        status = fr_points_needed(&causes->points, counts, count, &needed);
    if (status == FR_OK)
        status = fr_room(needed, of_points, capacity, written);
    if (status != FR_OK)
        return status;
    *written = run_causes(causes, counts, of_samples, count, of_points);
    return FR_OK;
}

fr_status fr_causes_finish(fr_causes *causes, uint8_t *of_points, size_t count)
{
    fr_status status = fr_ready(causes, CAUSES_MAGIC);
    if (status == FR_OK && count > 0u && of_points == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK && (count == 0u || (uint64_t)causes->points.next != count))
        status = FR_INCOMPLETE_SET;
    if (status != FR_OK)
        return status;
    of_points[count - 1u] = (uint8_t)(of_points[count - 1u] | causes->pending);
    causes->head.state = FR_STATE_ENDED;
    return FR_OK;
}
