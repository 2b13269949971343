/* SPDX-License-Identifier: Apache-2.0
 *
 * The fits of windows, added up over the bins that they share, and what comes out of them.
 */
#include <math.h>

#include "level_model.h"
#include "level_stage.h"

#define RAMP_S 1.0
#define LEVELLED_LEAN (1.0 / 3.0)

/* The arrays of a window, as a fit takes them. */
static fr_level_bins columns_of(const lv_arrays *a, int32_t first, int32_t behind)
{
    fr_level_bins bins = {a->number,    a->column[0], a->column[1], a->column[2],
                          a->column[3], a->column[4], a->column[5], 0u};
    bins.count = (size_t)(behind - first);
    for (int32_t i = 0; i < behind - first; i++) {
        const lv_bin *bin = &a->queue[first + i];
        a->number[i] = bin->number;
        a->column[0][i] = bin->force;
        a->column[1][i] = bin->missing;
        a->column[2][i] = bin->height;
        a->column[3][i] = bin->distance;
        a->column[4][i] = bin->speed;
        a->column[5][i] = bin->along;
    }
    return bins;
}

/* The correction comes and goes within a second at the ends of a window. */
static double ramp(const fr_level *level, int64_t from_begin, int64_t from_end)
{
    double width = fmax(1.0, rint(RAMP_S / level->step_s));
    int64_t near = from_begin < from_end ? from_begin : from_end;
    return fmin(((double)near + 1.0) / width, 1.0);
}

static void add_fit(lv_bin *bin, const fr_level_result *result, double weight, double pitch)
{
    bin->share += weight;
    bin->pitch += weight * pitch;
    bin->lean += weight * result->vehicle[LV_LEAN];
    bin->grade += weight * result->grade;
}

void fr_lv_fit_window(fr_level *level, lv_arrays *a, int32_t first, int32_t behind)
{
    fr_level_bins bins = columns_of(a, first, behind);
    fr_level_result result;
    int64_t begin = a->number[0], end = a->number[bins.count - 1u];
    lv_work work;
    (void)fr_lv_lay_out(&work, &level->config.fit, a->fit);
    fr_lv_fit_bins(&work, &bins, &result, a->pitch, a->sigma);
    for (int32_t i = 0; i < behind - first; i++) {
        lv_bin *bin = &a->queue[first + i];
        double weight = ramp(level, bin->number - begin, end - bin->number);
        bin->fitted += weight;
        bin->sigma += weight * a->sigma[i];
        bin->outcome = bin->outcome > result.outcome ? bin->outcome : result.outcome;
        if (result.outcome == FR_LEVEL_FOUND)
            add_fit(bin, &result, weight, a->pitch[i]);
    }
}

/* What a pitch on top of a lean adds to the force of an accelerometer that leans. */
static double climb_of(double pitch, double lean)
{
    return 0.5 * LV_GRAVITY * ((pitch + lean) * (pitch + lean) - lean * lean);
}

/* Pitch and climb go on from those before: a step of either would be one of the profile, and a
 * constant is none. Away from brakes they stay as they were. */
static void hold(fr_level *level, int known, double pitch, double climb)
{
    if (known != 0 && level->known == 0) {
        level->moved_rad = level->held_rad - pitch;
        level->moved_mps2 = level->held_mps2 - climb;
    }
    if (known != 0) {
        level->held_rad = pitch + level->moved_rad;
        level->held_mps2 = climb + level->moved_mps2;
    }
    level->known = known;
}

void fr_lv_write_bin(fr_level *level, const lv_bin *bin, fr_level_bin *out)
{
    int known = bin->share > 0.0;
    double pitch = known != 0 ? bin->pitch / bin->share : 0.0;
    double lean = known != 0 ? bin->lean / bin->share : 0.0;
    double grade = known != 0 ? bin->grade / bin->share : 0.0;
    double expected = LEVELLED_LEAN * level->config.fit.lean_rad;
    hold(level, known, pitch, climb_of(pitch, lean));
    out->first = bin->number * (int64_t)level->every;
    out->share = fmin(bin->share, 1.0);
    out->added = out->share * bin->along * (pitch + lean - grade - expected) + level->held_mps2;
    out->sin_pitch = sin(level->held_rad);
    out->sigma_m = bin->sigma / fmax(bin->fitted, 1.0);
    out->outcome = bin->outcome;
    out->reserved = 0;
}
