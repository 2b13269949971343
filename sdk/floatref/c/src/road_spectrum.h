/* SPDX-License-Identifier: Apache-2.0
 *
 * The spectrum of the road, from the run itself where speed allows: second differences over 2 and
 * 16 m show white slope and long waves, those over one and two nodes the texture.
 */
#ifndef FR_ROAD_SPECTRUM_H
#define FR_ROAD_SPECTRUM_H

#include "road_filter.h"

enum { FR_SPECTRUM_POINTS = 33, FR_TEXTURE_NODES = 5 };

typedef struct fr_spectrum_point {
    double elevation_m, after_s, turned;
} fr_spectrum_point;

typedef struct fr_road_spectrum {
    double interval_s, share;
    double least[2];   /* the smallest q in m and g in 1/m */
    double squares[2]; /* mean squares over both lengths, in m^2 */
    double texture[2]; /* over one and over two nodes */
    double travel_m, time_s, moved_m, turned; /* since the latest point, and since the start */
    int32_t count;                            /* points behind one another */
    fr_spectrum_point points[FR_SPECTRUM_POINTS]; /* the latest first */
    double latest[FR_TEXTURE_NODES];              /* elevations of nodes, the latest first */
} fr_road_spectrum;

/* Begin with the road of the settings: q, g and the 1-sigma of a reading, over a memory in m. */
void fr_spectrum_begin(fr_road_spectrum *spectrum, double road, double long_waves, double reading_m,
                       double memory_m, double interval_s);

/* Filtered elevation in m at the next node, NaN where it is missing, the travel to it in m, and by
 * how much its reading has moved the height in m and turned the velocity in m/s. */
void fr_spectrum_add(fr_road_spectrum *spectrum, double elevation_m, double travel_m, double moved,
                     double turned);

/* Take the road from here on for what it has been; the reading's variance is `reading` at least. */
void fr_spectrum_renew(const fr_road_spectrum *spectrum, double reading, fr_road_model *model);

/* RMS of the second difference over 16 m, at least that of the start. */
double fr_spectrum_bend_m(const fr_road_spectrum *spectrum);

#endif
