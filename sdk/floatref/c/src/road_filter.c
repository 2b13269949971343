/* SPDX-License-Identifier: Apache-2.0
 *
 * Predict to a node, begin lean and tilt anew if asked, and update by the reading.
 */
#include <math.h>
#include <string.h>

#include "road_filter.h"
#include "samples.h"

/* Where the vehicle has stood for so long, the laser may sway over an edge of the road. */
#define STANDING_S 0.05

/* The numbers of a node's own. */
enum { RENEWED = 0, LEAN_ONCE = 1, TILT_ONCE = 2, LEAN_TWICE = 3, TILT_TWICE = 4, STAYS = 5, CLIMBS = 6 };

/* lambda <- F' lambda. */
static void back_road(const double *own, double span, double *lambda)
{
    if (own[RENEWED] > 0.0) {
        lambda[ROAD_LEAN] = 0.0;
        lambda[ROAD_TILT] = 0.0;
    }
    double by_d = lambda[ROAD_D], by_v = lambda[ROAD_V], by_r = lambda[ROAD_R] + by_d;
    lambda[ROAD_R] += (1.0 - own[STAYS]) * by_d;
    lambda[ROAD_V] += span * by_r;
    lambda[ROAD_BIAS] -= span * (by_v + 0.5 * span * by_r);
    lambda[ROAD_LEAN] -= own[LEAN_TWICE] * by_r + own[LEAN_ONCE] * by_v;
    lambda[ROAD_TILT] -= own[TILT_TWICE] * by_r + own[TILT_ONCE] * by_v;
    lambda[ROAD_SLOPE] = own[STAYS] * lambda[ROAD_SLOPE] - own[CLIMBS] * by_d;
    lambda[ROAD_D] *= own[STAYS];
}

/* c <- F c of a vector whose elements lie `apart` numbers apart. */
static void carry(const double *own, double span, double *c, size_t apart)
{
    double *r = c, *v = c + ROAD_V * apart, *d = c + ROAD_D * apart, *s = c + ROAD_SLOPE * apart;
    double bias = c[ROAD_BIAS * apart], lean = c[ROAD_LEAN * apart], tilt = c[ROAD_TILT * apart];
    double rise = span * (*v - 0.5 * span * bias);
    rise -= own[LEAN_TWICE] * lean + own[TILT_TWICE] * tilt;
    *d = own[STAYS] * *d + rise + ((1.0 - own[STAYS]) * *r - own[CLIMBS] * *s);
    *r += rise;
    *v -= span * bias + own[LEAN_ONCE] * lean + own[TILT_ONCE] * tilt;
    *s *= own[STAYS];
}

static void forth_road(const double *own, double span, double *psi)
{
    for (int32_t c = 0; c < FR_ROAD_STATES; c++) {
        carry(own, span, psi + c, FR_ROAD_STATES);
        if (own[RENEWED] > 0.0) {
            psi[ROAD_LEAN * FR_ROAD_STATES + c] = 0.0;
            psi[ROAD_TILT * FR_ROAD_STATES + c] = 0.0;
        }
    }
}

static const double row_of_reading[FR_ROAD_STATES] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};

const fr_lag_model fr_road_lag_model = {FR_ROAD_STATES, FR_ROAD_OWN,  row_of_reading, back_road,
                                        forth_road,     NULL,         0};

/* The elements of F: inputs linear since the node before, and the road's memory. */
static void integrate_inputs(const fr_road_model *model, const fr_road_filter *filter,
                             const fr_road_ends *ends, double *own)
{
    double span = ends->span;
    own[RENEWED] = ends->anew != 0 ? 1.0 : 0.0;
    own[LEAN_ONCE] = 0.5 * span * (filter->leaning + ends->leaning);
    own[TILT_ONCE] = 0.5 * span * (filter->tilting + ends->tilting);
    own[LEAN_TWICE] = span * span * (filter->leaning / 3.0 + ends->leaning / 6.0);
    own[TILT_TWICE] = span * span * (filter->tilting / 3.0 + ends->tilting / 6.0);
    own[STAYS] = exp(-ends->travel / model->reach);
    own[CLIMBS] = own[STAYS] * ends->travel;
}

static void predict_state(const fr_road_ends *ends, const double *own, double r, double v, double *x)
{
    double span = ends->span;
    double z = own[STAYS] * (x[ROAD_R] - x[ROAD_D]) + own[CLIMBS] * x[ROAD_SLOPE];
    x[ROAD_R] = r - 0.5 * span * span * x[ROAD_BIAS] - own[LEAN_TWICE] * x[ROAD_LEAN] -
                own[TILT_TWICE] * x[ROAD_TILT];
    x[ROAD_V] = v - span * x[ROAD_BIAS] - own[LEAN_ONCE] * x[ROAD_LEAN] -
                own[TILT_ONCE] * x[ROAD_TILT];
    x[ROAD_D] = x[ROAD_R] - z;
    x[ROAD_SLOPE] *= own[STAYS];
}

static void spread(double p[FR_ROAD_STATES][FR_ROAD_STATES], int i, int j, double value)
{
    p[i][j] += value;
    if (i != j)
        p[j][i] += value;
}

/* Add a covariance of the height's noise, which is the clearance's too, with a state's. */
static void shake(double p[FR_ROAD_STATES][FR_ROAD_STATES], int state, double value)
{
    spread(p, ROAD_R, state, value);
    spread(p, ROAD_D, state, value);
    if (state == ROAD_R)
        p[ROAD_D][ROAD_D] += value;
}

/* What travel brings of new road, without differences of exponentials: the integrals of
 * x exp(-2x / reach) and of its x-fold, within 1e-3 gone^2. */
static void roughen(const fr_road_model *model, double travel,
                    double p[FR_ROAD_STATES][FR_ROAD_STATES])
{
    double gone = 2.0 * travel / model->reach;
    double fresh = -0.5 * model->reach * expm1(-gone);
    double once = fresh * travel / (2.0 + gone / 3.0);
    double twice = fresh * travel * travel / (3.0 + 0.75 * gone);
    spread(p, ROAD_D, ROAD_D, model->road * fresh + model->slope * twice);
    spread(p, ROAD_D, ROAD_SLOPE, -model->slope * once);
    spread(p, ROAD_SLOPE, ROAD_SLOPE, model->slope * fresh);
}

static void add_noise(const fr_road_model *model, const fr_road_filter *filter,
                      const fr_road_ends *ends, double p[FR_ROAD_STATES][FR_ROAD_STATES])
{
    double along = 0.5 * (filter->along * filter->along + ends->along * ends->along);
    double walk = model->walk + model->walk_along * along;
    double white = model->white + (model->gap - model->white) * ends->missing;
    double span = ends->span, t2 = span * span, t3 = span * span * span;
    shake(p, ROAD_R, white * t3 / 3.0 + walk * t3 * t2 / 20.0);
    shake(p, ROAD_V, white * t2 / 2.0 + walk * t2 * t2 / 8.0);
    spread(p, ROAD_V, ROAD_V, white * span + walk * t3 / 3.0);
    shake(p, ROAD_BIAS, -walk * t3 / 6.0);
    spread(p, ROAD_V, ROAD_BIAS, -walk * t2 / 2.0);
    spread(p, ROAD_BIAS, ROAD_BIAS, walk * span);
    roughen(model, ends->travel, p);
}

/* P <- F P F' + Q. */
static void predict_covariance(const fr_road_model *model, fr_road_filter *filter,
                               const fr_road_ends *ends, const double *own)
{
    double(*p)[FR_ROAD_STATES] = filter->p;
    /* Rows of P F', and once turned, of F P F'. */
    for (int i = 0; i < FR_ROAD_STATES; i++)
        carry(own, ends->span, p[i], 1);
    for (int i = 0; i < FR_ROAD_STATES; i++) {
        for (int j = 0; j < i; j++) {
            double turned = p[i][j];
            p[i][j] = p[j][i];
            p[j][i] = turned;
        }
    }
    for (int i = 0; i < FR_ROAD_STATES; i++)
        carry(own, ends->span, p[i], 1);
    add_noise(model, filter, ends, p);
}

static void renew(fr_road_filter *filter, int state, double expected, double variance)
{
    filter->x[state] = expected;
    for (int j = 0; j < FR_ROAD_STATES; j++) {
        filter->p[state][j] = 0.0;
        filter->p[j][state] = 0.0;
    }
    filter->p[state][state] = variance;
}

static double expected_square(const fr_road_model *model, const fr_road_filter *filter)
{
    return filter->p[ROAD_D][ROAD_D] + model->reading;
}

/* At a standstill, take the road for another one where a reading is too far off for this. */
static int let_go(const fr_road_model *model, fr_road_filter *filter, double error)
{
    if (filter->still < STANDING_S || error * error <= model->edge * expected_square(model, filter))
        return 0;
    filter->p[ROAD_D][ROAD_D] += error * error;
    return 1;
}

/* P <- (I - K H) P (I - K H)' + K R K', with H of 1 for the clearance. */
static void update_covariance(double variance, const double *gain,
                              double p[FR_ROAD_STATES][FR_ROAD_STATES])
{
    for (int i = 0; i < FR_ROAD_STATES; i++) {
        double seen = p[i][ROAD_D];
        for (int j = 0; j < FR_ROAD_STATES; j++)
            p[i][j] -= seen * gain[j];
    }
    for (int j = 0; j < FR_ROAD_STATES; j++) {
        double seen = p[ROAD_D][j];
        for (int i = 0; i <= j; i++)
            p[i][j] -= gain[i] * seen;
    }
    for (int i = 0; i < FR_ROAD_STATES; i++) {
        for (int j = i; j < FR_ROAD_STATES; j++) {
            p[i][j] += variance * gain[i] * gain[j];
            p[j][i] = p[i][j];
        }
    }
}

static void update(const fr_road_model *model, fr_road_filter *filter, double seen,
                   fr_road_node *node)
{
    double *x = filter->x, total;
    node->error = seen - x[ROAD_D];
    node->let_go = let_go(model, filter, node->error);
    total = expected_square(model, filter);
    for (int i = 0; i < FR_ROAD_STATES; i++) {
        node->gain[i] = filter->p[i][ROAD_D] / total;
        x[i] += node->gain[i] * node->error;
    }
    update_covariance(model->reading, node->gain, filter->p);
    node->innovation = node->error / total;
    node->information = 1.0 / total;
    node->updated = 1;
}

void fr_road_step(const fr_road_model *model, fr_road_filter *filter, const fr_road_ends *ends,
                  fr_road_node *node)
{
    double near_r = filter->x[ROAD_R] + ends->span * filter->x[ROAD_V] + ends->twice;
    double near_v = filter->x[ROAD_V] + ends->once;
    (void)memset(node, 0, sizeof *node);
    integrate_inputs(model, filter, ends, node->own);
    if (ends->span > 0.0) {
        predict_state(ends, node->own, near_r, near_v, filter->x);
        predict_covariance(model, filter, ends, node->own);
    }
    filter->still = ends->travel <= 0.0 ? filter->still + ends->span : 0.0;
    if (ends->anew != 0) {
        renew(filter, ROAD_LEAN, model->lean, model->lean_prior);
        renew(filter, ROAD_TILT, model->tilt, model->tilt_prior);
    }
    if (!fr_missing_number(ends->seen))
        update(model, filter, ends->seen, node);
    node->rise = filter->x[ROAD_R] - near_r;
    node->climb = filter->x[ROAD_V] - near_v;
    filter->leaning = ends->leaning;
    filter->tilting = ends->tilting;
    filter->along = ends->along;
}
