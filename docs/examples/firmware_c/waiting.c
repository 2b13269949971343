#include "waiting.h"

#include <math.h>

fr_status begin_waiting(struct vehicle *vehicle, double rate_hz)
{
    struct waiting *w = vehicle->waiting = run_memory(sizeof *w);
    if (vehicle->paths > MOST_LEVELLED)
        return FR_BAD_CONFIG;
    if (w == NULL)
        return FR_TOO_SMALL;
    begin_travelled(w, rate_hz);
    w->counts = run_memory(vehicle->samples * sizeof *w->counts);
    w->travelled = run_memory(vehicle->samples * sizeof *w->travelled);
    return w->counts != NULL && w->travelled != NULL ? FR_OK : FR_TOO_SMALL;
}

fr_status add_waiting(struct path *path)
{
    int i = path->number;
    struct waiting *w = path->vehicle->waiting;
    size_t samples = path->vehicle->samples * sizeof(fr_real);
    w->path[i] = path;
    w->force[i] = run_memory(samples);
    w->height[i] = run_memory(samples);
    path->flags = run_memory(path->room);
    path->sigma = run_memory(path->room * sizeof *path->sigma);
    path->unlevel = run_memory(path->room * sizeof *path->unlevel);
    bool all = w->force[i] != NULL && w->height[i] != NULL && path->flags != NULL &&
               path->sigma != NULL && path->unlevel != NULL;
    return all ? FR_OK : FR_TOO_SMALL;
}

fr_status store(struct path *path, const fr_real *force, const fr_real *height, const int64_t *counts,
                size_t count)
{
    struct waiting *w = path->vehicle->waiting;
    if (w->taken == 0 && count > 0 && counts[0] == FR_NO_COUNT)
        return FR_BAD_SAMPLE;
    fr_real *a = w->force[path->number] + w->taken, *h = w->height[path->number] + w->taken;
    for (size_t k = 0; k < count; k++) {
        /* The smoother begins at the first height, which has to be one. */
        bool unread = (path->of_samples[k] & NO_HEIGHT) != 0 && w->taken + k > 0;
        a[k] = (path->of_samples[k] & FR_CAUSE_DRIFT) != 0 ? (fr_real)NAN : force[k];
        h[k] = unread ? (fr_real)NAN : height[k];
    }
    if (path->number + 1 == path->vehicle->paths)
        store_counts(w, counts, count);
    return FR_OK;
}

void interleave(const struct waiting *w, size_t paths, size_t count, fr_real *force, fr_real *height)
{
    for (size_t k = 0; k < count * paths; k++) {
        force[k] = w->force[k % paths][w->pushed + k / paths];
        height[k] = w->height[k % paths][w->pushed + k / paths];
    }
}
