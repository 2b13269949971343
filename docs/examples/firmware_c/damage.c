/* Sensors that are stuck or at the end of their range. */
#include "damage.h"

#include <math.h>

#include "holds.h"
#include "median.h"

static const double REST = 9.80665;
static const double OUTERMOST = 0.75 * 9.80665; /* least distance of an end of range from rest, in m/s^2 */
static const double HELD = 3.0;                 /* length of a stuck stretch, in usual holds */
static const double STEEP = 3.0;                /* slope of an end of range, not of a smooth peak, in quanta */
static const double CUT_OFF = 20.0;             /* the same for a noisy peak, in differences of steps */
static const double PINNED_S = 0.002, PINNED = 5.0, LEAP_M = 0.005;
static const double STUCK_S = 0.05, STUCK = 20.0, ALIVE = 0.1;
enum { SATURATED = 3, BESIDE = 250 };

static bool at_an_end(const struct hold *hold, const struct usual *usual)
{
    return hold->value == usual->least || hold->value == usual->greatest;
}

/* Append the differences of the steps between the samples from `first` up to `behind`. */
static long differences(struct window *values, long first, long behind, double *found, long count)
{
    for (long i = first; i + 2 < behind; i++) {
        double a = window_at(values, i), b = window_at(values, i + 1), c = window_at(values, i + 2);
        double difference = fabs((c - b) - (b - a));
        if (!isnan(difference))
            found[count++] = difference;
    }
    return count;
}

/* Whether the swing that a hold cuts off would continue; its slopes give the missing part. */
static bool goes_on(struct window *values, const struct hold *hold, double quantum)
{
    static double beside[2 * BESIDE];
    long first = hold->first, behind = first + hold->length;
    double step = fmin(hold->step_in, hold->step_out);
    long count = differences(values, first > BESIDE ? first - BESIDE : 0, first, beside, 0);
    long end = values->count - behind > BESIDE ? behind + BESIDE : values->count;
    count = differences(values, behind, end, beside, count);
    double uneven = fmax(quantum, median(beside, count));
    return step >= STEEP * quantum && step * (double)hold->length >= CUT_OFF * uneven;
}

bool damaged_force(struct channel *channel, struct failure *failure)
{
    struct usual usual = usual_of(&channel->values);
    struct holds holds = holds_of(&channel->values);
    struct hold hold;
    while (holds_next(&holds, &hold)) {
        if (hold.length < SATURATED || !at_an_end(&hold, &usual) ||
            (double)hold.length < HELD * usual.hold || fabs(hold.value - REST) < OUTERMOST ||
            !goes_on(&channel->ahead, &hold, usual.quantum))
            continue;
        if (!spans_add(&channel->lasting, hold.first, hold.first + hold.length, failure))
            return false;
    }
    return true;
}

/* The first sample from `time` on. */
static long index_from(struct channel *channel, double time)
{
    long low = 0, high = channel->values.count;
    if (channel->times.file == NULL)
        return (long)fmin(fmax(ceil((time - channel->start_s) * channel->rate_hz), 0.0),
                          (double)high);
    while (low < high) {
        long middle = low + (high - low) / 2;
        if (channel_time(channel, middle) < time)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Whether the accelerometer moves while the height is held; false if it is missing. */
static bool moves(struct channel *force, double begin_s, double end_s)
{
    double least = INFINITY, greatest = -INFINITY;
    long behind = index_from(force, end_s);
    for (long i = index_from(force, begin_s); i < behind; i++) {
        double value = window_at(&force->ahead, i);
        if (isnan(value))
            return false;
        least = fmin(least, value);
        greatest = fmax(greatest, value);
    }
    return greatest - least >= ALIVE;
}

bool damaged_height(struct channel *channel, struct channel *force, struct failure *failure)
{
    double rate = channel->mean_rate_hz;
    struct usual usual = usual_of(&channel->values);
    struct holds holds = holds_of(&channel->values);
    struct hold hold;
    while (holds_next(&holds, &hold)) {
        double length = (double)hold.length;
        long last = hold.first + hold.length - 1;
        if (length < fmax(SATURATED, floor(PINNED_S * rate)))
            continue;
        bool pinned = at_an_end(&hold, &usual) && length >= PINNED * usual.hold &&
                      fmax(hold.step_in, hold.step_out) >= LEAP_M;
        bool stuck = length >= fmax(STUCK_S * rate, STUCK * usual.hold);
        if (!pinned && stuck)
            stuck = moves(force, channel_time(channel, hold.first), channel_time(channel, last));
        if ((pinned || stuck) && !spans_add(&channel->gone, hold.first, last + 1, failure))
            return false;
    }
    return true;
}
