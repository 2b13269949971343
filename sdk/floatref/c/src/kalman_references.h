/* SPDX-License-Identifier: Apache-2.0
 *
 * What the Kalman filter observes when: GNSS, constants in its place, the height at a stop.
 */
#ifndef FR_KALMAN_REFERENCES_H
#define FR_KALMAN_REFERENCES_H

#include "kalman.h"

enum { FR_K_SECONDS = 4 };

/* A usable GNSS reading: height, velocity, pitch and roll, all but the height NaN where missing,
 * and their variances, NaN for those of the settings. */
typedef struct fr_kalman_reading {
    int64_t at;
    double y[FR_K_KINDS], variance[FR_K_KINDS];
} fr_kalman_reading;

/* A sample as it was pushed, gravity removed; missing inputs are NaN. */
typedef struct fr_kalman_sample {
    fr_kalman_input input;
    double height;
} fr_kalman_sample;

/* What the schedule remembers depends on samples and readings that came before alone. */
typedef struct fr_kalman_references {
    double reading[FR_K_KINDS], constant[FR_K_KINDS]; /* variances, of constants over a second */
    double usual_pitch, usual_roll; /* of constants as often as usual readings */
    double walk, reflection;        /* variance of the GNSS height in a second, of the height */
    double step, arm_up, reflection_speed;
    double datum, start, origin; /* of GNSS heights, the first height, and that of a stop */
    double travelled[FR_K_SECONDS + 1]; /* distance at the latest seconds, in m */
    int64_t latest, observed; /* latest reading, and the latest whose height was observed */
    int64_t before;           /* sample of the latest reading, -1 before the first */
    int64_t last_at;          /* latest observation, with its mark */
    int64_t sub_block, patience, second;
    int32_t last_mark, seconds;
    int32_t gnss, attitude, reflects;
    int32_t holds; /* whether constants have been observed since the latest height of GNSS */
    int32_t has_datum, stands;
} fr_kalman_references;

/* Fill in what the configuration says; the model has been set. */
void fr_kalman_references_set(fr_kalman_references *references, const fr_kalman_model *model,
                              const fr_kalman_filter_config *config);

/* Say what is observed at a sample, at its height, travel speed and distance in m; 0 if nothing is.
 * The reading is NULL where there is none. */
int fr_kalman_schedule(fr_kalman_references *references, int64_t at, double height, double speed,
                       double distance_m, const fr_kalman_reading *reading,
                       fr_kalman_observation *out);

/* Say what to observe at the last sample of a run, where constants count for what is left of their
 * sub-block, and for less than nothing if that is short; 0 if nothing. */
int fr_kalman_schedule_end(const fr_kalman_references *references, int64_t at,
                           fr_kalman_observation *out);

#endif
