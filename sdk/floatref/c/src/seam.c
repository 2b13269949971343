/* SPDX-License-Identifier: Apache-2.0
 *
 * The elevation goes on at its grade where the encoder lost travel, or made it up.
 */
#include <math.h>

#include "samples.h"

fr_seam_config fr_seam_defaults(void)
{
    fr_seam_config config = {0.0, 20.0, 0.25};
    return config;
}

static int seam_is_possible(const fr_seam_config *config)
{
    return fr_above_zero(config->interval_m) && fr_above_zero(config->grade_m) &&
           fr_above_zero(config->point_m) && fr_finite(config->grade_m / config->interval_m) &&
           fr_finite(config->grade_m / config->point_m);
}

/* Sums over points of a line, as seen from the last of them. */
typedef struct seam_sums {
    double points, x, y, xx, xy;
} seam_sums;

static void add_point(seam_sums *sums, double x, double y)
{
    sums->points += 1.0;
    sums->x += x;
    sums->y += y;
    sums->xx += x * x;
    sums->xy += x * y;
}

/* So many points as `length_m` has, `most` at most. */
static size_t points_in(const fr_seam_config *config, double length_m, size_t most)
{
    double points = floor(length_m / config->interval_m + 1e-6);
    return points < (double)most ? (size_t)points : most;
}

/* The slope of the line through the points up to `last`, one for each `point_m`; 0 of one alone. */
static double grade_before(const fr_seam_config *config, const fr_real *elevation, size_t last)
{
    seam_sums sums = {0.0, 0.0, 0.0, 0.0, 0.0};
    size_t farthest = points_in(config, config->grade_m, last);
    size_t every = points_in(config, config->point_m, last);
    double spread;
    every += every == 0u ? 1u : 0u;
    for (size_t back = 0u; back <= farthest; back += every)
        add_point(&sums, -(double)back * config->interval_m,
                  (double)elevation[last - back] - (double)elevation[last]);
    spread = sums.points * sums.xx - sums.x * sums.x;
    return spread > 0.0 ? (sums.points * sums.xy - sums.x * sums.y) / spread : 0.0;
}

fr_status fr_seam(const fr_seam_config *config, size_t last, size_t next, fr_real *elevation,
                  size_t count)
{
    fr_status status = config == NULL ? FR_NULL_POINTER : FR_OK;
    if (status == FR_OK)
        status = fr_check_samples(elevation, count, FR_MISSING_REFUSED);
    if (status == FR_OK && (!seam_is_possible(config) || last >= next || next >= count))
        status = FR_BAD_CONFIG;
    if (status != FR_OK)
        return status;
    double grade = grade_before(config, elevation, last);
    double before = (double)elevation[last];
    double shift = before - (double)elevation[next];
    shift += grade * config->interval_m * (double)(next - last);
    for (size_t k = last + 1u; k < next; k++)
        elevation[k] = FR_R(before + grade * config->interval_m * (double)(k - last));
    for (size_t k = next; k < count; k++)
        elevation[k] = FR_R((double)elevation[k] + shift);
    return FR_OK;
}
