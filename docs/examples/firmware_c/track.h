/* One wheel path: from force and height to elevation (section 5.7, figure 5.12). */
#ifndef TRACK_H
#define TRACK_H

#include "drive.h"

struct track {
    bool anti_alias;
    real low_pass_c, half_step, datum;
    struct low_pass_1 force_low_1, height_low_1;
    struct low_pass_2 force_low_2, height_low_2;
    struct high_pass_1 force_high, height_high_1;
    struct high_pass_2 velocity_high, height_high_2;
    struct integral velocity, reference_height;
    bool started;
};

/* Begin a run at `rate_hz`. */
void track_open(struct track *track, double rate_hz);

/* Take one sample, the force in m/s^2 and the height in m; return the elevation in m. */
real track_step(struct track *track, double force, double height, real c);

/* The backward passes over `count` points, in place, at the speed stored with each. */
void backward_passes(real *elevation, const real *speed, long count, double interval_m);

#endif
