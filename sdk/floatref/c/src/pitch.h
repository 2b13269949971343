/* SPDX-License-Identifier: Apache-2.0
 *
 * The modelled pitch of the body: what its parts share. All of it is double in both builds.
 */
#ifndef FR_PITCH_H
#define FR_PITCH_H

#include "travel.h"

enum { PT_STATES = 10, PT_INPUTS = 3, PT_BODY = 4, PT_PATHS = 4, PT_ROWS = 2 * PT_PATHS };

#define PT_GRAVITY 9.80665

/* x' = A x + B u, and the accelerometer's reading H x + D u. States: heave and pitch, front and rear
 * wheel, the rates of these four, and the disturbing acceleration of each axle. Inputs: the road
 * under front and rear wheel in m, and the force along the road in m/s^2. Matrices lie row by row. */
typedef struct pt_car {
    double dynamics[PT_STATES * PT_STATES], inputs[PT_STATES * PT_INPUTS];
    double reading[PT_STATES], direct[PT_INPUTS];
} pt_car;

/* From reading to reading, with inputs that are linear in between. */
typedef struct pt_gains {
    double transition[PT_STATES * PT_STATES];
    double before[PT_STATES * PT_INPUTS], now[PT_STATES * PT_INPUTS];
    double rest[PT_BODY * PT_INPUTS]; /* coordinates at rest under constant inputs */
    double reading[PT_STATES], direct[PT_INPUTS];
    double filter[PT_STATES]; /* K */
    double spread[PT_STATES]; /* covariance of the pitch with the states, before a reading */
    double expected;          /* variance of a reading, in m^2/s^4 */
} pt_gains;

/* y = b x - a y of a section of second order, or of first with zeros. */
typedef struct pt_section {
    double b[3], a[3];
} pt_section;

typedef struct pt_band {
    pt_section slow[2], fast[2]; /* third-order Butterworth: high-pass, low-pass */
    double step_s;
} pt_band;

/* One path of a bin that is not complete; and the last bin before those stored that was known. */
typedef struct pt_mean {
    double sum, last;
    int32_t count, since; /* bins from the last known to the first stored; 0 if there is none */
} pt_mean;

struct fr_pitch {
    fr_head head;
    fr_pitch_config config;
    double step_s, furthest_m, counted;
    int64_t first_count, furthest;
    pt_gains gains;
    pt_band band;
    pt_mean mean[PT_ROWS]; /* forces of all paths, then heights */
    int32_t every, filled, reach, window, shared;
    int32_t stored;       /* bins */
    int32_t begun;        /* whether a window came before the stored bins */
    int32_t ready, taken; /* bins of the pitch */
};

/* Where its arrays lie: behind the object. All have room for a window and what it shares. */
typedef struct pt_arrays {
    double *row[PT_ROWS], *distance;
    double *force, *height, *along; /* of a window: means of the paths, the height within the band */
    double *pitch, *road, *measured;
    double *before, *bell; /* the pitch of the bins that two windows share */
} pt_arrays;

/* Add a sample to its bin; whether that is complete now. */
int fr_pt_add_sample(fr_pitch *pitch, pt_arrays *a, const fr_real *force, const fr_real *height,
                     int64_t count);
/* Means of the paths in `count` bins; whether force and height are known anywhere. */
int fr_pt_read_window(const fr_pitch *pitch, pt_arrays *a, int32_t count);
/* Let go of the first `count` bins. */
void fr_pt_drop_bins(fr_pitch *pitch, pt_arrays *a, int32_t count);

/* The usual half car on its axles. */
void fr_pt_set_car(pt_car *car, const fr_pitch_config *config);
void fr_pt_set_gains(pt_gains *gains, const pt_car *car, double step_s);
/* Solve a x = b, b of several columns, which gets x; `a` is lost. */
void fr_pt_solve(double *a, int32_t size, double *b, int32_t columns);

void fr_pt_set_band(pt_band *band, double step_s);
/* What is between both frequencies, filtered forward and backward. */
void fr_pt_pass_band(const pt_band *band, double *x, int32_t count);
/* The second integral of an acceleration, in the same band. */
void fr_pt_height_of(const pt_band *band, double *x, int32_t count);

/* The pitch of `count` bins of a window, in rad; 0 where something else moves the body. */
void fr_pt_model_window(const fr_pitch *pitch, pt_arrays *a, int32_t count);
/* One pass: states before each reading, and what the readings behind it add. Whether road and brakes
 * explain how the accelerometer moves. */
int fr_pt_smooth(const fr_pitch *pitch, const pt_arrays *a, int32_t count);

#endif
