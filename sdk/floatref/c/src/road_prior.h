/* SPDX-License-Identifier: Apache-2.0
 *
 * The object of the road-prior smoother, and its three parts: samples, nodes, calls.
 *
 * A sample is summed up into the integrals of its span and is gone. A node waits for the encoder
 * behind it, and is then filtered and handed to the fixed-lag smoother.
 */
#ifndef FR_ROAD_PRIOR_H
#define FR_ROAD_PRIOR_H

#include "points.h"
#include "road_excitation.h"
#include "road_spectrum.h"

#define FR_ROAD_MAGIC FR_MAGIC(14)

enum { FR_QUIET_SECONDS = 4 };

/* A node that waits for the encoder. */
typedef struct fr_road_waiting {
    double span, once, twice; /* integrals of the acceleration over the span before */
    double place_m, seen, missing, level; /* place_m: NaN where travel to it is not known */
    double distance_m;                    /* by the last count that there was */
    int64_t points; /* reached before it */
    int32_t kind, anew;
} fr_road_waiting;

/* Integrals since the node before, and the sample before. */
typedef struct fr_road_motion {
    double height, velocity, latest; /* twice and once integrated, and the last acceleration */
    double elevation;                /* height less that of the sensor, at the last sample */
    double seen;                     /* the last height that there was */
    int32_t steps;                   /* since the node */
    int32_t lost;                    /* samples without an acceleration since the node */
    int32_t flags;                   /* of the next point */
    int32_t height_missing;          /* whether the last sample had none */
    int32_t uncounted;               /* samples without a count since the node */
} fr_road_motion;

/* What decides how many points come out: counts alone. */
typedef struct fr_road_progress {
    fr_points points;
    fr_lag_clock clock;
    int64_t reached; /* points */
    int32_t until;   /* samples to the next node */
} fr_road_progress;

struct fr_road_prior {
    fr_head head;
    int32_t missing, back;
    int32_t sub_block;   /* samples between two nodes */
    int32_t per_second;  /* nodes */
    int32_t travelled;   /* seconds of which the distance is known, at most one more than four */
    int32_t reserved;
    int64_t segment;     /* samples of a segment, which ends with a mark */
    int64_t nodes;       /* that samples have made */
    int64_t filtered;    /* of these */
    int64_t count;       /* the last one of the encoder that there was */
    int64_t furthest;    /* the largest */
    double step, gravity, metres_per_count;
    double reading;      /* least variance of a reading */
    double most_share;   /* of the bend, above which a 1-sigma is too large */
    double largest;      /* that 1-sigma at present */
    double place_m;      /* of the last node that is filtered, NaN where not known */
    double pace_m;       /* travel to that node */
    double seconds_m[FR_QUIET_SECONDS + 1]; /* distances at whole seconds, the latest first */
    fr_road_motion motion;
    fr_road_progress progress;
    fr_excitation excitation;
    fr_road_model model;
    fr_road_filter filter;
    fr_road_spectrum spectrum;
    fr_lag lag;
};

/* Samples of one push; `level` and `share` may be NULL. */
typedef struct fr_road_input {
    const fr_real *acceleration, *height;
    const int64_t *counts;
    const fr_real *level, *share;
    size_t count;
} fr_road_input;

/* Arrays behind the object: of the excitation, nodes that wait, then those of the smoother. */
double *fr_road_room(fr_road_prior *road);
fr_road_waiting *fr_road_waiting_at(fr_road_prior *road, int64_t node);
fr_lag_view fr_road_view(fr_road_prior *road);
#define FR_WAITING_NUMBERS (sizeof(fr_road_waiting) / sizeof(double))

/* How many points come out of a push; FR_BAD_SAMPLE where the encoder leaps too far. */
fr_status fr_road_foresee(const fr_road_prior *road, const int64_t *counts, size_t count,
                          size_t *needed);

void fr_road_samples(fr_road_prior *road, const fr_road_input *input, fr_lag_output *output);

/* Filter a node whose acceleration along the road is known. */
void fr_road_filter_next(fr_road_prior *road, fr_lag_output *output);

/* Filter what waits, and a node at the last sample unless it is one; give out all that is left. */
void fr_road_end(fr_road_prior *road, fr_lag_output *output);

#endif
