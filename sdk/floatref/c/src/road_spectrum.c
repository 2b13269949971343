/* SPDX-License-Identifier: Apache-2.0
 *
 * For a road of the spectrum 2 q / (2 pi nu)^2 + 2 g / (2 pi nu)^4 (2.4) the square of the second
 * difference over L is 2 q L + 2/3 g L^3 in the mean. Texture, another one at each node, adds six
 * times its variance for any L.
 */
#include <math.h>
#include <string.h>

#include "road_spectrum.h"
#include "samples.h"

#define SPACING_M 1.0
/* What takes longer is the accelerometer's drift as much as the road. */
#define MOST_S 4.0
/* Both halves of the longer distance take the same time but for this share. */
#define STEADY 0.02
/* Nodes so far apart show the texture. */
#define NEAREST_M 0.005
#define FARTHEST_M 0.03
/* Times by which the travel of texture's memory is shorter than that of the spectrum. */
#define SOONER 15.0
/* No road is taken for smoother than this share of what it was taken for at the start. */
#define LEAST 0.125
/* A square far out counts as that of three deviations. */
#define FAR_OUT 9.0

enum { SHORT = 0, LONG = 1, LENGTHS = 2 };

static const int32_t lags[LENGTHS] = {2, 16};

/* What q and g add to the mean square over a length. */
static double by_road(int which)
{
    return 2.0 * (SPACING_M * lags[which]);
}

static double by_long_waves(int which)
{
    double length_m = SPACING_M * lags[which];
    return 2.0 / 3.0 * (length_m * length_m * length_m);
}

void fr_spectrum_begin(fr_road_spectrum *spectrum, double road, double long_waves, double reading_m,
                       double memory_m, double interval_s)
{
    (void)memset(spectrum, 0, sizeof *spectrum);
    spectrum->interval_s = interval_s;
    spectrum->share = SPACING_M / memory_m;
    spectrum->least[0] = LEAST * road;
    spectrum->least[1] = LEAST * long_waves;
    for (int k = 0; k < LENGTHS; k++) {
        spectrum->squares[k] = by_road(k) * road + by_long_waves(k) * long_waves;
        spectrum->texture[k] = 6.0 * (reading_m * reading_m);
    }
    for (int k = 0; k < FR_TEXTURE_NODES; k++)
        spectrum->latest[k] = NAN;
}

/* Move a mean to a new square by a share. */
static void learn(double *mean, double bend, double share)
{
    double square = bend * bend, most = FAR_OUT * *mean;
    *mean += share * ((square < most ? square : most) - *mean);
}

static void learn_length(fr_road_spectrum *spectrum, int which)
{
    const fr_spectrum_point *points = spectrum->points;
    int32_t lag = lags[which];
    double later = 0.0, earlier = 0.0, lasted, uneven, bend;
    for (int32_t j = 0; j < lag; j++) {
        later += points[j].after_s;
        earlier += points[lag + j].after_s;
    }
    lasted = later + earlier;
    uneven = later - earlier;
    /* In a brake the tilt that is not known yet looks like road. */
    if (lasted > MOST_S || (which == LONG && fabs(uneven) > STEADY * lasted))
        return;
    bend = points[0].elevation_m - 2.0 * points[lag].elevation_m + points[2u * (size_t)lag].elevation_m;
    /* What had been turned before the first of the three is no error of theirs. */
    bend += uneven * points[2u * (size_t)lag].turned;
    learn(&spectrum->squares[which], bend, spectrum->share);
}

/* A point a metre or more behind the latest. */
static void add_spectrum_point(fr_road_spectrum *spectrum, double elevation_m)
{
    fr_spectrum_point *points = spectrum->points;
    if (spectrum->travel_m >= 2.0 * SPACING_M)
        spectrum->count = 0;
    (void)memmove(points + 1, points, (FR_SPECTRUM_POINTS - 1) * sizeof *points);
    points[0].elevation_m = elevation_m - spectrum->moved_m;
    points[0].after_s = spectrum->time_s;
    points[0].turned = spectrum->turned;
    if (spectrum->count < FR_SPECTRUM_POINTS)
        spectrum->count++;
    spectrum->travel_m = fmod(spectrum->travel_m, SPACING_M);
    spectrum->time_s = 0.0;
    for (int k = 0; k < LENGTHS; k++)
        if (spectrum->count > 2 * lags[k])
            learn_length(spectrum, k);
}

/* Second differences over one and over two nodes, where five in a row are some way apart. */
static void learn_texture(fr_road_spectrum *spectrum, double elevation_m, double travel_m)
{
    double *latest = spectrum->latest, total = 0.0;
    int apart = travel_m >= NEAREST_M && travel_m <= FARTHEST_M;
    double share = SOONER * spectrum->share / SPACING_M * travel_m;
    (void)memmove(latest + 1, latest, (FR_TEXTURE_NODES - 1) * sizeof *latest);
    latest[0] = apart ? elevation_m : NAN;
    for (int k = 0; k < FR_TEXTURE_NODES; k++)
        total += latest[k];
    if (fr_missing_number(total))
        return;
    for (int k = 0; k < LENGTHS; k++)
        learn(&spectrum->texture[k], latest[0] - 2.0 * latest[k + 1] + latest[2 * (size_t)(k + 1)],
              share < 1.0 ? share : 1.0);
}

void fr_spectrum_add(fr_road_spectrum *spectrum, double elevation_m, double travel_m, double moved,
                     double turned)
{
    spectrum->travel_m += travel_m;
    spectrum->time_s += spectrum->interval_s;
    spectrum->moved_m += spectrum->interval_s * spectrum->turned + moved;
    spectrum->turned += turned;
    if (spectrum->travel_m >= SPACING_M && !fr_missing_number(elevation_m))
        add_spectrum_point(spectrum, elevation_m);
    learn_texture(spectrum, elevation_m, travel_m);
}

void fr_spectrum_renew(const fr_road_spectrum *spectrum, double reading, fr_road_model *model)
{
    /* Two equations, eliminated by the second, which is the larger. */
    double factor = by_road(SHORT) / by_road(LONG);
    double rest = by_long_waves(SHORT) - factor * by_long_waves(LONG);
    double g = (spectrum->squares[SHORT] - factor * spectrum->squares[LONG]) / rest;
    double q = (spectrum->squares[LONG] - by_long_waves(LONG) * g) / by_road(LONG);
    double texture = fmax(0.0, 2.0 * spectrum->texture[0] - spectrum->texture[1]) / 6.0;
    /* Where one would be negative, the other alone makes up its own length's square. */
    if (g < spectrum->least[1])
        q = spectrum->squares[SHORT] / by_road(SHORT);
    model->road = fmax(q, spectrum->least[0]);
    model->slope = fmax(g, spectrum->least[1]);
    model->reading = fmax(reading, texture);
}

double fr_spectrum_bend_m(const fr_road_spectrum *spectrum)
{
    double start = by_road(LONG) * (spectrum->least[0] / LEAST) +
                   by_long_waves(LONG) * (spectrum->least[1] / LEAST);
    return sqrt(fmax(spectrum->squares[LONG], start));
}
