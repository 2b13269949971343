/* SPDX-License-Identifier: Apache-2.0
 *
 * Levelling as samples come: what its parts share.
 *
 * Bins wait in a queue. It begins with those that are ready and not yet taken; then come those that
 * may be before a brake that is still to come, or are of the stretch that is open.
 */
#ifndef FR_LEVEL_STAGE_H
#define FR_LEVEL_STAGE_H

#include "level_work.h"
#include "travel.h"

enum { LV_PATHS = 4, LV_SPARE_S = 40, LV_PUSH_S = 20 };

/* A bin with its derivatives. */
typedef struct lv_bin {
    int64_t number, moved; /* moved: bins so far in which the vehicle does */
    double force, missing, height, distance, speed, along;
    int32_t active, outcome;
    double share, pitch, lean, grade, sigma, fitted; /* sums over fits, by their weights */
} lv_bin;

/* One path of a bin that is not complete, and what was known last of its force. */
typedef struct lv_mean {
    double force, height, last;
    int32_t forces, heights;
} lv_mean;

struct fr_level {
    fr_head head;
    fr_level_config config;
    double step_s, furthest_m, counted;
    int64_t first_count, furthest, bins, derived, moved;
    lv_mean mean[LV_PATHS];
    int32_t every, filled, smooth, reach; /* smooth: bins of half a second */
    int32_t ring, after, before, side, window, shared, room;
    int32_t ready, end, taken; /* in the queue: ends of those ready and of all; first not taken */
    int32_t open, first, behind, last; /* of the open stretch, and its last active bin */
    int32_t stood, resting, rest;      /* bins of a standstill; those that may be its last ones */
    int32_t known;                     /* whether the bin before was levelled */
    double held_rad, held_mps2;
    double moved_rad, moved_mps2;
};

/* Where its arrays lie: behind the object. */
typedef struct lv_arrays {
    lv_bin *queue, *rest;
    double *distance, *height, *force, *bell; /* rings of bins that are not derived yet */
    int64_t *number;                          /* of a window, and its columns */
    double *column[6], *pitch, *sigma;
    void *fit;
} lv_arrays;

size_t fr_lv_arrays(const fr_level *level, void *memory, lv_arrays *arrays);

/* Add a sample to its bin; whether that is complete now. */
int fr_lv_add_sample(fr_level *level, lv_arrays *a, const fr_real *force, const fr_real *height,
                     int64_t count);

/* The next bin with its derivatives, if those behind it are there or the run is over. */
int fr_lv_derive_bin(fr_level *level, lv_arrays *a, int at_end, lv_bin *bin);

/* Let a bin into the queue, with what follows from it; the middle of a standstill is left out. */
void fr_lv_take_bin(fr_level *level, lv_arrays *a, const lv_bin *bin);
void fr_lv_end_queue(fr_level *level, lv_arrays *a);

/* Fit the bins of the queue from `first` to before `behind`, and add what was found to them. */
void fr_lv_fit_window(fr_level *level, lv_arrays *a, int32_t first, int32_t behind);

/* What comes out for a bin that is ready. */
void fr_lv_write_bin(fr_level *level, const lv_bin *bin, fr_level_bin *out);

#endif
