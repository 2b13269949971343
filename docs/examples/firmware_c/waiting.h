/* Samples of all wheel paths that wait until they are level, and their pitch is known. */
#ifndef WAITING_H
#define WAITING_H

#include "firmware.h"

enum { MOST_LEVELLED = 4 };

/* Samples by their number in the run: of those before `known` the way is known, those before `pushed`
   are given to the levelling, and those before `sent` are level and with the smoother. */
struct waiting {
    size_t taken, known, pushed, sent;
    int64_t *counts;             /* of the encoder, FR_NO_COUNT where it is wrong */
    int64_t *travelled;          /* the way of the vehicle */
    int64_t miscounted;          /* what the counts are beyond it */
    size_t resumed;              /* the first count behind a gap that is not bridged yet; or 0 */
    size_t beside, longest;      /* samples whose mean is the speed beside a gap; of a short one */
    fr_real *force[MOST_LEVELLED], *height[MOST_LEVELLED];
    struct path *path[MOST_LEVELLED];
    fr_level *level;
    int64_t every;               /* samples of a bin */
    fr_level_bin *bins;          /* all of the run, of which `levelled` are there */
    size_t room, levelled, joined;
    fr_level_bin before, behind; /* samples between their middles are next */
    size_t number;               /* of bin `behind` in the run */
    bool begun, ended;
    fr_pitch *pitch;             /* NULL where all lasers are at their accelerometers */
    size_t pitched;              /* bins that the model has reached */
    double *moved, held;         /* what it moves sin of the pitch by, up to `behind`; then that itself */
};

/* Memory for the samples of a run: FR_TOO_SMALL if there is no more, FR_BAD_CONFIG for more wheel
   paths than can be levelled. */
fr_status begin_waiting(struct vehicle *vehicle, double rate_hz);
fr_status add_waiting(struct path *path);

/* Store samples of a path behind those that are taken, NaN where a sensor measures nothing.
   FR_BAD_SAMPLE where the first count of the run is missing: no way leads from there. */
fr_status store(struct path *path, const fr_real *force, const fr_real *height, const int64_t *counts,
                size_t count);

/* Counts of the same samples, behind those of all paths. Levelling and the pitch of the model take the
   way of the vehicle: a leap would be a brake to them. */
void begin_travelled(struct waiting *waiting, double rate_hz);
void store_counts(struct waiting *waiting, const int64_t *counts, size_t count);

/* The next `count` samples of all paths, those of one time beside each other. */
void interleave(const struct waiting *waiting, size_t paths, size_t count, fr_real *force,
                fr_real *height);

/* Memory for all bins of a run, and the model of the pitch if a laser is on a lever. */
fr_status begin_pitch(struct vehicle *vehicle, const struct path *path);

/* Give the model samples of all wheel paths, and take the bins that are ready. */
fr_status model_pitch(struct waiting *waiting, const fr_real *force, const fr_real *height,
                      const int64_t *counts, size_t count);
fr_status end_pitch(struct waiting *waiting);

/* Let `behind` be the next bin, if its pitch is known. */
bool next_bin(struct waiting *waiting);

/* By how much the model has moved the sine of the pitch at sample number `i`. */
double moved_pitch(const struct waiting *waiting, size_t i);

/* At the end of a run: across counts that were lost or made up the elevation goes on at its grade. */
fr_status cross_seams(const struct waiting *waiting, const struct path *path);

/* The end of a run: behind the last count the vehicle is where it was. */
void end_counts(struct waiting *waiting);

#endif
