/* The forward pass: states at every sample, covariance at every node. */
#include "kalman.h"

#include <math.h>
#include <string.h>

static const double RUNNING_S = 1.0;
const int COLUMN[COLUMNS] = {PITCH, ROLL, ROLL_BIAS, PITCH_BIAS};

void begin_filter(Filter *k, const Model *m)
{
    memset(k, 0, sizeof *k);
    for (int i = 0; i < STATES; i++) {
        k->x[i] = m->start[i];
        k->p[i][i] = m->variance[i];
    }
}

/* Copy the transition, and follow the longitudinal specific force. */
void keep_transition(Filter *k, const Model *m, Node *node)
{
    double span = (double)k->steps * m->step;
    memset(node, 0, sizeof *node);
    node->f = k->f;
    if (span > 0.0) {
        double mean = k->f.v_lean / span + k->level;
        k->running += (mean - k->running) * fmin(1.0, span / RUNNING_S);
    }
}

void begin_sub_block(Filter *k)
{
    memset(&k->f, 0, sizeof k->f);
    k->f.pitch[0] = k->f.roll[1] = 1.0;
    k->by_pitch = k->by_roll = 0.0;
    k->steps = 0;
    for (int j = 0; j < 2; j++) {
        k->sine[j] = sin(k->x[PITCH + j]);
        k->cosine[j] = cos(k->x[PITCH + j]);
    }
}

static inline void rotate(double *sine, double *cosine, double angle)
{
    double even = 0.5 * angle * angle, odd = angle - angle * angle * angle * (1.0 / 6.0);
    double s = *sine, c = *cosine;
    *sine = s + (c * odd - s * even);
    *cosine = c - (s * odd + c * even);
}

/* (6.47) with the mean of both ends as the input of a step, and (C.3) composed. */
void advance_states(Filter *k, const Model *m, const double *const u[6], int64_t begin,
                    int64_t end, double *restrict height)
{
    const double step = m->step, half = 0.5 * step * step;
    const double *restrict fx = u[0], *restrict fy = u[1], *restrict fz = u[2];
    const double *restrict wx = u[3], *restrict wy = u[4], *restrict wz = u[5];
    Transition f = k->f;
    double r = k->x[R], v = k->x[V], pitch = k->x[PITCH], roll = k->x[ROLL];
    double bias = k->x[BIAS], bias_1 = k->x[ROLL_BIAS], bias_2 = k->x[PITCH_BIAS];
    double lean = k->x[LEAN], level = k->level, sum_3 = k->by_pitch, sum_4 = k->by_roll;
    double st = k->sine[0], ct = k->cosine[0], sp = k->sine[1], cp = k->cosine[1];
    double x0 = k->input[0], y0 = k->input[1], z0 = k->input[2];
    double p0 = k->input[3], q0 = k->input[4], w0 = k->input[5];

    for (int64_t i = begin; i < end; i++) {
        double ax = 0.5 * (x0 + fx[i]), ay = 0.5 * (y0 + fy[i]);
        double az = 0.5 * (z0 + fz[i]) + m->gravity, surge = ax - level;
        double q1 = 0.5 * (p0 + wx[i]) + bias_1, q2 = 0.5 * (q0 + wy[i]) + bias_2;
        double q3 = 0.5 * (w0 + wz[i]);
        x0 = fx[i], y0 = fy[i], z0 = fz[i], p0 = wx[i], q0 = wy[i], w0 = wz[i];
        double across = sp * ay + cp * az, along = sp * q2 + cp * q3;
        double inverse = 1.0 / ct, tangent = st * inverse;
        double by_3 = -ct * ax - st * across, by_4 = ct * (cp * ay - sp * az);
        double turn_3 = (cp * q2 - sp * q3) * step, turn_4 = (q1 + tangent * along) * step;
        double rise = ct * across - st * ax + lean * surge + bias - m->gravity;
        double a34 = -step * along, a43 = along * step * inverse * inverse;
        double a44 = 1.0 + turn_3 * tangent;
        for (int j = 0; j < COLUMNS; j++) {
            double e = by_3 * f.pitch[j] + by_4 * f.roll[j];
            double by_pitch = f.pitch[j], by_roll = f.roll[j];
            f.r[j] += step * f.v[j] + half * e;
            f.v[j] += step * e;
            f.pitch[j] = by_pitch + a34 * by_roll;
            f.roll[j] = a44 * by_roll + a43 * by_pitch;
        }
        f.roll[2] += step;
        f.pitch[3] += cp * step;
        f.roll[3] += sp * tangent * step;
        f.r_lean += step * f.v_lean + half * surge;
        f.v_lean += step * surge;
        sum_3 += by_3, sum_4 += by_4;
        r += step * v + half * rise;
        v += step * rise;
        pitch += turn_3, roll += turn_4;
        rotate(&st, &ct, turn_3);
        rotate(&sp, &cp, turn_4);
        height[i] = r;
    }
    k->f = f;
    k->x[R] = r, k->x[V] = v, k->x[PITCH] = pitch, k->x[ROLL] = roll;
    k->by_pitch = sum_3, k->by_roll = sum_4;
    k->sine[0] = st, k->cosine[0] = ct, k->sine[1] = sp, k->cosine[1] = cp;
    k->input[0] = x0, k->input[1] = y0, k->input[2] = z0;
    k->input[3] = p0, k->input[4] = q0, k->input[5] = w0;
    k->steps += end > begin ? end - begin : 0;
}

/* Q of all steps since the node, (C.5) and (C.6), added to the upper half of P. */
static void add_noise(Filter *k, const Model *m)
{
    const double n = (double)k->steps, step = m->step, *q = m->process;
    double s1 = n * (n - 1.0) / 2.0 * step;
    double s2 = (n - 1.0) * n * (2.0 * n - 1.0) / 6.0 * step * step;
    double s3 = s1 * s1 * step;
    double s4 = s2 * (3.0 * n * n - 3.0 * n - 1.0) / 5.0 * step * step;
    double by_3 = k->by_pitch / n, by_4 = k->by_roll / n;
    double st = sin(k->x[PITCH]), ct = cos(k->x[PITCH]);
    double sp = sin(k->x[ROLL]), cp = cos(k->x[ROLL]), tangent = st / ct;
    double white = q[0] * step, walk = q[4] * step, walk_1 = q[5] * step, walk_2 = q[6] * step;
    double q1 = q[1] * step, q2 = q[2] * step, q3 = q[3] * step;
    double c33 = cp * cp * q2 + sp * sp * q3, c34 = sp * cp * tangent * (q2 - q3);
    double c44 = q1 + tangent * tangent * (sp * sp * q2 + cp * cp * q3);
    double to_3 = by_3 * c33 + by_4 * c34, to_4 = by_3 * c34 + by_4 * c44;
    double both = by_3 * to_3 + by_4 * to_4 + walk, turned = sp * tangent;
    double(*p)[STATES] = k->p;

    p[R][R] += white * step * step * (n * n * n / 3.0 - n / 12.0) + both * s4 / 4.0;
    p[R][V] += white * n * n * step / 2.0 + both * s3 / 2.0;
    p[R][PITCH] += to_3 * s2 / 2.0;
    p[R][ROLL] += to_4 * s2 / 2.0;
    p[R][BIAS] += walk * s2 / 2.0;
    p[V][V] += white * n + both * s2;
    p[V][PITCH] += to_3 * s1;
    p[V][ROLL] += to_4 * s1;
    p[V][BIAS] += walk * s1;
    p[V][ROLL_BIAS] += walk_1 * by_4 * s2 / 2.0;
    p[V][PITCH_BIAS] += walk_2 * (by_3 * cp + by_4 * turned) * s2 / 2.0;
    p[PITCH][PITCH] += c33 * n + walk_2 * s2 * cp * cp;
    p[PITCH][ROLL] += c34 * n + walk_2 * s2 * cp * turned;
    p[PITCH][PITCH_BIAS] += walk_2 * s1 * cp;
    p[ROLL][ROLL] += c44 * n + walk_2 * s2 * turned * turned + walk_1 * s2;
    p[ROLL][ROLL_BIAS] += walk_1 * s1;
    p[ROLL][PITCH_BIAS] += walk_2 * s1 * turned;
    p[BIAS][BIAS] += walk * n;
    p[ROLL_BIAS][ROLL_BIAS] += walk_1 * n;
    p[PITCH_BIAS][PITCH_BIAS] += walk_2 * n;
}

/* P <- F P F' + Q over the steps since the last node, (6.10). */
void predict_covariance(Filter *k, const Model *m)
{
    if (k->steps == 0)
        return;
    const double span = (double)k->steps * m->step;
    const double *row[4] = {k->f.r, k->f.v, k->f.pitch, k->f.roll};
    double f[4][STATES] = {{0}}, moved[4][STATES] = {{0}};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < COLUMNS; j++)
            f[i][COLUMN[j]] = row[i][j];
    f[R][R] = f[V][V] = 1.0;
    f[R][V] = f[V][BIAS] = span;
    f[R][BIAS] = 0.5 * span * span;
    f[R][LEAN] = k->f.r_lean, f[V][LEAN] = k->f.v_lean;
    for (int i = 0; i < 4; i++)
        for (int s = 0; s < STATES; s++)
            for (int j = 0; j < STATES; j++)
                moved[i][j] += f[i][s] * k->p[s][j];
    for (int i = 0; i < 4; i++) {
        for (int j = i; j < 4; j++) {
            double total = 0.0;
            for (int s = 0; s < STATES; s++)
                total += moved[i][s] * f[j][s];
            k->p[i][j] = total;
        }
        for (int j = 4; j < STATES; j++)
            k->p[i][j] = moved[i][j];
    }
    add_noise(k, m);
    for (int i = 0; i < STATES; i++)
        for (int j = 0; j < i; j++)
            k->p[i][j] = k->p[j][i];
}
