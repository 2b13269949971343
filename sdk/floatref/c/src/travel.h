/* SPDX-License-Identifier: Apache-2.0
 *
 * Travel speed inside other objects; the ring of past counts lies where its owner says.
 */
#ifndef FR_TRAVEL_H
#define FR_TRAVEL_H

#include "samples.h"

/* Counts beyond this are not exact to a double, and their differences might overflow. */
#define FR_MOST_COUNTS ((int64_t)1 << 50)

typedef struct fr_travel {
    uint32_t window; /* samples */
    uint32_t oldest; /* index in the ring */
    int32_t started, back;
    int32_t missing;  /* whether counts may be missing */
    uint32_t unknown; /* samples until the window has no missing count */
    int64_t furthest;
    fr_real metres_per_count, duration_s;
    fr_real held; /* speed while it is unknown */
} fr_travel;

/* Samples of the window; 0 if the configuration is not possible. */
uint32_t fr_travel_window(const fr_travel_speed_config *config);

void fr_travel_set(fr_travel *travel, const fr_travel_speed_config *config);

/* Whether counts are in range and do not go back, unless that is allowed. */
fr_status fr_check_counts(const int64_t *counts, size_t count, int32_t back, int64_t furthest);
/* The same, where counts behind the first one of a run may be missing. */
fr_status fr_check_known_counts(const int64_t *counts, size_t count, int32_t back,
                                int64_t furthest);
fr_status fr_travel_check(const fr_travel *travel, const int64_t *counts, size_t count);

/* Write the speeds of samples `first` to `first + size - 1` of `counts`; only what is unknown of
 * them is remembered. */
void fr_travel_speeds(fr_travel *travel, const int64_t *ring, const int64_t *counts,
                      size_t first, size_t size, fr_real *speed);

/* Remember the counts of a push whose speeds have been computed. */
void fr_travel_keep(fr_travel *travel, int64_t *ring, const int64_t *counts, size_t count);

#endif
