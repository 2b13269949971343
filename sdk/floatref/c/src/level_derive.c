/* SPDX-License-Identifier: Apache-2.0
 *
 * Bins from samples, and their speed and acceleration along the road, which need bins behind them.
 */
#include "bell.h"
#include "bins.h"
#include "level_model.h"
#include "level_stage.h"

static int32_t place_in(const fr_level *level, int64_t bin)
{
    return (int32_t)(bin % (int64_t)level->ring);
}

/* The height of all wheel paths together; not known unless all are. */
static void close_bin(fr_level *level, lv_arrays *a)
{
    int32_t at = place_in(level, level->bins), paths = level->config.paths;
    double height = 0.0;
    double way = level->counted / (double)level->every * level->config.metres_per_count;
    for (int32_t p = 0; p < paths; p++) {
        lv_mean *mean = &level->mean[p];
        a->force[at * paths + p] = fr_close_mean(mean->force, mean->forces, level->every);
        height += fr_close_mean(mean->height, mean->heights, level->every);
        mean->force = 0.0;
        mean->height = 0.0;
        mean->forces = 0;
        mean->heights = 0;
    }
    level->furthest_m = level->bins > 0 ? fmax(level->furthest_m, way) : way;
    a->height[at] = height / (double)paths;
    a->distance[at] = level->furthest_m;
    level->filled = 0;
    level->counted = 0.0;
    level->bins++;
}

int fr_lv_add_sample(fr_level *level, lv_arrays *a, const fr_real *force, const fr_real *height,
                     int64_t count)
{
    if (level->bins == 0 && level->filled == 0)
        level->first_count = count;
    for (int32_t p = 0; p < level->config.paths; p++) {
        fr_add_known(&level->mean[p].force, &level->mean[p].forces, force[p]);
        fr_add_known(&level->mean[p].height, &level->mean[p].heights, height[p]);
    }
    level->counted += (double)(count - level->first_count);
    level->filled++;
    if (level->filled < level->every)
        return 0;
    close_bin(level, a);
    return 1;
}

/* The central difference of the distance, one-sided at the ends of the run. */
static double speed_at(const fr_level *level, const lv_arrays *a, int64_t bin)
{
    int64_t last = level->bins - 1, at = bin < 0 ? 0 : bin;
    int64_t low, high;
    at = at > last ? last : at;
    low = at > 0 ? at - 1 : 0;
    high = at < last ? at + 1 : last;
    if (high == low)
        return 0.0;
    return (a->distance[place_in(level, high)] - a->distance[place_in(level, low)]) /
           ((double)(high - low) * level->step_s);
}

/* The acceleration of a smoothed distance; 0 in a run that is too short for it. */
static double along_at(const fr_level *level, const lv_arrays *a, int64_t bin)
{
    fr_bell bell = {a->bell, a->distance, level->reach, level->ring, level->bins};
    return level->bins < FR_LEAST_BINS ? 0.0 : fr_bell_along(&bell, bin);
}

/* Whether the mean speed of half a second has changed from the one before by enough. */
static int is_active(const fr_level *level, const lv_arrays *a, int64_t bin)
{
    int32_t width = level->smooth, half = width / 2 > 1 ? width / 2 : 1;
    double change = 0.0;
    for (int32_t i = -(width / 2); i <= (width - 1) / 2; i++)
        change += speed_at(level, a, bin + half + i) - speed_at(level, a, bin - half + i);
    change /= (double)width * 2.0 * (double)half * level->step_s;
    return fabs(change) > LV_BRAKING_MPS2;
}

/* The force of a path: a line between those that are known, half a second ahead at most. */
static double bridge(fr_level *level, const lv_arrays *a, int32_t path, int64_t bin)
{
    int32_t paths = level->config.paths;
    double here = a->force[place_in(level, bin) * paths + path];
    double *last = &level->mean[path].last;
    for (int64_t i = 1; here != here && bin + i < level->bins && i <= level->smooth; i++) {
        double next = a->force[place_in(level, bin + i) * paths + path];
        here = *last == *last ? *last + (next - *last) / (double)(i + 1) : next;
    }
    if (here != here)
        here = *last == *last ? *last : 0.0;
    *last = here;
    return here;
}

static void read_forces(fr_level *level, const lv_arrays *a, lv_bin *bin)
{
    int32_t paths = level->config.paths, at = place_in(level, level->derived) * paths;
    double sum = 0.0;
    bin->missing = 0.0;
    for (int32_t p = 0; p < paths; p++) {
        if (a->force[at + p] != a->force[at + p])
            bin->missing = 1.0;
        sum += bridge(level, a, p, level->derived);
    }
    bin->force = sum / (double)paths - LV_GRAVITY;
}

int fr_lv_derive_bin(fr_level *level, lv_arrays *a, int at_end, lv_bin *bin)
{
    lv_bin found = {0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, FR_LEVEL_NO_BRAKE,
                    0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    int64_t number = level->derived;
    int64_t ahead = level->smooth + 2 > level->reach ? level->smooth + 2 : level->reach;
    if (number + (at_end != 0 ? 0 : ahead) >= level->bins ||
        (at_end == 0 && level->bins < FR_LEAST_BINS))
        return 0;
    *bin = found;
    bin->number = number;
    bin->height = a->height[place_in(level, number)];
    bin->distance = a->distance[place_in(level, number)];
    bin->speed = speed_at(level, a, number);
    bin->along = along_at(level, a, number);
    bin->active = is_active(level, a, number);
    read_forces(level, a, bin);
    level->moved += bin->speed >= LV_STANDING_MPS ? 1 : 0;
    bin->moved = level->moved;
    level->derived++;
    return 1;
}
