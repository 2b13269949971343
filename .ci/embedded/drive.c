/* SPDX-License-Identifier: Apache-2.0 */
#include "drive.h"

#define FAST 20000 /* mm/s */
#define BRAKE 8000 /* mm/s^2 */
#define RAMP_MS (1000 * FAST / BRAKE)
#define HEAVE 200000 /* um/s^2, to either side for half a second each */
#define GRAVITY 9806650
#define MICRO 1e-6

/* Within `most` of zero. */
static int64_t drawn(drive *d, int64_t most)
{
    d->seed = d->seed * 1664525u + 1013904223u;
    return ((int64_t)(d->seed >> 8) - 0x800000) * most / 0x800000;
}

/* A wave of lines between `most` and its negative. */
static int64_t wave(int64_t at, int64_t length, int64_t most)
{
    int64_t part = at % length, half = length / 2;
    int64_t up = part < half ? part : length - part;
    return 4 * most * up / length - most;
}

static int64_t road_um(int64_t at_um)
{
    return wave(at_um, 31000000, 5000) + wave(at_um, 7300000, 2000) + wave(at_um, 1100000, 300);
}

/* Speed in mm/s, and the acceleration in mm/s^2. */
static int64_t speed_of(const drive *d, int64_t ms, int64_t *along)
{
    int64_t left = ms % (d->cruise_ms + d->stand_ms + 2 * RAMP_MS) - d->cruise_ms;
    *along = 0;
    if (left < 0)
        return FAST;
    if (left < RAMP_MS) {
        *along = -BRAKE;
        return FAST - BRAKE * left / 1000;
    }
    left -= RAMP_MS + d->stand_ms;
    if (left < 0)
        return 0;
    *along = BRAKE;
    return BRAKE * left / 1000;
}

/* Height in um of a body that is lifted and lowered at a constant acceleration, in um/s^2. */
static int64_t heave_of(const drive *d, int64_t *lifted)
{
    int64_t half = (int64_t)d->rate / 2, at = d->sample % half, rate = (int64_t)d->rate;
    int64_t sign = d->sample / half % 2 == 0 ? 1 : -1;
    *lifted = -sign * HEAVE;
    return sign * HEAVE / 2 * at * (half - at) / (rate * rate);
}

static double micro(int64_t number)
{
    return (double)number * MICRO;
}

double drive_road(double travel)
{
    return micro(road_um((int64_t)(travel * 1e6)));
}

static void add_sample(drive *d, size_t i)
{
    int64_t along = 0, lifted = 0;
    int64_t speed = speed_of(d, d->sample * 1000 / (int64_t)d->rate, &along);
    int64_t heave = heave_of(d, &lifted), at_um;
    d->path += 1000 * speed;
    at_um = d->path / (int64_t)d->rate;
    /* It dives by 4 mrad for each m/s^2, so a part of the brake is felt. */
    int64_t felt = GRAVITY + lifted - along * along * 4 / 1000;
    for (size_t k = 0; k < PATHS; k++) {
        d->forces[PATHS * i + k] = (fr_real)micro(felt + drawn(d, 20000));
        d->heights[PATHS * i + k] = (fr_real)micro(250000 + heave - road_um(at_um) + drawn(d, 100));
    }
    d->force[i] = d->forces[PATHS * i];
    d->height[i] = d->heights[PATHS * i];
    d->up[i] = (double)d->force[i];
    d->clearance[i] = (double)d->height[i];
    d->along[i] = micro(1000 * along + drawn(d, 20000));
    d->rate_of[i] = micro(drawn(d, 1000));
    d->speed[i] = micro(1000 * speed);
    d->travel[i] = micro(at_um);
    d->body = micro(heave);
    d->counts[i] = at_um / 1000;
    d->sample++;
}

void drive_next(drive *d, size_t count)
{
    for (size_t i = 0; i < count; i++)
        add_sample(d, i);
}
