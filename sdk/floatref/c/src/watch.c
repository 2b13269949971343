/* SPDX-License-Identifier: Apache-2.0
 *
 * Gaps, runs of identical samples, and spikes of one sample, each known when it has ended.
 */
#include <math.h>

#include "watch.h"

/* The neighbours of a spike differ by less than this share of it. */
#define ALONE FR_R(0.5)

/* A gap at an end of the channel has no neighbour there, so no line bridges it. */
static int is_long(const fr_watch_limits *limits, const fr_watch *w, int at_end)
{
    return at_end || w->gap == 0 || (double)(w->index - w->gap) > limits->longest_gap;
}

static int is_stuck(const fr_watch_limits *limits, const fr_watch *w)
{
    double travel_m = (double)(w->last - w->before) * limits->metres_per_count;
    double spread = (double)w->most - (double)w->least;
    if ((double)(w->index - w->run) < limits->shortest_run || travel_m < limits->travel_m)
        return 0;
    return limits->spread <= 0.0 || (w->unknown == 0 && spread >= limits->spread);
}

/* A sensor out of its range stays at an end of it, and gets there or back by a leap. */
static int is_out_of_range(const fr_watch_limits *limits, const fr_watch *w, fr_real step_out)
{
    double value = (double)w->value;
    int at_an_end = value <= limits->least || value >= limits->greatest;
    if (limits->range == 0 || !at_an_end || (double)(w->index - w->run) < limits->shortest_stay)
        return 0;
    return fabs((double)w->step) >= limits->leap || fabs((double)step_out) >= limits->leap;
}

/* Whether the last sample leaves both neighbours to one side, and these agree. */
static int is_spike(const fr_watch_limits *limits, const fr_watch *w, fr_real x)
{
    double up = (double)(w->x1 - w->x2), down = (double)(w->x1 - x);
    double off = fmin(fabs(up), fabs(down));
    if (limits->spike <= 0.0 || w->index < 2)
        return 0;
    return off > limits->spike && up * down > 0.0 && fabs((double)(x - w->x2)) < (double)ALONE * off;
}

static size_t close_run(const fr_watch_limits *limits, fr_watch *w, fr_real step_out,
                        fr_span *spans, size_t made)
{
    int32_t kind = is_out_of_range(limits, w, step_out) ? FR_OUT_OF_RANGE : FR_STUCK;
    int64_t first = w->run;
    int found = kind == FR_OUT_OF_RANGE || is_stuck(limits, w);
    w->run = -1;
    return found ? fr_report(spans, made, first, w->index, kind) : made;
}

static size_t close_gap(const fr_watch_limits *limits, fr_watch *w, int at_end, fr_span *spans,
                        size_t made)
{
    int64_t first = w->gap;
    int found = is_long(limits, w, at_end);
    w->gap = -1;
    return found ? fr_report(spans, made, first, w->index, FR_GAP) : made;
}

/* Widen the run by the accelerometer's reading at its last sample: that of the end is left out. */
static void widen(fr_watch *w)
{
    w->least = w->reading < w->least ? w->reading : w->least;
    w->most = w->reading > w->most ? w->reading : w->most;
    w->unknown = w->unknown != 0 || fr_missing(w->reading) ? 1 : 0;
}

static void begin_run(fr_watch *w, fr_real x, fr_real force, int64_t count)
{
    w->run = w->index;
    w->before = w->index > 0 ? w->last : count;
    w->value = x;
    w->step = w->index > 0 ? x - w->x1 : 0;
    w->least = force;
    w->most = force;
    w->unknown = 0;
}

static void watch_sample(fr_watch *w, fr_real x, fr_real force, int64_t count)
{
    if (fr_missing(x))
        w->gap = w->gap < 0 ? w->index : w->gap;
    else if (w->run < 0)
        begin_run(w, x, force, count);
    else
        widen(w);
    w->x2 = w->x1;
    w->x1 = x;
    w->reading = force;
    w->last = count;
    w->index++;
}

size_t fr_watch_samples(const fr_watch_limits *limits, fr_watch *w, const fr_real *x,
                        const fr_real *force, const int64_t *counts, size_t count, fr_span *spans)
{
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        if (is_spike(limits, w, x[i]))
            made = fr_report(spans, made, w->index - 1, w->index, FR_SPIKE);
        if (w->gap >= 0 && !fr_missing(x[i]))
            made = close_gap(limits, w, 0, spans, made);
        if (w->run >= 0 && x[i] != w->value)
            made = close_run(limits, w, x[i] - w->value, spans, made);
        watch_sample(w, x[i], force != NULL ? force[i] : 0, counts[i]);
    }
    return made;
}

size_t fr_watch_end(const fr_watch_limits *limits, fr_watch *w, fr_span *spans)
{
    size_t made = 0;
    if (w->gap >= 0)
        made = close_gap(limits, w, 1, spans, made);
    if (w->run >= 0)
        made = close_run(limits, w, 0, spans, made);
    return made;
}
