/* SPDX-License-Identifier: Apache-2.0
 *
 * What a push will bring: nodes, updates and points follow from counts, heights that are missing
 * and readings that wait alone, so that a push that has no room is refused before it begins.
 */
#ifndef FR_KALMAN_FORESIGHT_H
#define FR_KALMAN_FORESIGHT_H

#include "kalman_engine.h"
#include "lag_clock.h"
#include "points.h"

/* Samples of a push; NULL and 0 at the end of a run. */
typedef struct fr_kalman_push_of {
    const double *height;
    const int64_t *counts;
    size_t count;
} fr_kalman_push_of;

/* FR_OK if the next `ready` samples can be filtered, with how many points that gives out; and
 * FR_BAD_SAMPLE if the encoder leaps over more points than are held. */
fr_status fr_kalman_foresee(const fr_kalman_engine *engine, void *room, const fr_points *points,
                            const fr_lag_clock *clock, const fr_lag_pace *pace,
                            const fr_kalman_push_of *push, size_t ready, size_t *given_out);

/* How many points a run that ends now still gives out. */
size_t fr_kalman_foresee_end(const fr_kalman_engine *engine, void *room, const fr_points *points,
                             const fr_lag_clock *clock);

#endif
