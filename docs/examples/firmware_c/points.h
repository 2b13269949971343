/* From time to distance: one point of the profile per interval of the encoder. */
#ifndef POINTS_H
#define POINTS_H

#include "drive.h"

/* The points of all wheel paths, the only memory that grows with a run. It is allocated once. */
struct points {
    double interval_m, start_m;
    long count, room;
    int tracks;
    real *speed;           /* m/s at each point */
    real **elevation;      /* m, by wheel path */
    unsigned char **flags; /* by wheel path */
    /* the sample before, and the lasting flags since the latest point */
    bool started;
    double distance_m, speed_before;
    real *elevation_before;
    unsigned *flags_before, *pending;
};

/* The data of one sample: elevations and flags by wheel path. */
struct sample {
    struct motion motion;
    const real *elevation;
    const unsigned *flags;
};

/* Allocate the memory for `length_m` of profile. */
bool points_open(struct points *points, int tracks, double interval_m, double length_m,
                 struct failure *failure);
void points_close(struct points *points);

/* Store the points that this sample reaches. */
void points_step(struct points *points, const struct sample *sample);

/* Give the last point the flags of the samples after it. */
void points_finish(struct points *points);

#endif
