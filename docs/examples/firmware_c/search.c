#include "search.h"

#include <math.h>

#include "window.h"

static const double FARTHEST_COUNT = 2e15; /* beyond what an encoder counts, within int64_t */

struct view {
    struct channel *channel, *distance, *force;
    double metres_per_count, origin_m, latest_m; /* latest distance that is known */
};

static int64_t count_of(const struct view *view, double distance_m)
{
    double count = rint((distance_m - view->origin_m) / view->metres_per_count);
    return (int64_t)fmax(fmin(count, FARTHEST_COUNT), -FARTHEST_COUNT);
}

/* The latest sample of the accelerometer at a time; NaN before its first. */
static double force_at(struct channel *force, double time)
{
    long last = force->values.count - 1;
    while (force->stamp < last && channel_time(force, force->stamp + 1) <= time)
        force->stamp++;
    return channel_time(force, force->stamp) <= time ? window_at(&force->ahead, force->stamp) : NAN;
}

static void fill_counts(struct view *view, const struct channel *channel, long index, double value,
                        struct samples *samples)
{
    size_t k = samples->count;
    double time = channel_time(view->channel, index);
    if (channel != view->distance)
        value = channel_read(view->distance, 0, time).value;
    view->latest_m = isnan(value) ? view->latest_m : value;
    bool unknown = isnan(value) && channel == view->distance;
    samples->counts[k] = unknown ? FR_NO_COUNT : count_of(view, view->latest_m);
    samples->nanoseconds[k] = (int64_t)rint((time - channel_time(view->channel, 0)) * 1e9);
}

static void fill(struct view *view, long first, struct samples *samples)
{
    struct channel *channel = view->channel;
    samples->count = 0;
    for (long i = first; i < channel->values.count && samples->count < CHUNK; i++) {
        double value = window_at(&channel->values, i);
        fill_counts(view, channel, i, value, samples);
        samples->x[samples->count] = (fr_real)value;
        if (view->force != NULL)
            samples->force[samples->count] = (fr_real)force_at(view->force, channel_time(channel, i));
        samples->count++;
    }
}

/* What a stretch means for the channel; a gap is bridged anyway. */
static bool keep(struct channel *channel, enum quantity quantity, const fr_span *span,
                 struct failure *failure)
{
    bool lasting = span->kind == FR_SATURATED || span->kind >= FR_LEAPT;
    lasting = lasting || (span->kind == FR_STUCK && quantity == VERTICAL_SPECIFIC_FORCE);
    struct spans *spans = lasting ? &channel->lasting : &channel->gone;
    return span->kind == FR_GAP ||
           spans_add(spans, (long)span->first, (long)span->behind, failure);
}

static void rewind_all(struct view *view)
{
    channel_rewind(view->channel);
    channel_rewind(view->distance);
    if (view->force != NULL)
        channel_rewind(view->force);
}

static bool learn_all(struct view *view, struct sensor *sensor, struct failure *failure)
{
    static struct samples samples;
    fr_status status = FR_OK;
    long first = 0;
    do {
        fill(view, first, &samples);
        first += CHUNK;
        status = learn(sensor, &samples);
    } while (status == FR_OK && samples.count > 0);
    return status == FR_OK || fail(failure, "%s: %s", view->channel->name, fr_status_text(status));
}

static bool screen_all(struct view *view, struct sensor *sensor, struct failure *failure)
{
    static struct samples samples;
    static fr_span spans[MOST_SPANS];
    long first = 0;
    size_t found;
    do {
        fill(view, first, &samples);
        first += CHUNK;
        fr_status status = screen(sensor, &samples, spans, &found);
        if (status != FR_OK)
            return fail(failure, "%s: %s", view->channel->name, fr_status_text(status));
        for (size_t i = 0; i < found; i++)
            if (!keep(view->channel, sensor->quantity, &spans[i], failure))
                return false;
    } while (samples.count > 0);
    return true;
}

bool search(struct channel *channel, enum quantity quantity, struct channel *distance,
            struct channel *force, double metres_per_count, struct failure *failure)
{
    double origin_m = channel_read(distance, 0, channel_time(distance, 0)).value;
    struct view view = {channel, distance, force, metres_per_count, origin_m, origin_m};
    struct sensor sensor = {.quantity = quantity, .rate_hz = channel->mean_rate_hz,
                            .metres_per_count = metres_per_count};
    rewind_all(&view);
    if (!learn_all(&view, &sensor, failure))
        return false;
    if (quantity == VERTICAL_SPECIFIC_FORCE && !(sensor.values.least < sensor.values.greatest))
        return fail(failure, "%s: every sample is %g, so it measures nothing; check the cable",
                    channel->name, sensor.values.least);
    rewind_all(&view);
    bool done = screen_all(&view, &sensor, failure);
    spans_settle(&channel->gone);
    spans_settle(&channel->lasting);
    rewind_all(&view);
    return done;
}
