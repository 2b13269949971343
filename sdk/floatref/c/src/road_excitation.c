/* SPDX-License-Identifier: Apache-2.0
 *
 * The second derivative of the distance under a Gaussian, and a damped spring that follows it.
 */
#include <math.h>

#include "road_excitation.h"
#include "samples.h"

/* Standard deviation of the Gaussian: half of the amplitude at 6 Hz; beyond REACH of it nothing. */
#define SPREAD_S 0.03
#define REACH_OF_SPREAD 4.0
/* A brake is forgotten after so long without the encoder. */
#define FADE_S 1.0

int32_t fr_excitation_reach(double interval_s)
{
    double nodes = rint(REACH_OF_SPREAD * SPREAD_S / interval_s);
    return nodes < 1.0 ? 1 : (int32_t)nodes;
}

/* Weights whose sum over distances is their second derivative, exact for parabolas. */
static void fill_weights(double *weights, int32_t reach, double interval_s)
{
    double bells = 0.0, squares = 0.0, scale = 0.0;
    for (int32_t j = -reach; j <= reach; j++) {
        double place = j * interval_s, ratio = place / SPREAD_S;
        weights[j + reach] = exp(-0.5 * (ratio * ratio));
        bells += weights[j + reach];
        squares += weights[j + reach] * (place * place);
    }
    for (int32_t j = -reach; j <= reach; j++) {
        double place = j * interval_s;
        weights[j + reach] *= place * place - squares / bells;
        scale += weights[j + reach] * (place * place);
    }
    for (int32_t j = 0; j <= 2 * reach; j++)
        weights[j] *= 2.0 / scale;
}

/* Columns: value and rate at the node before, the acceleration then and now; it is linear in
 * between, and the static gain is 1. */
static void fill_response(double by[2][4], double hz, double damping, double interval_s)
{
    double omega = 2.0 * FR_PI * hz, swing = omega * sqrt(1.0 - damping * damping);
    double decay = exp(-damping * omega * interval_s), cosine = cos(swing * interval_s);
    double sine = sin(swing * interval_s) / swing;
    double lag = 2.0 * damping / omega, slope = 1.0 / interval_s;
    /* What is left of the response to a line decays freely. */
    double before[2][2] = {{1.0 + lag * slope, -lag * slope}, {-slope, slope}};
    double after[2][2] = {{lag * slope, 1.0 - lag * slope}, {-slope, slope}};
    by[0][0] = decay * (cosine + damping * omega * sine);
    by[0][1] = decay * sine;
    by[1][0] = decay * (-(omega * omega) * sine);
    by[1][1] = decay * (cosine - damping * omega * sine);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            by[i][2 + j] = after[i][j] - (by[i][0] * before[0][j] + by[i][1] * before[1][j]);
}

void fr_excitation_begin(fr_excitation *excitation, double *room, double interval_s, double hz,
                         double damping)
{
    excitation->reach = fr_excitation_reach(interval_s);
    excitation->fade = exp(-interval_s / FADE_S);
    fill_weights(room, excitation->reach, interval_s);
    fill_response(excitation->by, hz, damping, interval_s);
}

void fr_excitation_add(fr_excitation *excitation, double *room, double place_m)
{
    int32_t ring = 2 * excitation->reach + 1;
    room[ring + (int32_t)(excitation->nodes % ring)] = place_m;
    if (excitation->nodes > 0 && excitation->nodes <= excitation->reach)
        excitation->known++;
    excitation->nodes++;
}

/* A place before the end of the run; before its start the known ones turned about the first. */
static double place_within(const fr_excitation *excitation, const double *room, int64_t k)
{
    int32_t ring = 2 * excitation->reach + 1;
    const double *places = room + ring;
    if (k >= 0)
        return places[k % ring];
    return 2.0 * places[0] - places[-k < excitation->known ? -k : excitation->known];
}

/* The same, and behind the end as far the other way. */
static double place_beyond(const fr_excitation *excitation, const double *room, int64_t k)
{
    int64_t last = excitation->nodes - 1;
    if (k <= last)
        return place_within(excitation, room, k);
    return 2.0 * place_within(excitation, room, last) - place_within(excitation, room, 2 * last - k);
}

void fr_excitation_take(fr_excitation *excitation, const double *room, int64_t k, double *along,
                        double *response)
{
    double(*by)[4] = excitation->by;
    double a = 0.0, value = excitation->value, rate = excitation->rate, latest = excitation->latest;
    for (int32_t j = -excitation->reach; j <= excitation->reach; j++)
        a += room[j + excitation->reach] * place_beyond(excitation, room, k + j);
    if (fr_missing_number(a))
        a = excitation->fade * latest;
    excitation->value = by[0][0] * value + by[0][1] * rate + by[0][2] * latest + by[0][3] * a;
    excitation->rate = by[1][0] * value + by[1][1] * rate + by[1][2] * latest + by[1][3] * a;
    excitation->latest = a;
    *along = a;
    *response = excitation->value;
}
