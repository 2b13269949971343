/* Samples of all wheel paths that wait until they are level. */
#ifndef WAITING_H
#define WAITING_H

#include "firmware.h"

enum { MOST_LEVELLED = 4 };

/* Samples by their number in the run: those before `known` have a count, those before `pushed` are
   given to the levelling, and those before `sent` are level and with the smoother. */
struct waiting {
    size_t taken, known, pushed, sent;
    int64_t *counts;
    fr_real *force[MOST_LEVELLED], *height[MOST_LEVELLED];
    struct path *path[MOST_LEVELLED];
    fr_level *level;
    int64_t every;               /* samples of a bin */
    fr_level_bin before, behind; /* samples between their middles are next */
    bool begun, ended;
};

/* Memory for the samples of a run: FR_TOO_SMALL if there is no more, FR_BAD_CONFIG for more wheel
   paths than can be levelled. */
fr_status begin_waiting(struct vehicle *vehicle);
fr_status add_waiting(struct path *path);

/* Store samples of a path behind those that are taken, NaN where a sensor measures nothing. */
void store(struct path *path, const fr_real *force, const fr_real *height, size_t count);

/* Store the counts of the same samples, behind those of all paths: a line where some are missing. */
void store_counts(struct waiting *waiting, const int64_t *counts, size_t count);

/* The next `count` samples of all paths, those of one time beside each other. */
void interleave(const struct waiting *waiting, size_t paths, size_t count, fr_real *force,
                fr_real *height);

/* The end of a run: the last count holds. */
void end_counts(struct waiting *waiting);

#endif
