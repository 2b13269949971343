/* SPDX-License-Identifier: Apache-2.0
 *
 * The pitch of one window: it changes the road by which it is found, so it is found three times.
 */
#include <string.h>

#include "bell.h"
#include "bins.h"
#include "pitch.h"

enum { PITCH_PASSES = 3 };

static void set_along(const fr_pitch *pitch, const pt_arrays *a, int32_t count)
{
    fr_bell bell = {a->bell, a->distance, pitch->reach, count, count};
    for (int32_t k = 0; k < count; k++)
        a->along[k] = fr_bell_along(&bell, k);
}

/* Road and reading in the band, by the pitch so far. */
static void set_road(const fr_pitch *pitch, pt_arrays *a, int32_t count)
{
    for (int32_t k = 0; k < count; k++) {
        a->road[k] = a->force[k] + a->along[k] * a->pitch[k];
        a->measured[k] = a->road[k];
    }
    fr_pt_height_of(&pitch->band, a->road, count);
    fr_pt_pass_band(&pitch->band, a->measured, count);
    fr_pt_pass_band(&pitch->band, a->pitch, count);
    for (int32_t k = 0; k < count; k++)
        a->road[k] += pitch->config.lever_m * a->pitch[k] - a->height[k];
}

void fr_pt_model_window(const fr_pitch *pitch, pt_arrays *a, int32_t count)
{
    int known = count >= FR_LEAST_BINS && fr_pt_read_window(pitch, a, count) != 0;
    (void)memset(a->pitch, 0, (size_t)count * sizeof *a->pitch);
    if (known == 0)
        return;
    set_along(pitch, a, count);
    fr_pt_pass_band(&pitch->band, a->height, count);
    for (int32_t pass = 0; known != 0 && pass < PITCH_PASSES; pass++) {
        set_road(pitch, a, count);
        known = fr_pt_smooth(pitch, a, count);
    }
    if (known == 0)
        (void)memset(a->pitch, 0, (size_t)count * sizeof *a->pitch);
}
