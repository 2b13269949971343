/* SPDX-License-Identifier: Apache-2.0
 *
 * The half car over the road under its wheels: forward by a filter of constant gain, and backward by
 * the adjoint, so that of each reading two numbers are stored and not twice ten states.
 */
#include <math.h>
#include <string.h>

#include "pitch.h"

#define POINT_M 0.05
/* Least share of the accelerometer's motion that road and brakes have to give the half car. */
#define LEAST_EXPLAINED 0.25

/* The road under an axle. It is known at points: each has that of the first bin there. */
typedef struct axle_way {
    const double *distance, *road;
    double ahead_m, spacing_m, last; /* last: number of the last point */
    int32_t bins, low, high;         /* bins at the point at or before the axle, and at the next */
} axle_way;

static double point_at(const axle_way *way, double point)
{
    return way->distance[0] + point * way->spacing_m;
}

/* The first bin that has reached a point, from bin `at` on. */
static int32_t reached(const axle_way *way, double point, int32_t at)
{
    int32_t bin = at;
    while (bin + 1 < way->bins && way->distance[bin] < point_at(way, point))
        bin++;
    return bin;
}

static axle_way begin_way(const pt_arrays *a, int32_t count, double ahead_m)
{
    double begin = a->distance[0], length = a->distance[count - 1] + POINT_M - begin;
    axle_way way = {a->distance, a->road, ahead_m, (begin + POINT_M) - begin, 0.0, count, 0, 0};
    way.last = ceil(length / POINT_M) - 1.0;
    return way;
}

/* The number of the point at or before a place. */
static double point_before(const axle_way *way, double place)
{
    double point = floor((place - way->distance[0]) / way->spacing_m);
    point = fmin(fmax(point, 0.0), way->last);
    if (point > 0.0 && point_at(way, point) > place)
        return point - 1.0;
    if (point < way->last && point_at(way, point + 1.0) <= place)
        return point + 1.0;
    return point;
}

/* The road under the axle at a bin; beyond both ends that of the end. */
static double road_under(axle_way *way, int32_t bin)
{
    double place = way->distance[bin] + way->ahead_m, point = point_before(way, place);
    double from = point_at(way, point), behind = point_at(way, point + 1.0);
    way->low = reached(way, point, way->low);
    way->high = reached(way, point + 1.0, way->low);
    if (place <= from || point >= way->last)
        return way->road[way->low];
    return (way->road[way->high] - way->road[way->low]) / (behind - from) * (place - from) +
           way->road[way->low];
}

/* States of two half cars on the same road: one that the readings correct, and one on its own. */
typedef struct two_cars {
    double filtered[PT_STATES], alone[PT_STATES];
    double before[PT_INPUTS], now[PT_INPUTS];
} two_cars;

static void rest_car(const pt_gains *gains, const double *u, double *x)
{
    (void)memset(x, 0, PT_STATES * sizeof *x);
    for (int32_t i = 0; i < PT_BODY; i++)
        for (int32_t j = 0; j < PT_INPUTS; j++)
            x[i] += gains->rest[i * PT_INPUTS + j] * u[j];
}

static void predict_car(const pt_gains *gains, const two_cars *cars, double *x)
{
    double next[PT_STATES];
    for (int32_t i = 0; i < PT_STATES; i++) {
        next[i] = 0.0;
        for (int32_t j = 0; j < PT_STATES; j++)
            next[i] += gains->transition[i * PT_STATES + j] * x[j];
        for (int32_t j = 0; j < PT_INPUTS; j++)
            next[i] += gains->before[i * PT_INPUTS + j] * cars->before[j] +
                       gains->now[i * PT_INPUTS + j] * cars->now[j];
    }
    (void)memcpy(x, next, sizeof next);
}

static double read_car(const pt_gains *gains, const double *u, const double *x)
{
    double y = 0.0;
    for (int32_t i = 0; i < PT_STATES; i++)
        y += gains->reading[i] * x[i];
    for (int32_t j = 0; j < PT_INPUTS; j++)
        y += gains->direct[j] * u[j];
    return y;
}

/* Mean and squares about it of values as they come. */
typedef struct spread_of {
    double count, mean, squares;
} spread_of;

static void add_to_spread(spread_of *s, double x)
{
    double off = x - s->mean;
    s->count += 1.0;
    s->mean += off / s->count;
    s->squares += off * (x - s->mean);
}

static void move_cars(const pt_gains *gains, two_cars *cars, int first)
{
    if (first != 0) {
        rest_car(gains, cars->now, cars->filtered);
        rest_car(gains, cars->now, cars->alone);
    } else {
        predict_car(gains, cars, cars->filtered);
        predict_car(gains, cars, cars->alone);
    }
}

/* Forward: the pitch before each reading, and in place of the reading by how much it is not what was
 * expected. Returns whether the road explains enough. */
static int filter_forward(const fr_pitch *pitch, const pt_arrays *a, int32_t count)
{
    const pt_gains *gains = &pitch->gains;
    double wheelbase = pitch->config.front_m - pitch->config.rear_m;
    axle_way front = begin_way(a, count, pitch->config.front_m);
    axle_way rear = begin_way(a, count, pitch->config.rear_m);
    spread_of explained = {0.0, 0.0, 0.0}, measured = {0.0, 0.0, 0.0};
    two_cars cars;
    (void)memset(&cars, 0, sizeof cars);
    for (int32_t k = 0; k < count; k++) {
        double error;
        cars.now[0] = road_under(&front, k);
        cars.now[1] = road_under(&rear, k);
        cars.now[2] = a->along[k] + PT_GRAVITY * ((cars.now[0] - cars.now[1]) / wheelbase);
        move_cars(gains, &cars, k == 0);
        add_to_spread(&explained, read_car(gains, cars.now, cars.alone));
        add_to_spread(&measured, a->measured[k]);
        error = a->measured[k] - read_car(gains, cars.now, cars.filtered);
        a->pitch[k] = cars.filtered[1];
        a->measured[k] = error;
        for (int32_t i = 0; i < PT_STATES; i++)
            cars.filtered[i] += gains->filter[i] * error;
        (void)memcpy(cars.before, cars.now, sizeof cars.before);
    }
    return sqrt(explained.squares) >= LEAST_EXPLAINED * sqrt(measured.squares);
}

/* Backward: what the readings from here on add, lambda = (1 - h K') F' lambda + h e / s, by which the
 * state is off P lambda. */
static void smooth_pitch(const pt_gains *gains, const pt_arrays *a, int32_t count)
{
    double lambda[PT_STATES] = {0}, next[PT_STATES];
    for (int32_t k = count - 1; k >= 0; k--) {
        double along = 0.0, change = 0.0;
        for (int32_t j = 0; j < PT_STATES; j++) {
            next[j] = 0.0;
            for (int32_t i = 0; i < PT_STATES; i++)
                next[j] += gains->transition[i * PT_STATES + j] * lambda[i];
            along += gains->filter[j] * next[j];
        }
        for (int32_t j = 0; j < PT_STATES; j++) {
            lambda[j] = next[j] + gains->reading[j] * (a->measured[k] / gains->expected - along);
            change += gains->spread[j] * lambda[j];
        }
        a->pitch[k] += change;
    }
}

int fr_pt_smooth(const fr_pitch *pitch, const pt_arrays *a, int32_t count)
{
    if (filter_forward(pitch, a, count) == 0)
        return 0;
    smooth_pitch(&pitch->gains, a, count);
    return 1;
}
