/* SPDX-License-Identifier: Apache-2.0
 *
 * The multi-rate extended Kalman filter of chapter 6 inside other objects: x at every sample, P at
 * every node. A node closes a sub-block of a hundredth of a second, or is a sample with
 * observations. The order of operations is that of the SDK's kernel.
 */
#ifndef FR_KALMAN_H
#define FR_KALMAN_H

#include "samples.h"

/* The states of (C.2): height, velocity, pitch, roll, the biases of acceleration, roll rate and
 * pitch rate. Then the lean of the vertical accelerometer's axis forward, the drift of the GNSS
 * height, and minus what the height is off by where a stop begins. Rows of H (C.8) have the numbers
 * of the first four states. */
enum {
    FR_K_HEIGHT = 0,
    FR_K_VELOCITY = 1,
    FR_K_PITCH = 2,
    FR_K_ROLL = 3,
    FR_K_BIAS = 4,
    FR_K_ROLL_BIAS = 5,
    FR_K_PITCH_BIAS = 6,
    FR_K_LEAN = 7,
    FR_K_DRIFT = 8,
    FR_K_OFFSET = 9,
    FR_K_STATES = 10,
    FR_K_KINDS = 4
};

/* Columns of a transition. */
enum { FR_BY_PITCH = 0, FR_BY_ROLL = 1, FR_BY_ROLL_BIAS = 2, FR_BY_PITCH_BIAS = 3, FR_BY = 4 };

/* Bits of a time of observation: the height is relative to the one captured; capture the antenna's
 * height; leave nothing out; the height is the reference point's, relative to where a stop began,
 * and has the offset; a stop begins; the lean is another from here on. */
enum {
    FR_K_RELATIVE = 1,
    FR_K_CAPTURE = 2,
    FR_K_TRUSTED = 4,
    FR_K_REFLECTED = 8,
    FR_K_RENEW = 16,
    FR_K_FORGET = 32
};

/* What stays the same during a run. */
typedef struct fr_kalman_model {
    double step, gravity;
    double arm[3]; /* from the reference point to the antenna, in m */
    double white, white_roll, white_pitch, white_yaw, walk, walk_roll, walk_pitch; /* Q of (C.5) */
    double lost_white; /* in place of `white` where the acceleration is missing */
    double lean;       /* variance of a lean that begins anew */
    int64_t sub_block; /* samples between two nodes without observations */
} fr_kalman_model;

/* u of (6.47) at a sample, the vertical component less 1 g. */
typedef struct fr_kalman_input {
    double x, y, z, roll_rate, pitch_rate, yaw_rate;
} fr_kalman_input;

/* Elements of A (C.3) multiplied up over steps. All others are those of a body in free fall. */
typedef struct fr_kalman_transition {
    double height[FR_BY], velocity[FR_BY], pitch[FR_BY], roll[FR_BY];
    double height_lean, velocity_lean;
} fr_kalman_transition;

/* The filter between two samples. */
typedef struct fr_kalman_state {
    double x[FR_K_STATES];
    double p[FR_K_STATES][FR_K_STATES];
    fr_kalman_transition transition; /* since the node before, as the three below */
    double steps, by_pitch, by_roll; /* steps, sums of the acceleration's derivatives */
    fr_kalman_input input;           /* of the latest sample */
    double sin_pitch, cos_pitch, sin_roll, cos_roll;
    double captured, origin; /* heights captured, and where a stop began */
    double level, running;   /* force from which the lean counts, and its running mean */
    int64_t latest, lost_until;
    int64_t left_out[FR_K_KINDS], first_left_out[FR_K_KINDS];
    int32_t started, in_a_row; /* heights left out in a row */
} fr_kalman_state;

/* What is observed at one sample: y of (6.48), NaN where there is no reading, the diagonal of R,
 * and the variance that the drift of the GNSS height gains. */
typedef struct fr_kalman_observation {
    double y[FR_K_KINDS], variance[FR_K_KINDS];
    double drifted;
    int32_t mark, reserved;
} fr_kalman_observation;

/* A scalar update: row of H, gain K, innovation over its variance S, and 1/S. */
typedef struct fr_kalman_update {
    double row[FR_K_STATES], gain[FR_K_STATES];
    double innovation, information;
} fr_kalman_update;

/* A node: its sample, how far its updates move height and velocity, the state that is another from
 * here on (0: no state), how much of a lean given up the bias of the acceleration takes over, the
 * transition over the time since the node before, and the updates. */
typedef struct fr_kalman_node {
    int64_t at;
    double rise, climb, shift, span;
    int32_t renewed, updated;
    int32_t observed; /* readings, with those that were left out */
    int32_t reserved;
    fr_kalman_transition transition;
    fr_kalman_update updates[FR_K_KINDS];
} fr_kalman_node;

/* Begin a run at a height in m; `lean_rad` is 1-sigma of the lean. */
void fr_kalman_begin(fr_kalman_state *state, double height, double lean_rad);

/* Predict x by (6.47) to the sample with this input, and compose A of (C.3); `lost` if the vertical
 * acceleration is missing there. */
void fr_kalman_advance(const fr_kalman_model *model, fr_kalman_state *state,
                       const fr_kalman_input *input, int lost);

/* Whether the latest sample ends a sub-block. */
int fr_kalman_ends_sub_block(const fr_kalman_model *model, const fr_kalman_state *state);

/* Make a node of the latest sample: predict P by (6.10), and update by (6.13) what is observed, or
 * nothing if that is NULL. */
void fr_kalman_make_node(const fr_kalman_model *model, fr_kalman_state *state,
                         const fr_kalman_observation *observed, fr_kalman_node *node);

/* Set the transition to I, the sums to 0, and sine and cosine anew. */
void fr_kalman_begin_sub_block(fr_kalman_state *state);

/* P <- A P A' + W Q W' over the steps since the last node, (6.10). */
void fr_kalman_predict(const fr_kalman_model *model, fr_kalman_state *state);

/* Write height, velocity, pitch and roll of A c; the other states stay as they are. */
void fr_kalman_carry(const fr_kalman_transition *transition, double span, const double *c,
                     double *out);

/* Write h(x) of (6.48) and H of (C.8) at the latest sample. */
void fr_kalman_linearize(const fr_kalman_model *model, const fr_kalman_state *state,
                         double h[FR_K_KINDS][FR_K_STATES], double predicted[FR_K_KINDS]);

/* Update by all readings of an observation, one after the other. */
void fr_kalman_observe(const fr_kalman_model *model, fr_kalman_state *state,
                       const fr_kalman_observation *observed, fr_kalman_node *node);

#endif
