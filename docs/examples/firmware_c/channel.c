#include "channel.h"

#include <math.h>

#include "window.h"

/* Sample `index`, NaN if it is missing or damaged. */
static double sound_at(struct channel *channel, struct window *window, long index)
{
    if (spans_hold(&channel->gone, index) || spans_hold(&channel->lasting, index))
        return NAN;
    return window_at(window, index);
}

/* Store the good samples on either side of the gap that contains sample `index`. */
static void find_gap(struct channel *channel, long index)
{
    struct window *ahead = &channel->ahead;
    channel->left = index - 1;
    while (channel->left >= 0 && isnan(sound_at(channel, ahead, channel->left)))
        channel->left--;
    channel->right = index + 1;
    while (channel->right < ahead->count && isnan(sound_at(channel, ahead, channel->right)))
        channel->right++;
}

static struct reading bridged(struct channel *channel, long index)
{
    if (!(channel->left < index && index < channel->right))
        find_gap(channel, index);
    long left = channel->left, right = channel->right;
    bool open = left < 0 || right >= channel->values.count;
    struct reading reading = {0.0, true, open || right - left - 1 > channel->bridge};
    double before = left < 0 ? 0.0 : window_at(&channel->ahead, left);
    double after = right >= channel->values.count ? before : window_at(&channel->ahead, right);
    if (left < 0)
        before = after;
    reading.value = before + (after - before) / (double)(right - left) * (double)(index - left);
    return reading;
}

struct reading channel_sample(struct channel *channel, long index)
{
    double value = sound_at(channel, &channel->values, index);
    if (!isnan(value))
        return (struct reading){value, false, false};
    struct reading reading = bridged(channel, index);
    if (spans_hold(&channel->lasting, index)) {
        reading.lost = true;
        reading.value = channel->encoder ? NAN : reading.value;
    }
    return reading;
}

/* The place of `time` in the channel, in samples. */
static double place_at(struct channel *channel, double time)
{
    long last = channel->values.count - 1;
    if (channel->times.file == NULL)
        return fmin(fmax((time - channel->start_s) * channel->rate_hz, 0.0), (double)last);
    while (channel->stamp < last && channel_time(channel, channel->stamp + 1) <= time)
        channel->stamp++;
    double before = channel_time(channel, channel->stamp);
    if (channel->stamp == last || time <= before)
        return (double)channel->stamp;
    double after = channel_time(channel, channel->stamp + 1);
    return (double)channel->stamp + (time - before) / (after - before);
}

void channel_rewind(struct channel *channel)
{
    channel->stamp = 0;
    channel->left = channel->right = -1;
}

struct reading channel_read(struct channel *channel, long index, double time)
{
    if (channel->same_grid)
        return channel_sample(channel, index + channel->offset);
    double place = place_at(channel, time), whole = floor(place);
    long before = (long)whole;
    struct reading reading = channel_sample(channel, before);
    if (place > whole) {
        struct reading after = channel_sample(channel, before + 1);
        reading.value += (place - whole) * (after.value - reading.value);
        reading.missing = reading.missing || after.missing;
        reading.lost = reading.lost || after.lost;
        if (channel->times.file != NULL) {
            double apart = channel_time(channel, before + 1) - channel_time(channel, before);
            reading.missing = reading.missing || apart > channel->hole_s;
            reading.lost = reading.lost || apart > fmax(channel->hole_s, channel->bridge_s);
        }
    }
    return reading;
}
