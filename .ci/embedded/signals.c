/* SPDX-License-Identifier: Apache-2.0 */
#include "signals.h"

#define MM_PER_S 20000

/* A number of 24 bits around zero: exact in float. */
static fr_real drawn(signals *s)
{
    s->seed = s->seed * 1664525u + 1013904223u;
    return (fr_real)((int32_t)(s->seed >> 8) - 0x800000);
}

void signals_next(signals *s, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        s->force[i] = drawn(s) * (fr_real)(1.0 / 4194304.0);           /* within 2 m/s^2 */
        s->height[i] = (fr_real)0.25 + drawn(s) * (fr_real)(1.0 / 268435456.0); /* and 31 mm */
        s->speed[i] = (fr_real)20 + drawn(s) * (fr_real)(1.0 / 8388608.0);
        s->cutoff[i] = (fr_real)0.25 + drawn(s) * (fr_real)(1.0 / 268435456.0);
        s->step[i] = (fr_real)0.0625 + drawn(s) * (fr_real)(1.0 / 268435456.0);
        s->counts[i] = s->sample * MM_PER_S / (int64_t)s->rate;
        s->sample++;
    }
}
