/* Scalar updates at a node: GNSS, constants in its place, the height at a stop. */
#include "kalman.h"

#include <math.h>
#include <string.h>

static const double GATE = 100.0;
static const int BELIEVED_AT = 20;

/* (6.48) into `y` and (C.8) into `h`, with the lever arm's forward part. */
static void linearize(const double *x, const double *arm, double w1, double w2, double w3,
                      double h[KINDS][STATES], double *y)
{
    double lx = arm[0], ly = arm[1], lz = arm[2];
    double st = sin(x[PITCH]), ct = cos(x[PITCH]), sp = sin(x[ROLL]), cp = cos(x[ROLL]);
    double q1 = w1 + x[ROLL_BIAS], q2 = w2 + x[PITCH_BIAS], q3 = w3;
    double up = sp * ly + cp * lz, side = cp * ly - sp * lz;
    double wx = q2 * lz - q3 * ly, wy = q3 * lx - q1 * lz, wz = q1 * ly - q2 * lx;
    double inclined = ct * sp, root = sqrt(1.0 - inclined * inclined);
    memset(h, 0, KINDS * sizeof *h);
    y[0] = x[R] - st * lx + ct * up;
    h[0][R] = 1.0;
    h[0][PITCH] = -ct * lx - st * up;
    h[0][ROLL] = ct * side;
    y[1] = x[V] - st * wx + ct * (sp * wy + cp * wz);
    h[1][V] = 1.0;
    h[1][PITCH] = -ct * wx - st * (sp * wy + cp * wz);
    h[1][ROLL] = ct * (cp * wy - sp * wz);
    h[1][ROLL_BIAS] = ct * side;
    h[1][PITCH_BIAS] = -st * lz - ct * cp * lx;
    y[2] = x[PITCH];
    h[2][PITCH] = 1.0;
    y[3] = asin(inclined);
    h[3][PITCH] = -st * sp / root;
    h[3][ROLL] = ct * cp / root;
}

static double project(double p[STATES][STATES], const double *h, double *ph)
{
    double spread = 0.0;
    for (int i = 0; i < STATES; i++) {
        double total = 0.0;
        for (int j = 0; j < STATES; j++)
            total += p[i][j] * h[j];
        ph[i] = total;
        spread += h[i] * total;
    }
    return spread;
}

/* Joseph form: P <- (I - K H) P (I - K H)' + K R K'. */
static void joseph(double p[STATES][STATES], const double *gain, const double *h, const double *ph,
                   double variance)
{
    double left[STATES];
    for (int i = 0; i < STATES; i++) {
        left[i] = 0.0;
        for (int j = 0; j < STATES; j++)
            left[i] += (p[i][j] - gain[i] * ph[j]) * h[j];
    }
    for (int i = 0; i < STATES; i++)
        for (int j = i; j < STATES; j++) {
            p[i][j] += gain[i] * variance * gain[j] - gain[i] * ph[j] - left[i] * gain[j];
            p[j][i] = p[i][j];
        }
}

/* Begin the lean anew, told from the present specific force; the bias of the acceleration takes
 * over what the lean made of that. */
static void forget(Filter *k, const Model *m, Node *node)
{
    double shift = k->running - k->level;
    k->level = k->running;
    k->x[BIAS] += shift * k->x[LEAN];
    for (int j = 0; j < STATES; j++)
        k->p[BIAS][j] += shift * k->p[LEAN][j];
    for (int j = 0; j < STATES; j++)
        k->p[j][BIAS] += shift * k->p[j][LEAN];
    k->x[LEAN] = 0.0;
    for (int j = 0; j < STATES; j++)
        k->p[LEAN][j] = k->p[j][LEAN] = 0.0;
    k->p[LEAN][LEAN] = m->lean;
    node->renewed = LEAN;
    node->shift = shift;
}

/* Let the offset be what the height is off by where a stop begins. */
static void begin_stop(Filter *k, Node *node)
{
    k->origin = k->x[R];
    k->x[OFFSET] = 0.0;
    for (int j = 0; j < STATES; j++)
        k->p[OFFSET][j] = -k->p[R][j];
    for (int j = 0; j < STATES; j++)
        k->p[j][OFFSET] = -k->p[j][R];
    node->renewed = OFFSET;
}

/* What the observed height is told from; adapts its prediction and its row of H. */
static double base_of(Filter *k, int mark, double *h, double *predicted, Node *node)
{
    if (mark & CAPTURE)
        k->captured = *predicted;
    if (mark & RENEW)
        begin_stop(k, node);
    if (mark & REFLECTED) {
        *predicted = k->x[R] + k->x[OFFSET];
        h[PITCH] = h[ROLL] = 0.0;
        h[OFFSET] = 1.0;
        return k->origin;
    }
    if (mark & RELATIVE)
        return k->captured;
    *predicted += k->x[DRIFT];
    h[DRIFT] = 1.0;
    return 0.0;
}

/* Whether a reading may be what it says; heights that insist are another datum. */
static int believed(Filter *k, const Model *m, int kind, double innovation, double total)
{
    if (innovation * innovation <= GATE * total || fabs(innovation) <= m->floor[kind]) {
        k->in_a_row = kind == 0 ? 0 : k->in_a_row;
        return 1;
    }
    if (kind > 0 || ++k->in_a_row < BELIEVED_AT)
        return 0;
    k->in_a_row = 0;
    k->p[DRIFT][DRIFT] += m->datum;
    return 1;
}

static void update_by(Filter *k, const double *h, double innovation, double variance,
                      Update *update)
{
    double ph[STATES], total = project(k->p, h, ph) + variance;
    for (int j = 0; j < STATES; j++) {
        update->h[j] = h[j];
        update->gain[j] = ph[j] / total;
        k->x[j] += update->gain[j] * innovation;
    }
    update->innovation = innovation / total;
    update->weight = 1.0 / total;
    joseph(k->p, update->gain, h, ph, variance);
}

/* Update by the observations of a row one after the other, linearized once, (6.13). */
int observe_at_node(Filter *k, const Model *m, const double *const u[6], int64_t i, int mark,
                    const double *row, Node *node, Update *updates)
{
    double h[KINDS][STATES], predicted[KINDS], prior[STATES], ph[STATES];
    int done = 0;
    if (mark & FORGET && !(mark & RENEW))
        forget(k, m, node);
    linearize(k->x, m->arm, u[3][i], u[4][i], u[5][i], h, predicted);
    double base = base_of(k, mark, h[0], &predicted[0], node);
    k->p[DRIFT][DRIFT] += row[2 * KINDS];
    memcpy(prior, k->x, sizeof prior);
    for (int kind = 0; kind < KINDS; kind++) {
        if (isnan(row[kind]))
            continue;
        double innovation = row[kind] + (kind == 0 ? base : 0.0) - predicted[kind];
        for (int j = 0; j < STATES; j++)
            innovation -= h[kind][j] * (k->x[j] - prior[j]);
        double variance = row[KINDS + kind];
        if (mark & TRUSTED ||
            believed(k, m, kind, innovation, project(k->p, h[kind], ph) + variance))
            update_by(k, h[kind], innovation, variance, &updates[done++]);
    }
    return done;
}
