/* SPDX-License-Identifier: Apache-2.0
 *
 * Calls that belong together: samples of each signal so far, and missing ones at the end.
 */
#ifndef FR_CALLS_H
#define FR_CALLS_H

#include "samples.h"

enum { FR_ACCELERATION = 0, FR_VELOCITY = 1, FR_HEIGHT = 2, FR_SIGNALS = 3 };

typedef struct fr_calls {
    uint64_t counts[FR_SIGNALS]; /* samples */
    uint64_t speeds[FR_SIGNALS]; /* hash of the speeds given with them */
} fr_calls;

/* FR_WRONG_ORDER for a velocity before the acceleration that it is the integral of. */
fr_status fr_calls_check(const fr_calls *calls, int signal, size_t count);

/* Count samples, and the speeds given with them or NULL. */
void fr_calls_add(fr_calls *calls, int signal, const fr_real *speed, size_t count);

/* FR_OK if all signals have equally many samples, more than 0, at the same speeds. */
fr_status fr_calls_complete(const fr_calls *calls);

/* The same, and a profile of all samples at that speed, or at any if it is NULL. */
fr_status fr_calls_complete_in_time(const fr_calls *calls, const fr_real *speed, size_t count);

/* FR_BAD_SAMPLE for a profile that is infinite, or not known anywhere. */
fr_status fr_check_profile(const fr_real *profile, size_t count, int32_t missing);

#endif
