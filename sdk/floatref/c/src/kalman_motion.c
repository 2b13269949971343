/* SPDX-License-Identifier: Apache-2.0
 *
 * The prediction from sample to sample, (6.47), and what it makes of small errors, (C.3).
 */
#include <math.h>
#include <string.h>

#include "kalman.h"

/* The mean inputs of a step, and what pitch and roll make of them. */
typedef struct body_turn {
    double ax, q1, q2, q3;
    double across, along, inverse, tangent;
    double by_pitch, by_roll; /* derivatives of the acceleration, (C.4) */
    double pitch, roll;       /* how far the body turns in the step */
} body_turn;

void fr_kalman_begin(fr_kalman_state *state, double height, double lean_rad)
{
    /* 1-sigma of the first state: height, velocity, pitch, roll, and biases, in SI units. */
    static const double sigma[] = {1.0, 1.0, 0.1, 0.1, 0.1, 0.01, 0.01};
    const int known = (int)(sizeof sigma / sizeof *sigma);
    (void)memset(state, 0, sizeof *state);
    state->x[FR_K_HEIGHT] = height;
    state->latest = -1;
    state->lost_until = -1;
    for (int i = 0; i < known; i++)
        state->p[i][i] = sigma[i] * sigma[i];
    state->p[FR_K_LEAN][FR_K_LEAN] = lean_rad * lean_rad;
}

void fr_kalman_begin_sub_block(fr_kalman_state *state)
{
    (void)memset(&state->transition, 0, sizeof state->transition);
    state->transition.pitch[FR_BY_PITCH] = 1.0;
    state->transition.roll[FR_BY_ROLL] = 1.0;
    state->sin_pitch = sin(state->x[FR_K_PITCH]);
    state->cos_pitch = cos(state->x[FR_K_PITCH]);
    state->sin_roll = sin(state->x[FR_K_ROLL]);
    state->cos_roll = cos(state->x[FR_K_ROLL]);
    state->steps = 0.0;
    state->by_pitch = 0.0;
    state->by_roll = 0.0;
}

int fr_kalman_ends_sub_block(const fr_kalman_model *model, const fr_kalman_state *state)
{
    return state->latest % model->sub_block == 0;
}

/* The inputs of a step are the means of both its ends, so that velocity and height are the
 * trapezoidal integrals of the acceleration. */
static body_turn body_turn_of(const fr_kalman_model *model, const fr_kalman_state *s,
                              const fr_kalman_input *u, double *rise)
{
    const fr_kalman_input *before = &s->input;
    double st = s->sin_pitch, ct = s->cos_pitch, sp = s->sin_roll, cp = s->cos_roll;
    double ay = 0.5 * (before->y + u->y), az = 0.5 * (before->z + u->z) + model->gravity, surge;
    body_turn t;
    t.ax = 0.5 * (before->x + u->x);
    t.q1 = 0.5 * (before->roll_rate + u->roll_rate) + s->x[FR_K_ROLL_BIAS];
    t.q2 = 0.5 * (before->pitch_rate + u->pitch_rate) + s->x[FR_K_PITCH_BIAS];
    t.q3 = 0.5 * (before->yaw_rate + u->yaw_rate);
    t.across = sp * ay + cp * az;
    t.along = sp * t.q2 + cp * t.q3;
    t.inverse = 1.0 / ct;
    t.tangent = st * t.inverse;
    t.by_pitch = -ct * t.ax - st * t.across;
    t.by_roll = ct * (cp * ay - sp * az);
    /* (6.27), (6.28) and (6.37), the latter with what an axis that leans forward feels. */
    t.pitch = (cp * t.q2 - sp * t.q3) * model->step;
    t.roll = (t.q1 + t.tangent * t.along) * model->step;
    surge = t.ax - s->level;
    *rise = ct * t.across - st * t.ax + s->x[FR_K_LEAN] * surge + s->x[FR_K_BIAS] - model->gravity;
    return t;
}

/* A <- A of the step times A, column by column. */
static void compose(fr_kalman_transition *a, const fr_kalman_state *s, const body_turn *t,
                    double step)
{
    double half = 0.5 * step * step, cp = s->cos_roll, sp = s->sin_roll;
    double a34 = -step * t->along, a43 = t->along * step * t->inverse * t->inverse;
    double a44 = 1.0 + t->pitch * t->tangent, surge = t->ax - s->level;
    for (int j = 0; j < FR_BY; j++) {
        double pitch = a->pitch[j], roll = a->roll[j];
        double e = t->by_pitch * pitch + t->by_roll * roll;
        a->height[j] = a->height[j] + step * a->velocity[j] + half * e;
        a->velocity[j] = a->velocity[j] + step * e;
        a->pitch[j] = pitch + a34 * roll;
        a->roll[j] = a44 * roll + a43 * pitch;
    }
    a->roll[FR_BY_ROLL_BIAS] += step;
    a->pitch[FR_BY_PITCH_BIAS] += cp * step;
    a->roll[FR_BY_PITCH_BIAS] += sp * t->tangent * step;
    a->height_lean = a->height_lean + step * a->velocity_lean + half * surge;
    a->velocity_lean = a->velocity_lean + step * surge;
}

/* Rotate a sine and a cosine by a small angle: a series of third order is exact to rounding for the
 * step of a sample, and far cheaper. They are computed anew at every node. */
static void rotate(double *sine, double *cosine, double angle)
{
    double even = 0.5 * angle * angle, odd = angle - angle * angle * angle * (1.0 / 6.0);
    double s = *sine, c = *cosine;
    *sine = s + (c * odd - s * even);
    *cosine = c - (s * odd + c * even);
}

static void move(const fr_kalman_model *model, fr_kalman_state *s, const body_turn *t, double rise)
{
    double step = model->step, half = 0.5 * step * step;
    compose(&s->transition, s, t, step);
    s->by_pitch += t->by_pitch;
    s->by_roll += t->by_roll;
    s->x[FR_K_HEIGHT] = s->x[FR_K_HEIGHT] + (step * s->x[FR_K_VELOCITY] + half * rise);
    s->x[FR_K_VELOCITY] = s->x[FR_K_VELOCITY] + step * rise;
    s->x[FR_K_PITCH] += t->pitch;
    s->x[FR_K_ROLL] += t->roll;
    rotate(&s->sin_pitch, &s->cos_pitch, t->pitch);
    rotate(&s->sin_roll, &s->cos_roll, t->roll);
    s->steps += 1.0;
}

/* Little is known behind a sample without acceleration, up to the end of its sub-block. */
static int64_t end_of_sub_block(const fr_kalman_model *model, int64_t sample)
{
    return (sample + model->sub_block - 1) / model->sub_block * model->sub_block;
}

void fr_kalman_advance(const fr_kalman_model *model, fr_kalman_state *state,
                       const fr_kalman_input *input, int lost)
{
    double rise = 0.0;
    if (state->started == 0) {
        fr_kalman_begin_sub_block(state);
        state->started = 1;
    } else {
        body_turn t = body_turn_of(model, state, input, &rise);
        move(model, state, &t, rise);
    }
    state->input = *input;
    state->latest++;
    if (lost != 0)
        state->lost_until = end_of_sub_block(model, state->latest);
}
