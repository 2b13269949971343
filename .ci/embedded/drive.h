/* SPDX-License-Identifier: Apache-2.0
 *
 * A drive with stops on a road of waves, for the smoothers: whole micrometres and milliseconds, so
 * it has the same bits wherever it is computed.
 */
#ifndef DRIVE_H
#define DRIVE_H

#include "signals.h"

enum { PATHS = 2 };

typedef struct drive {
    uint32_t seed, rate;
    int32_t cruise_ms, stand_ms; /* 20 m/s before each brake, and the stop behind it */
    int64_t sample, path;        /* of the run, and travel in um times the rate */
    /* Of the next samples: one wheel path, both of them in turns, and other inputs of a unit. */
    fr_real force[MOST], height[MOST], forces[PATHS * MOST], heights[PATHS * MOST];
    double up[MOST], clearance[MOST], along[MOST], rate_of[MOST], speed[MOST], travel[MOST];
    double body; /* height in m at the last sample */
    int64_t counts[MOST]; /* of 1 mm */
} drive;

/* Elevation of the road in m at a travel in m, which is rounded to a micrometre. */
double drive_road(double travel);

/* Fill the arrays with the next `count` samples. */
void drive_next(drive *d, size_t count);

#endif
