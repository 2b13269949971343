/* SPDX-License-Identifier: Apache-2.0
 *
 * Longitudinal acceleration from the encoder, without phase, and the pitch response to it.
 */
#ifndef FR_ROAD_EXCITATION_H
#define FR_ROAD_EXCITATION_H

#include "object.h"

typedef struct fr_excitation {
    double by[2][4];            /* what the next response and rate are made of */
    double fade;                /* of a brake from node to node where places are not known */
    double value, rate, latest; /* response in m/s^2, its rate, acceleration at the last node */
    int64_t nodes;              /* places so far */
    int32_t reach;              /* nodes to either side that an acceleration needs */
    int32_t known;              /* of these, behind the first node of the run */
} fr_excitation;

/* Nodes to either side, for nodes `interval_s` apart. */
int32_t fr_excitation_reach(double interval_s);

/* Numbers of its two arrays: weights, and a ring of places. */
static inline size_t fr_excitation_numbers(int32_t reach)
{
    return 2u * (2u * (size_t)reach + 1u);
}

void fr_excitation_begin(fr_excitation *excitation, double *room, double interval_s, double hz,
                         double damping);

/* Take the distance in m of the next node, NaN where it is not known. */
void fr_excitation_add(fr_excitation *excitation, double *room, double place_m);

/* Acceleration and response at node k, in order: after `reach` more places, or at the end of the
 * run, behind which the distances go on turned about the last one. Where a place that it needs is
 * not known, the acceleration is that of the node before, and fades. */
void fr_excitation_take(fr_excitation *excitation, const double *room, int64_t k, double *along,
                        double *response);

#endif
