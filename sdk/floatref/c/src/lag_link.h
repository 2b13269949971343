/* SPDX-License-Identifier: Apache-2.0
 *
 * How errors pass on from mark to mark, forward: x -> Psi x, what the readings on the way say of
 * lambda, and lambda itself, lambda before = Psi' lambda behind + pushed.
 */
#ifndef FR_LAG_LINK_H
#define FR_LAG_LINK_H

#include "lag_layout.h"

/* Nothing since the last mark: Psi = I. */
void fr_lag_link_clear(fr_lag_link *link, int32_t states);

/* One scalar update behind what has been linked. */
void fr_lag_link_update(fr_lag_link *link, int32_t states, const double *gain, const double *row,
                        double innovation, double information);

/* Make a mark of what has been linked, with P e_r, and begin anew. */
void fr_lag_link_mark(const fr_lag_view *view, const double *column);

/* Forget marks out of reach behind the one at which the sections begin, and every second of the
 * others where they are too many: what these have linked goes to the mark behind them. */
void fr_lag_link_forget(const fr_lag_view *view, int64_t begin);

/* found <- a' vector of a square matrix, row by row; and vector <- a vector in place. */
void fr_lag_turn(const double *a, const double *vector, int32_t states, double *found);
void fr_lag_apply(const double *a, int32_t states, double *vector);

/* found <- a' found a, by way of scratch. */
void fr_lag_enclose(const double *a, int32_t states, double *found);

#endif
