/* SPDX-License-Identifier: Apache-2.0
 *
 * A stable sort without recursion: runs of 1, 2, 4 and so on are merged.
 */
#include "level_work.h"

static void merge_runs(const int32_t *from, int32_t *into, const double *keys, int32_t middle,
                       int32_t end)
{
    int32_t i = 0, j = middle;
    for (int32_t k = 0; k < end; k++) {
        int first = j >= end || (i < middle && keys[from[i]] <= keys[from[j]]);
        into[k] = from[first != 0 ? i : j];
        i += first != 0 ? 1 : 0;
        j += first != 0 ? 0 : 1;
    }
}

static int32_t least_of(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

void fr_lv_sort(int32_t *index, const double *keys, int32_t *spare, int32_t count)
{
    for (int32_t run = 1; run < count; run *= 2) {
        for (int32_t first = 0; first < count; first += 2 * run) {
            int32_t left = count - first;
            merge_runs(index + first, spare + first, keys, least_of(run, left),
                       least_of(2 * run, left));
        }
        for (int32_t i = 0; i < count; i++)
            index[i] = spare[i];
    }
}
