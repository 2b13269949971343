/* SPDX-License-Identifier: Apache-2.0
 *
 * h(x) of (6.48) and its derivatives (C.8), with the lever arm's forward part.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "kalman.h"

/* The antenna seen from the reference point: its place, and its velocity as the body turns. */
typedef struct lever {
    double st, ct, sp, cp;
    double up, side, whirl[3];
    double inclined, root;
} lever;

static lever lever_of(const fr_kalman_model *model, const fr_kalman_state *s)
{
    double lx = model->arm[0], ly = model->arm[1], lz = model->arm[2];
    double q1 = s->input.roll_rate + s->x[FR_K_ROLL_BIAS];
    double q2 = s->input.pitch_rate + s->x[FR_K_PITCH_BIAS], q3 = s->input.yaw_rate;
    lever l;
    l.st = sin(s->x[FR_K_PITCH]);
    l.ct = cos(s->x[FR_K_PITCH]);
    l.sp = sin(s->x[FR_K_ROLL]);
    l.cp = cos(s->x[FR_K_ROLL]);
    l.up = l.sp * ly + l.cp * lz;
    l.side = l.cp * ly - l.sp * lz;
    l.whirl[0] = q2 * lz - q3 * ly;
    l.whirl[1] = q3 * lx - q1 * lz;
    l.whirl[2] = q1 * ly - q2 * lx;
    l.inclined = l.ct * l.sp;
    /* A body that lies on its side has no roll: a huge derivative in place of one by zero. */
    l.root = fmax(sqrt(1.0 - l.inclined * l.inclined), DBL_MIN);
    return l;
}

static void predict_readings(const fr_kalman_state *s, const lever *l, double lx, double *predicted)
{
    double whirl = l->ct * (l->sp * l->whirl[1] + l->cp * l->whirl[2]);
    predicted[FR_K_HEIGHT] = s->x[FR_K_HEIGHT] - l->st * lx + l->ct * l->up;
    predicted[FR_K_VELOCITY] = s->x[FR_K_VELOCITY] - l->st * l->whirl[0] + whirl;
    predicted[FR_K_PITCH] = s->x[FR_K_PITCH];
    predicted[FR_K_ROLL] = asin(l->inclined);
}

static void derive_height(const lever *l, double lx, double *h)
{
    h[FR_K_HEIGHT] = 1.0;
    h[FR_K_PITCH] = -l->ct * lx - l->st * l->up;
    h[FR_K_ROLL] = l->ct * l->side;
}

static void derive_velocity(const lever *l, double lx, double lz, double *h)
{
    h[FR_K_VELOCITY] = 1.0;
    h[FR_K_PITCH] = -l->ct * l->whirl[0] - l->st * (l->sp * l->whirl[1] + l->cp * l->whirl[2]);
    h[FR_K_ROLL] = l->ct * (l->cp * l->whirl[1] - l->sp * l->whirl[2]);
    h[FR_K_ROLL_BIAS] = l->ct * l->side;
    h[FR_K_PITCH_BIAS] = -l->st * lz - l->ct * l->cp * lx;
}

void fr_kalman_linearize(const fr_kalman_model *model, const fr_kalman_state *state,
                         double h[FR_K_KINDS][FR_K_STATES], double predicted[FR_K_KINDS])
{
    lever l = lever_of(model, state);
    (void)memset(h, 0, sizeof(double) * FR_K_KINDS * FR_K_STATES);
    predict_readings(state, &l, model->arm[0], predicted);
    derive_height(&l, model->arm[0], h[FR_K_HEIGHT]);
    derive_velocity(&l, model->arm[0], model->arm[2], h[FR_K_VELOCITY]);
    h[FR_K_PITCH][FR_K_PITCH] = 1.0;
    h[FR_K_ROLL][FR_K_PITCH] = -l.st * l.sp / l.root;
    h[FR_K_ROLL][FR_K_ROLL] = l.ct * l.cp / l.root;
}
