/* The clocks of channels: looked through once before a run, and compared. */
#include <math.h>
#include <stdlib.h>

#include "window.h"

static const double JITTER = 0.01;       /* of a constant rate, in steps */
static const double ROUNDING_S = 2e-6;   /* time stamps may be rounded to microseconds */
static const double APART = 0.01;        /* clocks agree if their samples are nearer, in steps */
static const double HOLE = 5.0;          /* typical steps without a time stamp */
enum { MOST_DIGITS = 12, STEPS = WINDOW - 1 };

static int in_order(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* The median of the first steps. */
static double typical_step(struct window *times)
{
    static double steps[STEPS];
    long count = times->count - 1 < STEPS ? times->count - 1 : STEPS;
    if (count == 0)
        return INFINITY;
    for (long i = 0; i < count; i++)
        steps[i] = window_at(times, i + 1) - window_at(times, i);
    qsort(steps, (size_t)count, sizeof *steps, in_order);
    return steps[count / 2];
}

static bool check_stamps(struct channel *channel, struct failure *failure)
{
    double before = -INFINITY;
    for (long i = 0; i < channel->times.count; i++) {
        double time = window_at(&channel->times, i);
        if (!isfinite(time) || !(time > before))
            return fail(failure, "%s: time stamp %ld does not increase", channel->name, i);
        before = time;
    }
    return true;
}

/* Samples must be finite or NaN, at least half of them there, and a distance never go back. */
static bool check_samples(struct channel *channel, bool encoder, struct failure *failure)
{
    long missing = 0;
    double before = -INFINITY;
    for (long i = 0; i < channel->values.count; i++) {
        double value = window_at(&channel->values, i);
        if (isinf(value))
            return fail(failure, "%s: sample %ld is infinite", channel->name, i);
        if (encoder && value < before)
            return fail(failure, "%s: sample %ld goes back to %g m", channel->name, i, value);
        before = fmax(before, value);
        missing += isnan(value) ? 1 : 0;
    }
    if (2 * missing > channel->values.count)
        return fail(failure, "%s: %ld of %ld samples are missing", channel->name, missing,
                    channel->values.count);
    return true;
}

double channel_time(struct channel *channel, long index)
{
    if (channel->times.file != NULL)
        return window_at(&channel->times, index);
    return channel->start_s + (double)index / channel->rate_hz;
}

bool channel_open(struct channel *channel, const struct recording *recording,
                  const struct entry *entry, struct failure *failure)
{
    bool encoder = entry->quantity == DISTANCE;
    snprintf(channel->name, sizeof channel->name, "channel %s%s%s", entry->track,
             entry->track[0] == '\0' ? "" : ".", QUANTITY_NAMES[entry->quantity]);
    channel->times.file = channel->ahead.file = NULL;
    if (!window_open(&channel->values, recording->folder, entry->file, failure) ||
        !window_open(&channel->ahead, recording->folder, entry->file, failure) ||
        !check_samples(channel, encoder, failure))
        return false;
    double rate = channel->rate_hz = entry->rate_hz;
    channel->start_s = entry->start_s;
    if (entry->time_file[0] != '\0') {
        if (!window_open(&channel->times, recording->folder, entry->time_file, failure))
            return false;
        if (channel->times.count != channel->values.count)
            return fail(failure, "%s: %ld samples but %ld time stamps", channel->name,
                        channel->values.count, channel->times.count);
        if (!check_stamps(channel, failure))
            return false;
        long last = channel->times.count - 1;
        rate = (double)last / (channel_time(channel, last) - channel_time(channel, 0));
        channel->rate_hz = 0.0;
        channel->hole_s = encoder ? INFINITY : HOLE * typical_step(&channel->times);
    }
    channel->bridge_s = encoder ? 0.5 : 0.01;
    channel->bridge = isfinite(rate) ? (long)(channel->bridge_s * rate) : 0;
    channel->left = channel->right = -1;
    channel->stamp = 0;
    channel->same_grid = false;
    return true;
}

void channel_close(struct channel *channel)
{
    window_close(&channel->values);
    window_close(&channel->ahead);
    window_close(&channel->times);
}

/* The roundest rate at which the last of the time stamps is off by less than `allowed`. */
static double roundest(double rate, double span, double allowed)
{
    char text[40];
    for (int digits = 0; digits < MOST_DIGITS; digits++) {
        snprintf(text, sizeof text, "%.*e", digits, rate);
        double candidate = strtod(text, NULL);
        if (candidate > 0 && fabs(span - span * rate / candidate) <= allowed)
            return candidate;
    }
    return rate;
}

bool channel_steady(struct channel *channel, struct failure *failure)
{
    if (channel->times.file == NULL)
        return true;
    long last = channel->times.count - 1;
    double first = channel_time(channel, 0), end = channel_time(channel, last);
    double step = (end - first) / (double)last;
    double allowed = fmax(JITTER * step, ROUNDING_S) + 1e-15 * fmax(fabs(first), fabs(end));
    if (last == 0)
        return fail(failure, "%s: one sample is no stretch of time", channel->name);
    for (long i = 0; i <= last; i++)
        if (fabs(channel_time(channel, i) - first - step * (double)i) > allowed)
            return fail(failure, "%s: time stamp %ld is off a constant rate", channel->name, i);
    channel->rate_hz = roundest(1.0 / step, end - first, allowed);
    channel->start_s = first;
    channel->bridge = (long)(channel->bridge_s * channel->rate_hz);
    window_close(&channel->times);
    return true;
}

void channel_align(struct channel *channel, const struct channel *clock)
{
    double offset = (clock->start_s - channel->start_s) * channel->rate_hz;
    channel->same_grid = channel->times.file == NULL && channel->rate_hz == clock->rate_hz &&
                         fabs(offset - rint(offset)) < APART;
    channel->offset = channel->same_grid ? (long)rint(offset) : 0;
}
