/* SPDX-License-Identifier: Apache-2.0
 *
 * What was read through a stretch, at nodes that are means of a few bins.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"

/* The mean of what is known among `count` values, NaN where nothing is. */
static double mean_known(const double *x, int32_t count)
{
    double sum = 0.0;
    int32_t known = 0;
    for (int32_t i = 0; i < count; i++) {
        if (x[i] == x[i]) {
            sum += x[i];
            known++;
        }
    }
    return known > 0 ? sum / (double)known : (double)NAN;
}

/* The force under three boxes of `every` bins about the middle of the k-th `every` bins; beyond the
 * ends of its piece there is nothing. The weights are whole numbers over the cube of `every`. */
static double mean_force(const double *x, int32_t count, int32_t k, int32_t every)
{
    int32_t first = k * every - (every - 1);
    double sum = 0.0, box = (double)every;
    for (int32_t i = 0; i < 3 * every - 2; i++) {
        int32_t at = first + i, back = 3 * every - 3 - i, near = i < back ? i : back;
        double ways = 0.5 * (double)(near + 1) * (double)(near + 2);
        if (near >= every)
            ways -= 1.5 * (double)(near - every + 1) * (double)(near - every + 2);
        if (at >= 0 && at < count)
            sum += x[at] * (ways / (box * box * box));
    }
    return sum;
}

static void read_node(lv_work *w, const fr_level_bins *bins, size_t at, double number)
{
    int32_t k = w->nodes, every = w->every;
    w->bin[k] = number + 0.5 * (double)(every - 1);
    w->height[k] = mean_known(bins->height + at, every);
    w->place[k] = mean_known(bins->distance + at, every);
    w->speed[k] = mean_known(bins->speed + at, every);
    w->along[k] = mean_known(bins->along + at, every);
    w->missing[k] = mean_known(bins->missing + at, every);
    w->nodes++;
}

/* The nodes of `count` bins that follow each other. */
static void read_piece(lv_work *w, const fr_level_bins *bins, size_t first, int32_t count)
{
    int32_t nodes = count / w->every;
    double number = (double)(bins->number[first] - bins->number[0]);
    for (int32_t k = 0; k < nodes; k++) {
        w->force[w->nodes] = mean_force(bins->force + first, nodes * w->every, k, w->every);
        read_node(w, bins, first + (size_t)(k * w->every), number + (double)(k * w->every));
    }
}

static size_t piece_end(const fr_level_bins *bins, size_t first)
{
    size_t end = first + 1u;
    while (end < bins->count && bins->number[end] == bins->number[end - 1u] + 1)
        end++;
    return end;
}

static void find_middles(lv_work *w)
{
    double near = 1.5 * w->interval_s;
    w->middles = 0;
    for (int32_t k = 1; k + 1 < w->nodes; k++) {
        w->middle[w->middles] = k;
        w->middles += w->pause[k] < near && w->pause[k + 1] < near ? 1 : 0;
    }
}

int32_t fr_lv_read(lv_work *w, const fr_level_bins *bins)
{
    double least = LV_SHORTEST_PIECE_S / w->config->step_s;
    w->nodes = 0;
    if (bins->count > (size_t)w->room.bins)
        return -1;
    for (size_t first = 0, end = 0; first < bins->count; first = end) {
        end = piece_end(bins, first);
        if ((double)(end - first) >= least)
            read_piece(w, bins, first, (int32_t)(end - first));
    }
    for (int32_t k = 0; k < w->nodes; k++)
        w->pause[k] = k == 0 ? w->interval_s : (w->bin[k] - w->bin[k - 1]) * w->config->step_s;
    find_middles(w);
    return w->nodes;
}
