/* SPDX-License-Identifier: Apache-2.0
 *
 * P from node to node, (6.10): between two nodes the linearized transitions of the samples are
 * composed into one, whose rows of the biases are trivial.
 */
#include <math.h>

#include "kalman.h"

/* Sums over the steps since the node: a disturbance of a state with m steps to go moves velocity by
 * m, and height by m squared over two, times its acceleration. */
typedef struct step_sums {
    double n, step, s1, s2, s3, s4;
} step_sums;

/* What pitch and roll make of the noise of the rates, (C.6), and of the walk of their biases. */
typedef struct turn_noise {
    double c33, c34, c44;
    double by_pitch, by_roll, to_pitch, to_roll;
    double both, cross_pitch, cross_roll;
} turn_noise;

void fr_kalman_carry(const fr_kalman_transition *t, double span, const double *c, double *out)
{
    double c3 = c[FR_K_PITCH], c4 = c[FR_K_ROLL], c6 = c[FR_K_ROLL_BIAS], c7 = c[FR_K_PITCH_BIAS];
    double rise = t->height[0] * c3 + t->height[1] * c4 + t->height[2] * c6;
    double climb = t->velocity[0] * c3 + t->velocity[1] * c4 + t->velocity[2] * c6;
    rise = rise + t->height[3] * c7 + t->height_lean * c[FR_K_LEAN];
    climb = climb + t->velocity[3] * c7 + t->velocity_lean * c[FR_K_LEAN];
    out[0] = c[FR_K_HEIGHT] + span * (c[FR_K_VELOCITY] + 0.5 * span * c[FR_K_BIAS]) + rise;
    out[1] = c[FR_K_VELOCITY] + span * c[FR_K_BIAS] + climb;
    out[2] = t->pitch[0] * c3 + t->pitch[1] * c4 + t->pitch[2] * c6 + t->pitch[3] * c7;
    out[3] = t->roll[0] * c3 + t->roll[1] * c4 + t->roll[2] * c6 + t->roll[3] * c7;
}

static step_sums step_sums_of(double n, double step)
{
    step_sums s;
    s.n = n;
    s.step = step;
    s.s1 = n * (n - 1.0) / 2.0 * step;
    s.s2 = (n - 1.0) * n * (2.0 * n - 1.0) / 6.0 * step * step;
    s.s3 = s.s1 * s.s1 * step;
    s.s4 = s.s2 * (3.0 * n * n - 3.0 * n - 1.0) / 5.0 * step * step;
    return s;
}

static turn_noise turn_noise_of(const fr_kalman_model *model, const fr_kalman_state *state)
{
    double st = sin(state->x[FR_K_PITCH]), ct = cos(state->x[FR_K_PITCH]);
    double sp = sin(state->x[FR_K_ROLL]), cp = cos(state->x[FR_K_ROLL]);
    double tangent = st / ct, step = model->step;
    double q1 = model->white_roll * step, q2 = model->white_pitch * step;
    double q3 = model->white_yaw * step;
    turn_noise s;
    s.by_pitch = state->by_pitch / state->steps;
    s.by_roll = state->by_roll / state->steps;
    s.c33 = cp * cp * q2 + sp * sp * q3;
    s.c34 = sp * cp * tangent * (q2 - q3);
    s.c44 = q1 + tangent * tangent * (sp * sp * q2 + cp * cp * q3);
    s.cross_pitch = s.by_pitch * s.c33 + s.by_roll * s.c34;
    s.cross_roll = s.by_pitch * s.c34 + s.by_roll * s.c44;
    s.both = s.by_pitch * s.cross_pitch + s.by_roll * s.cross_roll + model->walk * step;
    s.to_pitch = cp;
    s.to_roll = sp * tangent;
    return s;
}

static void add_white(double p[FR_K_STATES][FR_K_STATES], const turn_noise *c, const step_sums *s,
                      double white)
{
    double n = s->n, step = s->step;
    p[FR_K_HEIGHT][FR_K_HEIGHT] +=
        white * step * step * (n * n * n / 3.0 - n / 12.0) + c->both * s->s4 / 4.0;
    p[FR_K_HEIGHT][FR_K_VELOCITY] += white * n * n * step / 2.0 + c->both * s->s3 / 2.0;
    p[FR_K_VELOCITY][FR_K_VELOCITY] += white * n + c->both * s->s2;
    p[FR_K_HEIGHT][FR_K_PITCH] += c->cross_pitch * s->s2 / 2.0;
    p[FR_K_HEIGHT][FR_K_ROLL] += c->cross_roll * s->s2 / 2.0;
    p[FR_K_VELOCITY][FR_K_PITCH] += c->cross_pitch * s->s1;
    p[FR_K_VELOCITY][FR_K_ROLL] += c->cross_roll * s->s1;
}

/* `walk_1` and `walk_2` are those of the roll and the pitch rate's bias in a step. */
static void add_turning(double p[FR_K_STATES][FR_K_STATES], const turn_noise *c, const step_sums *s,
                        double walk_1, double walk_2)
{
    double n = s->n, s2 = s->s2;
    p[FR_K_PITCH][FR_K_PITCH] += c->c33 * n + walk_2 * s2 * c->to_pitch * c->to_pitch;
    p[FR_K_PITCH][FR_K_ROLL] += c->c34 * n + walk_2 * s2 * c->to_pitch * c->to_roll;
    p[FR_K_ROLL][FR_K_ROLL] += c->c44 * n + walk_2 * s2 * c->to_roll * c->to_roll + walk_1 * s2;
    p[FR_K_VELOCITY][FR_K_ROLL_BIAS] += walk_1 * c->by_roll * s2 / 2.0;
    p[FR_K_ROLL][FR_K_ROLL_BIAS] += walk_1 * s->s1;
    p[FR_K_ROLL_BIAS][FR_K_ROLL_BIAS] += walk_1 * n;
    p[FR_K_VELOCITY][FR_K_PITCH_BIAS] +=
        walk_2 * (c->by_pitch * c->to_pitch + c->by_roll * c->to_roll) * s2 / 2.0;
    p[FR_K_PITCH][FR_K_PITCH_BIAS] += walk_2 * s->s1 * c->to_pitch;
    p[FR_K_ROLL][FR_K_PITCH_BIAS] += walk_2 * s->s1 * c->to_roll;
    p[FR_K_PITCH_BIAS][FR_K_PITCH_BIAS] += walk_2 * n;
}

static void add_walk(double p[FR_K_STATES][FR_K_STATES], const step_sums *s, double walk)
{
    p[FR_K_HEIGHT][FR_K_BIAS] += walk * s->s2 / 2.0;
    p[FR_K_VELOCITY][FR_K_BIAS] += walk * s->s1;
    p[FR_K_BIAS][FR_K_BIAS] += walk * s->n;
}

/* Add W Q W' of all steps since the node, (C.5) and (C.6), to the upper half of P. */
static void add_process_noise(const fr_kalman_model *model, fr_kalman_state *state)
{
    double step = model->step;
    double white = state->lost_until >= state->latest ? model->lost_white : model->white;
    step_sums s = step_sums_of(state->steps, step);
    turn_noise c = turn_noise_of(model, state);
    add_white(state->p, &c, &s, white * step);
    add_turning(state->p, &c, &s, model->walk_roll * step, model->walk_pitch * step);
    add_walk(state->p, &s, model->walk * step);
}

void fr_kalman_predict(const fr_kalman_model *model, fr_kalman_state *state)
{
    double carried[4][FR_K_STATES], column[4];
    double span = state->steps * model->step;
    if (state->steps == 0.0)
        return;
    /* Column by column A P, then row by row (A P) A'. */
    for (int j = 0; j < FR_K_STATES; j++) {
        fr_kalman_carry(&state->transition, span, state->p[j], column);
        for (int i = 0; i < 4; i++)
            carried[i][j] = column[i];
    }
    for (int i = 0; i < 4; i++) {
        fr_kalman_carry(&state->transition, span, carried[i], state->p[i]);
        for (int j = 4; j < FR_K_STATES; j++)
            state->p[i][j] = carried[i][j];
    }
    add_process_noise(model, state);
    for (int i = 0; i < FR_K_STATES; i++)
        for (int j = 0; j < i; j++)
            state->p[i][j] = state->p[j][i];
}
