/* The clocks of channels: read once before a run, and compared. */
#include <limits.h>
#include <math.h>

#include "window.h"

static const double APART = 0.01;     /* clocks agree if their samples are nearer, in steps */
static const double HOLE = 5.0;       /* typical steps without a time stamp */
static const double ROLLS_BACK_M = 1.0; /* from here on a reversed encoder is refused */
static const double LATEST_S = 1e12;

static bool check_stamps(struct channel *channel, struct failure *failure)
{
    double before = -INFINITY;
    for (long i = 0; i < channel->times.count; i++) {
        double time = window_at(&channel->times, i);
        if (!(fabs(time) <= LATEST_S))
            return fail(failure, "%s: time stamp %ld is %g s", channel->name, i, time);
        if (!(time > before))
            return fail(failure, "%s: time stamp %ld does not increase", channel->name, i);
        before = time;
    }
    return true;
}

/* Samples must be finite or NaN, at least half of them not missing; a distance must not go back. */
static bool check_samples(struct channel *channel, double largest, struct failure *failure)
{
    long missing = 0;
    double before = -INFINITY;
    for (long i = 0; i < channel->values.count; i++) {
        double value = window_at(&channel->values, i);
        if (isinf(value))
            return fail(failure, "%s: sample %ld is infinite", channel->name, i);
        if (fabs(value) > largest)
            return fail(failure, "%s: sample %ld is %g, beyond %g; check unit and offset",
                        channel->name, i, value, largest);
        if (channel->encoder && value < before - ROLLS_BACK_M)
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
    channel->encoder = encoder;
    if (!window_open(&channel->values, recording->folder, entry->file, failure) ||
        !window_open(&channel->ahead, recording->folder, entry->file, failure) ||
        !check_samples(channel, LARGEST[entry->quantity], failure))
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
    channel->mean_rate_hz = rate;
    channel->bridge_s = encoder ? 0.5 : 0.01;
    channel->bridge = (long)fmin(channel->bridge_s * rate, (double)channel->values.count);
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
    spans_free(&channel->gone);
    spans_free(&channel->lasting);
}

void channel_align(struct channel *channel, const struct clock *clock)
{
    double offset = (clock->start_s - channel->start_s) * channel->rate_hz;
    channel->same_grid = channel->times.file == NULL && channel->rate_hz == clock->rate_hz &&
                         fabs(offset) < (double)LONG_MAX && fabs(offset - rint(offset)) < APART;
    channel->offset = channel->same_grid ? (long)rint(offset) : 0;
}
