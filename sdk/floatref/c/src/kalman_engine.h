/* SPDX-License-Identifier: Apache-2.0
 *
 * The Kalman filter of one wheel path with all that it needs around it: the wait for late GNSS
 * readings, travel speed, the schedule of observations. Its arrays lie in the room that the owner
 * gives: counts, samples and readings that wait.
 */
#ifndef FR_KALMAN_ENGINE_H
#define FR_KALMAN_ENGINE_H

#include "kalman_references.h"
#include "travel.h"

/* Settings, inputs and readings are no larger than this in SI units, and what divides is no smaller
 * than the other. */
#define FR_K_LARGEST 1e9
#define FR_K_SMALLEST 1e-9

typedef struct fr_kalman_engine {
    fr_kalman_model model;
    fr_kalman_references references;
    fr_kalman_state state;
    double metres_per_count, duration_s; /* of the window of the travel speed */
    int64_t pushed, first, furthest; /* samples, the first count, and the largest one */
    uint32_t window, delay;          /* samples: of that window, and that wait for late readings */
    uint32_t room, held;             /* readings that may wait, and that do */
    int32_t missing, back;
} fr_kalman_engine;

/* What comes of one sample, in order. */
typedef struct fr_kalman_step {
    double reference_height, height; /* in m, the height NaN if it is missing */
    int64_t at, count;
    int32_t missing; /* whether an input of the inertial unit was */
    int32_t is_node; /* whether a node has been made */
} fr_kalman_step;

/* Whether settings are possible, samples that wait for late readings, and the model. */
int fr_kalman_is_possible(const fr_kalman_filter_config *config);
uint32_t fr_kalman_delay(const fr_kalman_filter_config *config);
void fr_kalman_model_set(fr_kalman_model *model, const fr_kalman_filter_config *config);

/* Bytes of its arrays; 0 for a configuration that is not possible. */
size_t fr_kalman_engine_room(const fr_kalman_filter_config *config);

/* The same of one that has been set. */
size_t fr_kalman_engine_bytes(const fr_kalman_engine *engine);

/* Nodes in a second that end a sub-block. */
double fr_kalman_nodes_hz(const fr_kalman_filter_config *config);

void fr_kalman_engine_set(fr_kalman_engine *engine, const fr_kalman_filter_config *config);

/* Travel speed in m/s at a sample, and its count: the ring of counts goes back far enough. */
double fr_kalman_engine_speed(const fr_kalman_engine *engine, const void *room, int64_t at);
int64_t fr_kalman_engine_count(const fr_kalman_engine *engine, const void *room, int64_t at);

/* Height of a sample that waits. */
double fr_kalman_engine_height(const fr_kalman_engine *engine, void *room, int64_t at);

/* FR_OK if the samples of a push can be taken. */
fr_status fr_kalman_engine_check(const fr_kalman_engine *engine, const fr_imu *imu,
                                 const double *height, const int64_t *counts, size_t count);

/* Take a sample of a push that has been checked. Returns 1 if a sample has been filtered, that of
 * `delay` samples before, with what comes of it. */
int fr_kalman_engine_take(fr_kalman_engine *engine, void *room, const fr_kalman_sample *sample,
                          int64_t count, fr_kalman_step *step, fr_kalman_node *node);

/* Filter the next of the samples that still wait at the end of a run; 0 if all are filtered. */
int fr_kalman_engine_drain(fr_kalman_engine *engine, void *room, fr_kalman_step *step,
                           fr_kalman_node *node);

/* The readings that wait, in the order of their samples. */
fr_kalman_reading *fr_kalman_readings(const fr_kalman_engine *engine, void *room);

/* How many samples `count` more would let out. */
size_t fr_kalman_engine_ready(const fr_kalman_engine *engine, size_t count);

/* Number of samples that still wait. */
size_t fr_kalman_engine_waiting(const fr_kalman_engine *engine);

/* Hold a GNSS reading until its sample is filtered. */
fr_status fr_kalman_engine_read(fr_kalman_engine *engine, void *room, int64_t sample,
                                const double *values, const double *variances);

/* Readings of each kind that were left out. */
fr_status fr_kalman_engine_left_out(const fr_kalman_engine *engine, int64_t *count);

/* Sample i of a push, gravity removed. */
fr_kalman_sample fr_kalman_sample_of(const fr_kalman_engine *engine, const fr_imu *imu,
                                     const double *height, size_t i);

#endif
