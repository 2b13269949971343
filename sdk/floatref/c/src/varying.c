/* SPDX-License-Identifier: Apache-2.0
 *
 * The high-pass sections at a cut-off that is given for every sample.
 *
 * In state-variable form the states are the band-pass and low-pass outputs of the analog prototype,
 * bp' = w hp and lp' = w bp, so a change of the cut-off does not change the removed part. The
 * recursion (A.9) keeps the slope of its output instead, and a backward pass that comes from a
 * stop, where the cut-off falls from one sample to the next, amplifies a step by that.
 */
#include "schedule.h"
#include "section.h"

#define VARYING_MAGIC FR_MAGIC(2)

struct fr_varying {
    fr_head head;
    fr_varying_config config;
    fr_tangent tangent;
    fr_section first, second;
};

fr_varying_config fr_varying_defaults(void)
{
    fr_varying_config config = {0.0,        FR_SECTION_12,      FR_RECURSION,
                                FR_FORWARD, FR_MISSING_REFUSED, FR_TANGENT_EXACT};
    return config;
}

static int varying_is_possible(const fr_varying_config *config)
{
    int one = config->sections == FR_SECTION_1 || config->sections == FR_SECTION_2;
    return fr_above_zero(config->step) && fr_one_of(config->sections, FR_SECTION_1, FR_SECTION_21) &&
           fr_one_of(config->form, FR_RECURSION, FR_STATES) &&
           (one || config->form == FR_RECURSION) &&
           fr_one_of(config->direction, FR_FORWARD, FR_BACKWARD) &&
           fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) &&
           fr_one_of(config->tangent, FR_TANGENT_EXACT, FR_TANGENT_SHORT);
}

size_t fr_varying_size(const fr_varying_config *config)
{
    return config != NULL && varying_is_possible(config) ? sizeof(fr_varying) : 0u;
}

fr_status fr_varying_init(void *memory, size_t size, const fr_varying_config *config,
                          fr_varying **out)
{
    fr_varying *filter = (fr_varying *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_varying_size(config),
                                VARYING_MAGIC);
    if (status != FR_OK)
        return status;
    filter->config = *config;
    filter->tangent = fr_tangent_of(config->step, config->tangent);
    *out = filter;
    return FR_OK;
}

/* Keep the sample and c, or those before where one is missing; return 1 at the first of both, 2
 * behind it, 0 before it. In state-variable form a sample starts the section only if both are
 * there. */
static int take_state(fr_section *s, fr_real x, fr_real c)
{
    int started = s->has_x;
    if (started == 0 && (fr_missing(x) || fr_missing(c)))
        return 0;
    s->has_x = 1;
    s->x = fr_missing(x) ? s->x : x;
    s->c = fr_missing(c) ? s->c : c;
    return started == 0 ? 1 : 2;
}

/* r is the state of the first-order section; r and t are those of the second-order one. */
static fr_real state_1(fr_section *s, fr_real x, fr_real c)
{
    int phase = take_state(s, x, c);
    fr_real high;
    if (phase == 0)
        return 0;
    if (phase == 1)
        s->r = s->c * s->x;
    high = (s->x - s->r) / (1 + s->c);
    s->r += 2 * s->c * high;
    return high;
}

static fr_real state_2(fr_section *s, fr_real x, fr_real c)
{
    int phase = take_state(s, x, c);
    fr_real ck = s->c, d = 1 / (1 + ck + ck * ck), high, band;
    if (phase == 0)
        return 0;
    if (phase == 1) {
        /* The second sample of (A.15) sees (x1, y1) twice; these two states are that past. */
        high = (1 + ck - 3 * ck * ck) * d * s->x;
        s->r = (2 * ck - 1) * high;
        s->t = s->x + (ck * ck - 2 * ck) * high;
        return high;
    }
    high = ((s->x - s->t) - (1 + ck) * s->r) * d;
    band = s->r + ck * high;
    s->r += 2 * ck * high;
    s->t += 2 * ck * band;
    return high;
}

static fr_real pass_varying(fr_varying *filter, fr_real x, fr_real c)
{
    int states = filter->config.form == FR_STATES;
    switch (filter->config.sections) {
    case FR_SECTION_1:
        return states ? state_1(&filter->first, x, c) : fr_section_1_any(&filter->first, x, c);
    case FR_SECTION_2:
        return states ? state_2(&filter->second, x, c) : fr_section_2_any(&filter->second, x, c);
    case FR_SECTION_12:
        return fr_section_12_any(&filter->first, &filter->second, x, c);
    default:
        return fr_section_21_any(&filter->second, &filter->first, x, c);
    }
}

/* Whether all sections have started: 1 and 2 are alone, the others are both. */
static int all_started(const fr_varying *filter)
{
    int first = fr_section_started(&filter->first), second = fr_section_started(&filter->second);
    if (filter->config.sections == FR_SECTION_1)
        return first;
    return filter->config.sections == FR_SECTION_2 ? second : first && second;
}

/* Samples that are all there, behind the start: copies of the states stay in registers, and which
 * sections they pass is decided once. `count` is a multiple of FR_GROUP. */
static void run_quickly(fr_varying *filter, const fr_real *x, const fr_real *cutoff, size_t count,
                        fr_real *y)
{
    fr_section first = filter->first, second = filter->second;
    fr_tangent tangent = filter->tangent;
    int backward = filter->config.direction == FR_BACKWARD;
    fr_real c[FR_GROUP];
#define FR_EACH(step)                                                                           \
    for (size_t done = 0; done < count; done += FR_GROUP) {                                     \
        size_t low = backward ? count - done - FR_GROUP : done;                                 \
        fr_tangents_here(&tangent, cutoff + low, FR_GROUP, c);                                  \
        for (size_t k = 0; k < FR_GROUP; k++) {                                                 \
            size_t i = fr_index(k, FR_GROUP, backward);                                         \
            y[low + i] = (step);                                                                \
        }                                                                                       \
    }
    if (filter->config.sections == FR_SECTION_1)
        FR_EACH(fr_section_1_step(&first, x[low + i], c[i]))
    else if (filter->config.sections == FR_SECTION_2)
        FR_EACH(fr_section_2_step(&second, x[low + i], c[i]))
    else if (filter->config.sections == FR_SECTION_12)
        FR_EACH(fr_section_12_step(&first, &second, x[low + i], c[i]))
    else
        FR_EACH(fr_section_21_step(&second, &first, x[low + i], c[i]))
#undef FR_EACH
    filter->first = first;
    filter->second = second;
}

static void run_carefully(fr_varying *filter, const fr_real *x, const fr_real *cutoff, size_t size,
                          fr_real *y)
{
    int backward = filter->config.direction == FR_BACKWARD;
    fr_real c[FR_BLOCK];
    fr_tangents(&filter->tangent, cutoff, size, c);
    for (size_t k = 0; k < size; k++) {
        size_t i = fr_index(k, size, backward);
        y[i] = pass_varying(filter, x[i], c[i]);
    }
}

static void run_varying(fr_varying *filter, const fr_real *x, const fr_real *cutoff, size_t count,
                        fr_real *y)
{
    int backward = filter->config.direction == FR_BACKWARD;
    int whole = filter->config.missing == FR_MISSING_REFUSED;
    size_t done = 0;
    while (done < count) {
        int quick = whole && filter->config.form == FR_RECURSION && all_started(filter) &&
                    count - done >= FR_GROUP;
        size_t most = count - done < FR_BLOCK ? count - done : FR_BLOCK;
        size_t size = quick ? (count - done) / FR_GROUP * FR_GROUP : most;
        size_t low = backward ? count - done - size : done;
        if (quick)
            run_quickly(filter, x + low, cutoff + low, size, y + low);
        else
            run_carefully(filter, x + low, cutoff + low, size, y + low);
        done += size;
    }
}

fr_status fr_varying_push(fr_varying *filter, const fr_real *x, const fr_real *cutoff, size_t count,
                          fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(filter, VARYING_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, y, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(x, count, filter->config.missing);
    if (status == FR_OK)
        status = fr_check_cutoffs(&filter->tangent, cutoff, count, filter->config.missing);
    if (status != FR_OK)
        return status;
    run_varying(filter, x, cutoff, count, y);
    *written = count;
    return FR_OK;
}
