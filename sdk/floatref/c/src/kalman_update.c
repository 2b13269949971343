/* SPDX-License-Identifier: Apache-2.0
 *
 * Nodes of the Kalman filter, and the updates by one scalar after the other, (6.13).
 */
#include <math.h>
#include <string.h>

#include "kalman.h"

/* Square of the innovation over S beyond which a reading may be wrong. */
#define GATE 100.0
/* This number of heights left out in a row is a leap of the datum, of this variance in m^2. */
#define BELIEVED_AT 20
#define LEAP_VARIANCE 1e4
/* Time constant of the running mean of the longitudinal specific force. */
#define RUNNING_S 1.0

/* What the readings of one sample are compared with. */
typedef struct expected_readings {
    double h[FR_K_KINDS][FR_K_STATES], predicted[FR_K_KINDS], prior[FR_K_STATES];
    double base; /* what the observed height is relative to */
} expected_readings;

/* Write P H' and return H P H'. */
static double project(double p[FR_K_STATES][FR_K_STATES], const double *h, double *projected)
{
    double spread = 0.0;
    for (int i = 0; i < FR_K_STATES; i++) {
        double total = 0.0;
        for (int j = 0; j < FR_K_STATES; j++)
            total += p[i][j] * h[j];
        projected[i] = total;
        spread += h[i] * total;
    }
    return spread;
}

/* Begin the lean anew, relative to the present specific force; return how far that moved. What the
 * lean made of this force so far becomes part of the acceleration's bias. */
static double forget(double variance, fr_kalman_state *s)
{
    double shift = s->running - s->level;
    s->level = s->running;
    s->x[FR_K_BIAS] += shift * s->x[FR_K_LEAN];
    for (int j = 0; j < FR_K_STATES; j++)
        s->p[FR_K_BIAS][j] += shift * s->p[FR_K_LEAN][j];
    for (int j = 0; j < FR_K_STATES; j++)
        s->p[j][FR_K_BIAS] += shift * s->p[j][FR_K_LEAN];
    s->x[FR_K_LEAN] = 0.0;
    for (int j = 0; j < FR_K_STATES; j++) {
        s->p[FR_K_LEAN][j] = 0.0;
        s->p[j][FR_K_LEAN] = 0.0;
    }
    s->p[FR_K_LEAN][FR_K_LEAN] = variance;
    return shift;
}

/* Let the offset be what the height is off by where a stop begins. */
static void clone(fr_kalman_state *s)
{
    s->x[FR_K_OFFSET] = 0.0;
    for (int j = 0; j < FR_K_STATES; j++)
        s->p[FR_K_OFFSET][j] = -s->p[FR_K_HEIGHT][j];
    for (int j = 0; j < FR_K_STATES; j++)
        s->p[j][FR_K_OFFSET] = -s->p[j][FR_K_HEIGHT];
}

/* Find what the observed height is relative to; adapt its prediction and its row of H. */
static void find_base(int32_t mark, fr_kalman_state *s, expected_readings *e)
{
    if ((mark & FR_K_CAPTURE) != 0)
        s->captured = e->predicted[FR_K_HEIGHT];
    if ((mark & FR_K_RENEW) != 0) {
        s->origin = s->x[FR_K_HEIGHT];
        clone(s);
    }
    e->base = 0.0;
    if ((mark & FR_K_REFLECTED) != 0) {
        e->predicted[FR_K_HEIGHT] = s->x[FR_K_HEIGHT] + s->x[FR_K_OFFSET];
        e->h[FR_K_HEIGHT][FR_K_PITCH] = 0.0;
        e->h[FR_K_HEIGHT][FR_K_ROLL] = 0.0;
        e->h[FR_K_HEIGHT][FR_K_OFFSET] = 1.0;
        e->base = s->origin;
    } else if ((mark & FR_K_RELATIVE) != 0) {
        e->base = s->captured;
    } else {
        e->predicted[FR_K_HEIGHT] += s->x[FR_K_DRIFT];
        e->h[FR_K_HEIGHT][FR_K_DRIFT] = 1.0;
    }
}

static void count_left_out(fr_kalman_state *s, int kind)
{
    if (s->left_out[kind] == 0)
        s->first_left_out[kind] = s->latest;
    s->left_out[kind]++;
}

/* Whether a reading may be right; heights that insist are another datum. */
static int is_plausible(fr_kalman_state *s, int kind, double innovation, double variance,
                        const double *h)
{
    /* Innovations up to here are taken, however small the filter expects them. */
    static const double floors[] = {0.2, 0.5, 0.05235987755982989, 0.05235987755982989};
    double projected[FR_K_STATES];
    double spread = project(s->p, h, projected) + variance;
    if (!(innovation * innovation > GATE * spread) || fabs(innovation) <= floors[kind]) {
        s->in_a_row = kind == FR_K_HEIGHT ? 0 : s->in_a_row;
        return 1;
    }
    if (kind == FR_K_HEIGHT && s->in_a_row + 1 >= BELIEVED_AT) {
        s->in_a_row = 0;
        s->p[FR_K_DRIFT][FR_K_DRIFT] += LEAP_VARIANCE;
        return 1;
    }
    s->in_a_row += kind == FR_K_HEIGHT ? 1 : 0;
    count_left_out(s, kind);
    return 0;
}

/* P <- (I - K H) P (I - K H)' + K R K', in the form of Joseph: unlike (I - K H) P it stays positive
 * and symmetric when K is rounded. */
static void join(double p[FR_K_STATES][FR_K_STATES], const double *gain, const double *projected,
                 const double *rest, double variance)
{
    for (int i = 0; i < FR_K_STATES; i++) {
        for (int j = i; j < FR_K_STATES; j++) {
            p[i][j] += gain[i] * variance * gain[j] - gain[i] * projected[j] - rest[i] * gain[j];
            p[j][i] = p[i][j];
        }
    }
}

/* X <- x + K (y - h), K = P H' / S. */
static void update_by(fr_kalman_state *s, const double *h, double innovation, double variance,
                      fr_kalman_update *out)
{
    double projected[FR_K_STATES], rest[FR_K_STATES];
    double total = project(s->p, h, projected) + variance;
    for (int i = 0; i < FR_K_STATES; i++) {
        double k = projected[i] / total, left = 0.0;
        s->x[i] += k * innovation;
        for (int j = 0; j < FR_K_STATES; j++)
            left += (s->p[i][j] - k * projected[j]) * h[j];
        out->gain[i] = k;
        rest[i] = left;
    }
    join(s->p, out->gain, projected, rest, variance);
    (void)memcpy(out->row, h, sizeof out->row);
    out->innovation = innovation / total;
    out->information = 1.0 / total;
}

/* The innovation of a later reading counts what the ones before have changed, so that the order is
 * of no matter. */
static double innovation_of(const fr_kalman_state *s, const expected_readings *e, double y,
                            int kind)
{
    double innovation = y - e->predicted[kind];
    innovation += kind == FR_K_HEIGHT ? e->base : 0.0;
    for (int j = 0; j < FR_K_STATES; j++)
        innovation -= e->h[kind][j] * (s->x[j] - e->prior[j]);
    return innovation;
}

void fr_kalman_observe(const fr_kalman_model *model, fr_kalman_state *state,
                       const fr_kalman_observation *observed, fr_kalman_node *node)
{
    expected_readings e;
    (void)memset(&e, 0, sizeof e);
    fr_kalman_linearize(model, state, e.h, e.predicted);
    find_base(observed->mark, state, &e);
    state->p[FR_K_DRIFT][FR_K_DRIFT] += observed->drifted;
    (void)memcpy(e.prior, state->x, sizeof e.prior);
    for (int kind = 0; kind < FR_K_KINDS; kind++) {
        double y = observed->y[kind], variance = observed->variance[kind], innovation;
        if (y != y)
            continue;
        node->observed++;
        innovation = innovation_of(state, &e, y, kind);
        if ((observed->mark & FR_K_TRUSTED) != 0 ||
            is_plausible(state, kind, innovation, variance, e.h[kind]) != 0) {
            update_by(state, e.h[kind], innovation, variance, &node->updates[node->updated]);
            node->updated++;
        }
    }
}

/* Keep the transition, and follow the longitudinal specific force. */
static void keep_transition(const fr_kalman_model *model, fr_kalman_state *s, fr_kalman_node *node)
{
    double span = s->steps * model->step;
    node->at = s->latest;
    node->transition = s->transition;
    node->span = span;
    node->shift = 0.0;
    node->rise = 0.0;
    node->climb = 0.0;
    node->renewed = 0;
    node->updated = 0;
    node->observed = 0;
    node->reserved = 0;
    if (span > 0.0) {
        double mean = s->transition.velocity_lean / span + s->level, share = span / RUNNING_S;
        s->running += (mean - s->running) * (share < 1.0 ? share : 1.0);
    }
}

static void observe_at(const fr_kalman_model *model, fr_kalman_state *s,
                       const fr_kalman_observation *observed, fr_kalman_node *node)
{
    int renews = (observed->mark & FR_K_RENEW) != 0, forgets = (observed->mark & FR_K_FORGET) != 0;
    if (forgets && !renews)
        node->shift = forget(model->lean, s);
    fr_kalman_observe(model, s, observed, node);
    node->renewed = forgets ? FR_K_LEAN : 0;
    if (renews)
        node->renewed = FR_K_OFFSET;
}

void fr_kalman_make_node(const fr_kalman_model *model, fr_kalman_state *state,
                         const fr_kalman_observation *observed, fr_kalman_node *node)
{
    double height = state->x[FR_K_HEIGHT], velocity = state->x[FR_K_VELOCITY];
    keep_transition(model, state, node);
    fr_kalman_predict(model, state);
    if (observed != NULL)
        observe_at(model, state, observed, node);
    node->rise = state->x[FR_K_HEIGHT] - height;
    node->climb = state->x[FR_K_VELOCITY] - velocity;
    fr_kalman_begin_sub_block(state);
}
