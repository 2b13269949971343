/* SPDX-License-Identifier: Apache-2.0
 *
 * F of a node of the Kalman filter, forward and backward, for the fixed-lag machinery, and lambda
 * behind the end of a run.
 */
#include <math.h>
#include <string.h>

#include "kalman_backward.h"

enum { OWN_RENEWED = 0, OWN_SHIFT = 1, OWN_TRANSITION = 2 };

void fr_kalman_own(const fr_kalman_node *node, double *own)
{
    own[OWN_RENEWED] = (double)node->renewed;
    own[OWN_SHIFT] = node->shift;
    (void)memcpy(own + OWN_TRANSITION, &node->transition, sizeof node->transition);
}

static void take_transition(const double *own, fr_kalman_transition *transition)
{
    (void)memcpy(transition, own + OWN_TRANSITION, sizeof *transition);
}

static int renews(const double *own, int32_t state)
{
    return (int32_t)own[OWN_RENEWED] == state;
}

/* Lambda <- F' lambda, F with the states that begin anew. */
static void kalman_back(const double *own, double span, double *lambda)
{
    static const int32_t column[] = {FR_K_PITCH, FR_K_ROLL, FR_K_ROLL_BIAS, FR_K_PITCH_BIAS};
    double by_r, by_v, by_pitch = lambda[FR_K_PITCH], by_roll = lambda[FR_K_ROLL];
    fr_kalman_transition t;
    take_transition(own, &t);
    if (renews(own, FR_K_LEAN))
        lambda[FR_K_LEAN] = own[OWN_SHIFT] * lambda[FR_K_BIAS];
    if (renews(own, FR_K_OFFSET)) {
        lambda[FR_K_HEIGHT] -= lambda[FR_K_OFFSET];
        lambda[FR_K_OFFSET] = 0.0;
    }
    by_r = lambda[FR_K_HEIGHT];
    by_v = lambda[FR_K_VELOCITY];
    lambda[FR_K_VELOCITY] += span * by_r;
    lambda[FR_K_BIAS] += span * by_v + 0.5 * span * span * by_r;
    lambda[FR_K_LEAN] += by_r * t.height_lean + by_v * t.velocity_lean;
    lambda[FR_K_PITCH] = 0.0;
    lambda[FR_K_ROLL] = 0.0;
    for (int j = 0; j < FR_BY; j++)
        lambda[column[j]] += by_r * t.height[j] + by_v * t.velocity[j] + by_pitch * t.pitch[j] +
                             by_roll * t.roll[j];
}

/* F c of one column of Psi. */
static void kalman_forth_column(const double *own, const fr_kalman_transition *t, double span,
                                double *c)
{
    double out[4];
    fr_kalman_carry(t, span, c, out);
    (void)memcpy(c, out, sizeof out);
    if (renews(own, FR_K_LEAN)) {
        c[FR_K_BIAS] += own[OWN_SHIFT] * c[FR_K_LEAN];
        c[FR_K_LEAN] = 0.0;
    }
    if (renews(own, FR_K_OFFSET))
        c[FR_K_OFFSET] = -c[FR_K_HEIGHT];
}

/* Psi <- F Psi, F with the states that begin anew. */
static void kalman_forth(const double *own, double span, double *psi)
{
    fr_kalman_transition t;
    double c[FR_K_STATES];
    take_transition(own, &t);
    for (int k = 0; k < FR_K_STATES; k++) {
        for (int i = 0; i < FR_K_STATES; i++)
            c[i] = psi[i * FR_K_STATES + k];
        kalman_forth_column(own, &t, span, c);
        for (int i = 0; i < FR_K_STATES; i++)
            psi[i * FR_K_STATES + k] = c[i];
    }
}

fr_lag_model fr_kalman_lag_model(void)
{
    /* What later readings can show of the state at last: never the height but with GNSS's drift; at
     * a stop, the last row, also how far the height is from where the stop began. */
    static const double seen[] = {
        1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, /* height and drift */
        0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, /* velocity */
        0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, /* pitch */
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, /* roll */
        0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, /* bias of the acceleration */
        0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, /* of the roll rate */
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, /* of the pitch rate */
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, /* lean */
        1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, /* height and offset */
    };
    fr_lag_model model = {FR_K_STATES, FR_K_OWN, NULL, kalman_back, kalman_forth, seen,
                          (int32_t)(sizeof seen / sizeof *seen / FR_K_STATES)};
    return model;
}

/* The readings at the end of a run, one row of the equations each. */
typedef struct run_ending {
    double h[FR_K_KINDS][FR_K_STATES];
    double a[FR_K_KINDS][FR_K_KINDS + 1]; /* H P H' + R, and y - h(x) */
    int size;
} run_ending;

static void gather_ending(const fr_kalman_model *model, const fr_kalman_state *state,
                          const fr_kalman_observation *observed, run_ending *e)
{
    double h[FR_K_KINDS][FR_K_STATES], predicted[FR_K_KINDS];
    fr_kalman_linearize(model, state, h, predicted);
    predicted[FR_K_HEIGHT] -= state->captured;
    e->size = 0;
    for (int kind = 0; kind < FR_K_KINDS; kind++) {
        if (observed->y[kind] != observed->y[kind])
            continue;
        (void)memcpy(e->h[e->size], h[kind], sizeof h[kind]);
        e->a[e->size][FR_K_KINDS] = observed->y[kind] - predicted[kind];
        e->a[e->size][e->size] = observed->variance[kind];
        e->size++;
    }
}

static void fill_ending(const fr_kalman_state *state, run_ending *e)
{
    for (int i = 0; i < e->size; i++) {
        for (int j = 0; j < e->size; j++) {
            double total = i == j ? e->a[i][i] : 0.0;
            for (int k = 0; k < FR_K_STATES; k++)
                for (int m = 0; m < FR_K_STATES; m++)
                    total += e->h[i][k] * state->p[k][m] * e->h[j][m];
            e->a[i][j] = total;
        }
    }
}

/* Let the row of the largest number in column k be row k. */
static void pivot_ending(run_ending *e, int k)
{
    int best = k;
    for (int i = k + 1; i < e->size; i++)
        best = fabs(e->a[i][k]) > fabs(e->a[best][k]) ? i : best;
    for (int j = 0; j <= FR_K_KINDS; j++) {
        double kept = e->a[k][j];
        e->a[k][j] = e->a[best][j];
        e->a[best][j] = kept;
    }
}

/* Solve by elimination; the last column becomes the solution. */
static void solve_ending(run_ending *e)
{
    for (int k = 0; k < e->size; k++) {
        pivot_ending(e, k);
        for (int i = 0; i < e->size; i++) {
            double factor = i == k ? 0.0 : e->a[i][k] / e->a[k][k];
            for (int j = k; j <= FR_K_KINDS; j++)
                e->a[i][j] -= factor * e->a[k][j];
        }
    }
    for (int k = 0; k < e->size; k++)
        e->a[k][FR_K_KINDS] /= e->a[k][k];
}

void fr_kalman_beyond(const fr_kalman_model *model, const fr_kalman_state *state,
                      const fr_kalman_observation *observed, double *lambda)
{
    run_ending e;
    gather_ending(model, state, observed, &e);
    fill_ending(state, &e);
    solve_ending(&e);
    for (int j = 0; j < FR_K_STATES; j++) {
        lambda[j] = 0.0;
        for (int i = 0; i < e.size; i++)
            lambda[j] -= e.h[i][j] * e.a[i][FR_K_KINDS];
    }
}
