/* SPDX-License-Identifier: Apache-2.0
 *
 * Bins of the modelled pitch: means of samples, and lines where a path is not known.
 */
#include <string.h>

#include "bins.h"
#include "pitch.h"

static void close_row(fr_pitch *pitch, const pt_arrays *a, int32_t row)
{
    pt_mean *mean = &pitch->mean[row];
    a->row[row][pitch->stored] = fr_close_mean(mean->sum, mean->count, pitch->every);
    mean->sum = 0.0;
    mean->count = 0;
}

/* The distance does not fall; it is that from the first count. */
static void close_row_of_bins(fr_pitch *pitch, const pt_arrays *a)
{
    double way = pitch->counted / (double)pitch->every * pitch->config.metres_per_count;
    int first = pitch->begun == 0 && pitch->stored == 0;
    for (int32_t p = 0; p < pitch->config.paths; p++) {
        close_row(pitch, a, p);
        close_row(pitch, a, PT_PATHS + p);
    }
    pitch->furthest_m = first || way > pitch->furthest_m ? way : pitch->furthest_m;
    a->distance[pitch->stored] = pitch->furthest_m;
    pitch->filled = 0;
    pitch->counted = 0.0;
    pitch->stored++;
}

int fr_pt_add_sample(fr_pitch *pitch, pt_arrays *a, const fr_real *force, const fr_real *height,
                     int64_t count)
{
    if (pitch->begun == 0 && pitch->stored == 0 && pitch->filled == 0)
        pitch->first_count = count;
    for (int32_t p = 0; p < pitch->config.paths; p++) {
        pt_mean *up = &pitch->mean[p], *down = &pitch->mean[PT_PATHS + p];
        fr_add_known(&up->sum, &up->count, force[p]);
        fr_add_known(&down->sum, &down->count, height[p]);
    }
    pitch->counted += (double)(count - pitch->first_count);
    pitch->filled++;
    if (pitch->filled < pitch->every)
        return 0;
    close_row_of_bins(pitch, a);
    return 1;
}

/* Add the values of a row to `sum`, with a line to the next known one where it is not known, and the
 * nearest beyond the first and the last; whether it is known anywhere. */
static int add_bridged(const pt_mean *mean, const double *row, int32_t count, double *sum)
{
    int known = mean->since > 0;
    double before = mean->last;
    int32_t from = -mean->since, at = 0;
    for (int32_t k = 0; k < count; k++) {
        if (row[k] != row[k])
            continue;
        for (; at < k; at++)
            sum[at] += known != 0 ? (row[k] - before) / (double)(k - from) * (double)(at - from) + before
                                  : row[k];
        sum[k] += row[k];
        known = 1;
        before = row[k];
        from = k;
        at = k + 1;
    }
    for (; known != 0 && at < count; at++)
        sum[at] += before;
    return known;
}

/* The mean of the paths that are known anywhere; whether one is. */
static int read_mean(const fr_pitch *pitch, const pt_arrays *a, int32_t first, int32_t count,
                     double *mean)
{
    double paths = 0.0;
    (void)memset(mean, 0, (size_t)count * sizeof *mean);
    for (int32_t p = 0; p < pitch->config.paths; p++)
        paths += add_bridged(&pitch->mean[first + p], a->row[first + p], count, mean) != 0 ? 1.0 : 0.0;
    for (int32_t k = 0; k < count; k++)
        mean[k] /= fmax(paths, 1.0);
    return paths > 0.0;
}

int fr_pt_read_window(const fr_pitch *pitch, pt_arrays *a, int32_t count)
{
    int forces = read_mean(pitch, a, 0, count, a->force);
    int heights = read_mean(pitch, a, PT_PATHS, count, a->height);
    for (int32_t k = 0; k < count; k++)
        a->force[k] -= PT_GRAVITY;
    return forces != 0 && heights != 0;
}

/* Remember what was known last of a row before its first `count` bins go. */
static void drop_row(fr_pitch *pitch, pt_arrays *a, int32_t row, int32_t count)
{
    pt_mean *mean = &pitch->mean[row];
    int32_t last = count - 1;
    while (last >= 0 && a->row[row][last] != a->row[row][last])
        last--;
    if (last >= 0)
        mean->last = a->row[row][last];
    if (last >= 0 || mean->since > 0)
        mean->since = last >= 0 ? count - last : mean->since + count;
    (void)memmove(a->row[row], a->row[row] + count, (size_t)(pitch->stored - count) * sizeof(double));
}

void fr_pt_drop_bins(fr_pitch *pitch, pt_arrays *a, int32_t count)
{
    for (int32_t p = 0; p < pitch->config.paths; p++) {
        drop_row(pitch, a, p, count);
        drop_row(pitch, a, PT_PATHS + p, count);
    }
    (void)memmove(a->distance, a->distance + count, (size_t)(pitch->stored - count) * sizeof(double));
    pitch->stored -= count;
}
