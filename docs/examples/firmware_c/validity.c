#include "validity.h"

#include <math.h>

#include "drive.h"

const struct reach REACH = {105.91, 52.955, 15.0, 30.0, 30.0};

enum { SPOILT = 128 };

/* Mark the points from `before` points before to `after` points after a flag. */
static void spread(unsigned char *flags, long count, unsigned flag, long before, long after)
{
    long since = count, until = count;
    for (long k = 0; k < count; k++) {
        since = flags[k] & flag ? 0 : since + 1;
        if (since <= after)
            flags[k] |= SPOILT;
    }
    for (long k = count - 1; k >= 0; k--) {
        until = flags[k] & flag ? 0 : until + 1;
        if (until <= before)
            flags[k] |= SPOILT;
    }
}

static long points_in(double length_m, double interval_m, long count)
{
    return (long)rint(fmin(length_m / interval_m, (double)count));
}

void trust(unsigned char *flags, long count, double interval_m, const struct reach *reach)
{
    long drift = points_in(reach->drift_m, interval_m, count);
    long run_in = points_in(reach->run_in_m, interval_m, count);
    spread(flags, count, DRIFT, drift, drift);
    spread(flags, count, SLOW, points_in(reach->before_slow_m, interval_m, count),
           points_in(reach->after_slow_m, interval_m, count));
    spread(flags, count, BRAKING, 0, points_in(reach->after_braking_m, interval_m, count));
    for (long k = 0; k < count; k++) {
        bool inside = k >= run_in && k < count - run_in;
        flags[k] = inside && flags[k] == 0;
#if BROKEN == 3
        flags[k] = 1;
#endif
    }
}
