#include "track.h"

#include <string.h>

static const double GRAVITY = 9.80665;
static const double ANTI_ALIAS_HZ = 1000.0;
static const double LEAST_RATE_HZ = 4000.0; /* below this rate the sensors have to filter */

void track_open(struct track *track, double rate_hz)
{
    memset(track, 0, sizeof *track);
    track->anti_alias = rate_hz > LEAST_RATE_HZ;
    track->low_pass_c = track->anti_alias ? cutoff_to_c(ANTI_ALIAS_HZ, 1.0 / rate_hz) : 0;
    track->half_step = (real)(0.5 / rate_hz);
}

/* Both sensors lose the same below 1000 Hz; the height counts from its first sample. */
static void condition(struct track *track, real *acceleration, real *height)
{
    if (track->anti_alias) {
        real c = track->low_pass_c;
        *acceleration = low_pass_2(&track->force_low_2,
                                   low_pass_1(&track->force_low_1, *acceleration, c), c);
        *height = low_pass_2(&track->height_low_2,
                             low_pass_1(&track->height_low_1, *height, c), c);
    }
    if (!track->started)
        track->datum = *height;
    track->started = true;
    *height -= track->datum;
}

real track_step(struct track *track, double force, double height, real c)
{
    real a = (real)(force - GRAVITY), h = (real)height;
#if BROKEN == 1
    h = -h;
#endif
    condition(track, &a, &h);
    a = high_pass_1(&track->force_high, a, c);
    real v = integrate(&track->velocity, a, track->half_step);
    v = high_pass_2(&track->velocity_high, v, c);
    real r = integrate(&track->reference_height, v, track->half_step);
    h = high_pass_2(&track->height_high_2, high_pass_1(&track->height_high_1, h, c), c);
    return r - h;
}

void backward_passes(real *elevation, const real *speed, long count, double interval_m)
{
    struct high_pass_1 first = {0};
    struct high_pass_2 second = {0};
    for (long k = count - 1; k >= 0; k--) {
        real c = cutoff_to_c(cutoff_per_m((double)speed[k], interval_m), interval_m);
        elevation[k] = high_pass_1(&first, high_pass_2(&second, elevation[k], c), c);
    }
}
