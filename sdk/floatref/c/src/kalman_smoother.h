/* SPDX-License-Identifier: Apache-2.0
 *
 * The object of the Kalman smoother: the filter, and the machinery that smooths with a fixed lag.
 */
#ifndef FR_KALMAN_SMOOTHER_H
#define FR_KALMAN_SMOOTHER_H

#include "kalman_backward.h"
#include "kalman_foresight.h"

/* Where the filter is, as points and nodes need it. */
typedef struct fr_kalman_progress {
    double height, velocity; /* filtered, at the latest node */
    double elevation;        /* of the latest sample, before it is smoothed */
    int64_t node;            /* sample of the latest node */
    int64_t furthest;        /* largest count so far */
    int64_t segment;         /* samples of the SDK's segments, which end with a mark */
    int32_t flags;           /* of the next point */
    int32_t reserved;
} fr_kalman_progress;

struct fr_kalman {
    fr_head head;
    fr_kalman_engine engine;
    fr_lag lag;
    fr_lag_clock clock;
    fr_points points;
    fr_kalman_progress progress;
};

/* The object with its two rooms, made anew in each call. */
typedef struct fr_kalman_view {
    fr_kalman *kalman;
    void *room;
    fr_lag_model model;
    fr_lag_view lag;
} fr_kalman_view;

/* Hand over what comes of a sample: its points, and the node that it may be. Points that are old
 * enough come out. */
void fr_kalman_hand_over(const fr_kalman_view *view, const fr_kalman_step *step,
                         const fr_kalman_node *node, fr_lag_output *output);

/* Make a node of the last sample of a run, unless it is one, and give out all that is left. */
void fr_kalman_hand_over_end(const fr_kalman_view *view, fr_lag_output *output);

#endif
