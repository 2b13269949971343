/* An encoder that goes back, is silent, leaps or loses counts. */
#include <math.h>

#include "damage.h"
#include "holds.h"

static const double FASTEST_MPS = 90.0, LEAP = 5.0; /* a larger step is a leap */
static const double SHORTEST_S = 0.02;              /* hold from which on it may be silent */
static const double LATE = 2.5;     /* travel made up after a silence, as a factor of the expected one */
static const double LOST_S = 0.05;  /* no vehicle stops within this time */
static const double MOVING_MPS = 2.5, COUNTS = 5.0, STANDING_S = 2.0;
static const double FASTEST_RATE_HZ = 1e6;

struct encoder {
    struct channel *channel;
    double usual_m; /* its usual step */
    double shortest;
    long lost;          /* LOST_S in samples */
    double reached;     /* the largest distance so far */
    long front;         /* the latest sample at that distance */
    struct hold before; /* the hold before the present one */
};

static double time_of(const struct encoder *encoder, long index)
{
    return channel_time(encoder->channel, index);
}

static long end_of(const struct hold *hold)
{
    return hold->first + hold->length;
}

/* Its progress beyond the largest distance so far; 0 after a missing sample. */
static double progress(const struct encoder *encoder, const struct hold *now)
{
    const struct hold *before = &encoder->before;
    bool known = before->length > 0 && end_of(before) == now->first;
    return known && now->value > encoder->reached ? now->value - encoder->reached : 0.0;
}

static void go_on(struct encoder *encoder, const struct hold *now)
{
    if (!(now->value < encoder->reached)) {
        encoder->reached = now->value;
        encoder->front = end_of(now) - 1;
    }
    encoder->before = *now;
}

/* Large steps have more weight, so that a fine encoder's slow travel has little. */
static double usual_step(struct encoder encoder)
{
    struct holds holds = holds_of(&encoder.channel->values);
    struct hold now;
    double sum = 0.0, squares = 0.0;
    while (holds_next(&holds, &now)) {
        double step = progress(&encoder, &now);
        sum += step;
        squares += step * step;
        go_on(&encoder, &now);
    }
    return sum > 0.0 ? squares / sum : 0.0;
}

/* Mean speed over LOST_S before a sample; NaN where it is not known. */
static double speed_before(const struct encoder *encoder, long index)
{
    struct window *values = &encoder->channel->ahead;
    long earlier = index > encoder->lost ? index - encoder->lost : 0;
    double elapsed = time_of(encoder, index) - time_of(encoder, earlier);
    return elapsed > 0.0 ? (window_at(values, index) - window_at(values, earlier)) / elapsed : NAN;
}

static bool makes_up(const struct encoder *encoder, const struct hold *silence,
                     const struct hold *now)
{
    double made_up = now->value - silence->value;
    double meanwhile = speed_before(encoder, silence->first) *
                       (time_of(encoder, now->first) - time_of(encoder, silence->first));
    return silence->length >= encoder->shortest && made_up > meanwhile / LATE &&
           made_up < meanwhile * LATE;
}

/* Whether for this hold the vehicle would have had to stop at once, and moves on later. */
static bool loses_counts(const struct encoder *encoder, const struct hold *hold)
{
    if (hold->length < encoder->shortest || end_of(hold) >= encoder->channel->values.count)
        return false;
    double lasted = time_of(encoder, end_of(hold)) - time_of(encoder, hold->first);
    double speed = speed_before(encoder, hold->first);
    return lasted >= LOST_S && lasted < STANDING_S && speed >= MOVING_MPS &&
           speed * LOST_S >= COUNTS * encoder->usual_m;
}

/* Judge the hold before, whose end is now known, and the step to this one. */
static bool judge(const struct encoder *encoder, const struct hold *now, struct failure *failure)
{
    struct spans *gone = &encoder->channel->gone, *lasting = &encoder->channel->lasting;
    const struct hold *before = &encoder->before;
    double step = progress(encoder, now), allowed = LEAP * encoder->usual_m;
    if (step > allowed)
        allowed += FASTEST_MPS * (time_of(encoder, now->first) - time_of(encoder, encoder->front));
    if (step > allowed && makes_up(encoder, before, now))
        return spans_add(gone, before->first + 1, now->first, failure);
    if (step > allowed)
        return spans_add(lasting, now->first, now->first + 1, failure);
    if (loses_counts(encoder, before) &&
        !spans_add(lasting, before->first + 1, end_of(before), failure))
        return false;
    return !(now->value < encoder->reached) ||
           spans_add(gone, now->first, end_of(now), failure);
}

bool damaged_distance(struct channel *channel, struct failure *failure)
{
    double rate = fmin(channel->mean_rate_hz, FASTEST_RATE_HZ);
    struct encoder encoder = {channel, 0.0, fmax(2.0, floor(SHORTEST_S * rate)),
                              (long)fmax(1.0, rint(LOST_S * rate)), NAN, 0,
                              {0, 0, 0.0, 0.0, 0.0}};
    struct holds holds = holds_of(&channel->values);
    struct hold now;
    encoder.usual_m = usual_step(encoder);
    while (holds_next(&holds, &now)) {
        if (!judge(&encoder, &now, failure))
            return false;
        go_on(&encoder, &now);
    }
    const struct hold *last = &encoder.before;
    return !loses_counts(&encoder, last) ||
           spans_add(&channel->lasting, last->first + 1, end_of(last), failure);
}
