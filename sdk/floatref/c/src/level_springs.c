/* SPDX-License-Identifier: Apache-2.0
 *
 * The body on its springs: rows of bounce and pitch of a half car, and their derivatives.
 */
#include <math.h>

#include "level_work.h"

static double wheelbase_of(const lv_work *w)
{
    return w->config->front_m - w->config->rear_m;
}

/* What an axle's springs make of its compression: K of the mean and C of its rate. */
static void spring(const lv_work *w, lv_car *car, int32_t axle, const double *globals)
{
    double place_m = axle == 0 ? w->config->front_m : w->config->rear_m;
    double rate = 0.5 / w->interval_s;
    car->stiffness[axle] = exp(globals[LV_STIFF_FRONT + axle]);
    car->damping[axle] = exp(globals[LV_DAMP_FRONT + axle]);
    car->soft[axle] = exp(-globals[LV_STIFF_FRONT + axle]);
    car->ahead_m[axle] = w->config->lever_m + place_m;
    car->shares[axle][0] = car->stiffness[axle] * LV_SHARE - car->damping[axle] * rate;
    car->shares[axle][1] = car->stiffness[axle] * LV_MIDDLE;
    car->shares[axle][2] = car->stiffness[axle] * LV_SHARE + car->damping[axle] * rate;
}

void fr_lv_set_car(const lv_work *w, const double *y, lv_car *car)
{
    const double *globals = y + lv_global(w, 0);
    double length = wheelbase_of(w), place = globals[LV_PLACE], soft;
    double radius = 0.5 * length * exp(globals[LV_TURNING]);
    spring(w, car, 0, globals);
    spring(w, car, 1, globals);
    soft = car->soft[0] + car->soft[1];
    car->centre_m = car->ahead_m[0] - place * length;
    car->by[0] = place * length / (radius * radius);
    car->by[1] = -(1.0 - place) * length / (radius * radius);
    car->moment = globals[LV_GAIN] * length * length / (radius * radius * soft);
    car->soft[0] /= soft;
    car->soft[1] /= soft;
}

/* The compression of both springs, the slope under the wheels, and what pitches beside it. */
void fr_lv_press(lv_work *w, const lv_car *car, const double *y)
{
    const double *height = y + lv_in_time(w, LV_HEIGHT), *pitch = y + lv_in_time(w, LV_PITCH);
    const double *offset = y + lv_in_time(w, LV_OFFSET), *moment = y + lv_in_time(w, LV_MOMENT);
    for (int32_t k = 0; k < w->nodes; k++) {
        double under[2];
        for (int32_t axle = 0; axle < 2; axle++) {
            double body = height[k] + car->ahead_m[axle] * pitch[k] - offset[k];
            under[axle] = lv_passed(&w->strip[LV_FRONT + axle][k], y);
            w->pressed[axle][k] = under[axle] - body;
        }
        w->beta[k] = (under[0] - under[1]) / wheelbase_of(w);
        w->tilt[k] = LV_GRAVITY * w->beta[k] + moment[k];
    }
}

static double stiff(const lv_work *w, const lv_car *car, int32_t axle, int32_t k)
{
    return car->stiffness[axle] * lv_triple(w->pressed[axle], k);
}

static double damped(const lv_work *w, const lv_car *car, int32_t axle, int32_t k)
{
    const double *x = w->pressed[axle];
    double rate = 0.5 / w->interval_s;
    return car->damping[axle] * (-rate * x[k - 1] + rate * x[k + 1]);
}

static double push(const lv_work *w, const lv_car *car, int32_t axle, int32_t k)
{
    return stiff(w, car, axle, k) + damped(w, car, axle, k);
}

static double driven(const lv_work *w, int32_t at)
{
    return w->sharp[at] + lv_triple(w->tilt, w->middle[at]);
}

double fr_lv_bounce(const lv_work *w, const lv_car *car, const double *y, int32_t k)
{
    const double *height = y + lv_in_time(w, LV_HEIGHT), *pitch = y + lv_in_time(w, LV_PITCH);
    const double *heave = y + lv_in_time(w, LV_HEAVE);
    double swung[3];
    for (int32_t i = 0; i < 3; i++)
        swung[i] = height[k + i - 1] - heave[k + i - 1] + car->centre_m * pitch[k + i - 1];
    return lv_second(w, swung, 1) - push(w, car, 0, k) - push(w, car, 1, k);
}

double fr_lv_pitch(const lv_work *w, const lv_car *car, const double *y, int32_t at)
{
    const double *pitch = y + lv_in_time(w, LV_PITCH), *nod = y + lv_in_time(w, LV_NOD);
    int32_t k = w->middle[at];
    double swung[3];
    double sprung = car->by[0] * push(w, car, 0, k) + car->by[1] * push(w, car, 1, k);
    for (int32_t i = 0; i < 3; i++)
        swung[i] = pitch[k + i - 1] - nod[k + i - 1];
    return lv_second(w, swung, 1) - sprung - car->moment * driven(w, at);
}

/* Subtract the share of one point of the road, which may be in the row already. */
static void subtract_point(lv_row *row, int32_t column, double value)
{
    int32_t i = 0;
    while (i < row->count && row->column[i] != column)
        i++;
    if (i == row->count)
        lv_add(row, column, 0.0);
    row->value[i] -= value;
}

/* Subtract the road under an axle, with a share for each of three nodes. */
static void subtract_road(const lv_work *w, lv_row *row, int32_t axle, int32_t k,
                          const double *shares)
{
    for (int32_t node = 0; node < 3; node++) {
        const lv_strip *strip = &w->strip[LV_FRONT + axle][k + node - 1];
        for (int32_t i = 0; i < strip->count; i++)
            subtract_point(row, strip->column[i], shares[node] * strip->value[i]);
    }
}

static void add_three(const lv_work *w, lv_row *row, int32_t name, int32_t k, const double *shares)
{
    for (int32_t node = 0; node < 3; node++)
        lv_add(row, lv_in_time(w, name) + k + node - 1, shares[node]);
}

/* By the constants of the springs, with what bounce or pitch multiplies the pushes by. */
static void add_springs(const lv_work *w, lv_row *row, const lv_car *car, int32_t k,
                        const double *by, double softened)
{
    for (int32_t axle = 0; axle < 2; axle++)
        lv_add(row, lv_global(w, LV_STIFF_FRONT + axle),
               -by[axle] * stiff(w, car, axle, k) - car->soft[axle] * softened);
    for (int32_t axle = 0; axle < 2; axle++)
        lv_add(row, lv_global(w, LV_DAMP_FRONT + axle), -by[axle] * damped(w, car, axle, k));
}

/* What a node's height, pitch and offset have in a row, by pushes of both axles at it. */
static void set_body(const lv_car *car, double front, double rear, double *body)
{
    body[0] = front + rear;
    body[1] = car->ahead_m[0] * front + car->ahead_m[1] * rear;
    body[2] = -(front + rear);
}

static void add_body(const lv_work *w, lv_row *row, int32_t k, double body[3][3])
{
    add_three(w, row, LV_HEIGHT, k, body[0]);
    add_three(w, row, LV_PITCH, k, body[1]);
    add_three(w, row, LV_OFFSET, k, body[2]);
}

static void set_seconds(const lv_work *w, double *seconds)
{
    double step = w->interval_s * w->interval_s;
    seconds[0] = 1.0 / step;
    seconds[1] = -2.0 / step;
    seconds[2] = 1.0 / step;
}

static void derive_bounce(lv_work *w, const lv_car *car, const double *y, int32_t at)
{
    const double both[2] = {1.0, 1.0};
    double parts[3], seconds[3], body[3][3], heave[3];
    int32_t k = w->middle[at];
    lv_row row;
    row.count = 0;
    set_seconds(w, seconds);
    for (int32_t i = 0; i < 3; i++) {
        set_body(car, car->shares[0][i], car->shares[1][i], parts);
        body[0][i] = seconds[i] + parts[0];
        body[1][i] = car->centre_m * seconds[i] + parts[1];
        body[2][i] = parts[2];
        heave[i] = -seconds[i];
    }
    subtract_road(w, &row, 0, k, car->shares[0]);
    subtract_road(w, &row, 1, k, car->shares[1]);
    add_body(w, &row, k, body);
    add_three(w, &row, LV_HEAVE, k, heave);
    lv_add(&row, lv_global(w, LV_PLACE),
           -wheelbase_of(w) * lv_second(w, y + lv_in_time(w, LV_PITCH), k));
    add_springs(w, &row, car, k, both, 0.0);
    fr_lv_end_row(w, &row, w->begin[LV_BOUNCES] + at);
}

/* By those that turn the body alone: the place of its centre, gain and gyration. */
static void add_turns(const lv_work *w, lv_row *row, const lv_car *car, const double *y, int32_t at)
{
    int32_t k = w->middle[at];
    double front = push(w, car, 0, k), rear = push(w, car, 1, k);
    double turned = car->moment * driven(w, at);
    double sprung = car->by[0] * front + car->by[1] * rear;
    lv_add(row, lv_global(w, LV_PLACE), -(car->by[0] - car->by[1]) * (front + rear));
    lv_add(row, lv_global(w, LV_GAIN), -turned / y[lv_global(w, LV_GAIN)]);
    lv_add(row, lv_global(w, LV_TURNING), 2.0 * (sprung + turned));
    add_springs(w, row, car, k, car->by, turned);
}

/* The road under both axles: it presses the springs, and its slope pitches the body. */
static void subtract_both_roads(const lv_work *w, lv_row *row, const lv_car *car, int32_t k)
{
    const double means[3] = {LV_SHARE, LV_MIDDLE, LV_SHARE};
    double grade = LV_GRAVITY * car->moment / wheelbase_of(w), front[3], rear[3];
    for (int32_t i = 0; i < 3; i++) {
        front[i] = car->by[0] * car->shares[0][i] + grade * means[i];
        rear[i] = car->by[1] * car->shares[1][i] - grade * means[i];
    }
    subtract_road(w, row, 0, k, front);
    subtract_road(w, row, 1, k, rear);
}

static void derive_pitch(lv_work *w, const lv_car *car, const double *y, int32_t at)
{
    const double moment[3] = {-car->moment * LV_SHARE, -car->moment * LV_MIDDLE,
                              -car->moment * LV_SHARE};
    double parts[3], seconds[3], body[3][3], nod[3];
    int32_t k = w->middle[at];
    lv_row row;
    row.count = 0;
    set_seconds(w, seconds);
    for (int32_t i = 0; i < 3; i++) {
        set_body(car, car->by[0] * car->shares[0][i], car->by[1] * car->shares[1][i], parts);
        body[0][i] = parts[0];
        body[1][i] = seconds[i] + parts[1];
        body[2][i] = parts[2];
        nod[i] = -seconds[i];
    }
    subtract_both_roads(w, &row, car, k);
    add_body(w, &row, k, body);
    add_three(w, &row, LV_NOD, k, nod);
    add_three(w, &row, LV_MOMENT, k, moment);
    add_turns(w, &row, car, y, at);
    fr_lv_end_row(w, &row, w->begin[LV_PITCHES] + at);
}

void fr_lv_derive_springs(lv_work *w, const double *y)
{
    lv_car car;
    fr_lv_set_car(w, y, &car);
    fr_lv_press(w, &car, y);
    for (int32_t at = 0; at < w->middles; at++)
        derive_bounce(w, &car, y, at);
    for (int32_t at = 0; at < w->middles; at++)
        derive_pitch(w, &car, y, at);
}
