/* SPDX-License-Identifier: Apache-2.0
 *
 * The forward pass of the road-prior smoother at one node, in the order of the SDK's kernel.
 *
 * States are height r, velocity v, bias b, clearance d = r - z above the road z, its slope s and the
 * coefficients k of two inputs u, with r'' = a - b - k u, and z and s processes of the distance
 * travelled; a reading of the height sensor is d. The road itself is no state: r and z are unknown
 * by a metre, and known to a tenth of a millimetre against each other.
 */
#ifndef FR_ROAD_FILTER_H
#define FR_ROAD_FILTER_H

#include "fixed_lag.h"

enum { FR_ROAD_STATES = 7, FR_ROAD_OWN = 7 };
enum { ROAD_R = 0, ROAD_V = 1, ROAD_BIAS = 2, ROAD_D = 3, ROAD_SLOPE = 4, ROAD_LEAN = 5, ROAD_TILT = 6 };

/* What sensors, vehicle and road are taken for; variances and squares of densities. */
typedef struct fr_road_model {
    double white, walk, walk_along, gap, reading;
    double road, slope, reach;
    double lean, tilt, lean_prior, tilt_prior, edge;
} fr_road_model;

typedef struct fr_road_filter {
    double x[FR_ROAD_STATES];
    double p[FR_ROAD_STATES][FR_ROAD_STATES];
    double leaning, tilting, along; /* at the last node */
    double still;                   /* s for which the vehicle has not moved */
} fr_road_filter;

/* What is known at a node: both inputs, acceleration along the road, travel in m, a reading of the
 * height sensor in m (NaN: missing), the share of samples missing since the node before, and
 * whether lean and tilt begin anew; of the acceleration its integrals over `span` s. */
typedef struct fr_road_ends {
    double leaning, tilting, along, travel, seen, missing;
    double span, once, twice;
    int32_t anew;
} fr_road_ends;

/* What a node leaves for the backward pass: numbers of its own, and its update if it has one. */
typedef struct fr_road_node {
    double own[FR_ROAD_OWN];
    double gain[FR_ROAD_STATES];
    double error, innovation, information; /* y, y/S and 1/S */
    double rise, climb;
    int32_t updated, let_go;
} fr_road_node;

/* The smoother's functions of this filter. */
extern const fr_lag_model fr_road_lag_model;

void fr_road_step(const fr_road_model *model, fr_road_filter *filter, const fr_road_ends *ends,
                  fr_road_node *node);

#endif
