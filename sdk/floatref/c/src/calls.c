/* SPDX-License-Identifier: Apache-2.0
 *
 * Whether a set of calls is complete: if the acceleration is filtered and the height is not, the
 * motion of the vehicle does not cancel, and the profile looks like one.
 */
#include <string.h>

#include "calls.h"

/* Prime of the hash FNV-1a; it is applied to whole samples. */
#define PRIME UINT64_C(0x100000001b3)

static uint64_t hash_of(const fr_real *speed, size_t count, uint64_t before)
{
    uint64_t hash = before;
    for (size_t i = 0; i < count; i++) {
        uint64_t bits = 0;
        (void)memcpy(&bits, &speed[i], sizeof speed[i]);
        hash = (hash ^ bits ^ (bits >> 32)) * PRIME;
        hash ^= hash >> 29;
    }
    return hash;
}

fr_status fr_calls_check(const fr_calls *calls, int signal, size_t count)
{
    int early = signal == FR_VELOCITY &&
                calls->counts[FR_VELOCITY] + count > calls->counts[FR_ACCELERATION];
    return early ? FR_WRONG_ORDER : FR_OK;
}

void fr_calls_add(fr_calls *calls, int signal, const fr_real *speed, size_t count)
{
    calls->counts[signal] += count;
    if (speed != NULL)
        calls->speeds[signal] = hash_of(speed, count, calls->speeds[signal]);
}

fr_status fr_calls_complete(const fr_calls *calls)
{
    uint64_t count = calls->counts[FR_ACCELERATION], speed = calls->speeds[FR_ACCELERATION];
    if (count == 0u || calls->counts[FR_VELOCITY] != count || calls->counts[FR_HEIGHT] != count)
        return FR_INCOMPLETE_SET;
    if (calls->speeds[FR_VELOCITY] != speed || calls->speeds[FR_HEIGHT] != speed)
        return FR_OTHER_SPEED;
    return FR_OK;
}

fr_status fr_calls_complete_in_time(const fr_calls *calls, const fr_real *speed, size_t count)
{
    fr_status status = fr_calls_complete(calls);
    if (status == FR_OK && calls->counts[FR_ACCELERATION] != count)
        status = FR_INCOMPLETE_SET;
    if (status == FR_OK && speed != NULL &&
        hash_of(speed, count, 0u) != calls->speeds[FR_ACCELERATION])
        status = FR_OTHER_SPEED;
    return status;
}

fr_status fr_check_profile(const fr_real *profile, size_t count, int32_t missing)
{
    fr_status status = fr_check_samples(profile, count, missing);
    size_t known = 0;
    if (status != FR_OK || count == 0u)
        return status;
    while (known < count && fr_missing(profile[known]))
        known++;
    return known < count ? FR_OK : FR_BAD_SAMPLE;
}
