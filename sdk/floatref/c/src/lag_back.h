/* SPDX-License-Identifier: Apache-2.0
 *
 * The backward pass over the nodes of a section, Bryson and Frazier: x_s = x - P lambda.
 */
#ifndef FR_LAG_BACK_H
#define FR_LAG_BACK_H

#include "lag_layout.h"

/* What is added to height and velocity at a node, behind its updates. */
typedef struct fr_lag_correction {
    double height, velocity;
} fr_lag_correction;

/* lambda behind the last mark -> lambda behind mark `end - 1`. */
void fr_lag_back_marks(const fr_lag_view *view, int64_t end, double *lambda);

/* lambda behind the last node of a section -> lambda behind the node before its first. The first
 * two numbers of each node's rows become its correction. */
void fr_lag_back_nodes(const fr_lag_view *view, int32_t place, double *lambda);

/* -P lambda of height and velocity by the rows of a covariance. */
fr_lag_correction fr_lag_correct(const double *rows, int32_t states, const double *lambda);

#endif
