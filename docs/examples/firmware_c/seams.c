/* Where the encoder leaps or loses counts, the road goes on: it has no step there. */
#include <math.h>

#include "waiting.h"

static const double PACE_S = 0.1; /* over which the speed before is measured; no leap is longer */
static const double LEAPT = 3.0, LOST = 0.5; /* of the travel that this speed lets expect */

/* Whether the way from sample `from` to the next count, at `to`, was not travelled, or was lost. */
static bool is_seam(const struct waiting *w, size_t from, size_t to, double rate_hz)
{
    size_t longest = (size_t)fmax(1.0, rint(PACE_S * rate_hz));
    size_t back = from > longest ? from - longest : 0;
    double samples = (double)(to - from), way = (double)(w->counts[to] - w->counts[from]);
    if (to == from + 1 || from == back)
        return false;
    double pace = (double)(w->travelled[from] - w->travelled[back]) / (double)(from - back);
    bool leapt = to - from <= longest && way > LEAPT * pace * samples;
    return leapt || way < LOST * pace * samples;
}

/* The points before and behind a seam are those that a count has reached, and not yet reached. */
static fr_status cross(const struct path *path, int64_t before, int64_t behind)
{
    fr_seam_config config = fr_seam_defaults();
    double points_per_count = path->metres_per_count / path->interval_m;
    size_t last = (size_t)fmax(floor((double)before * points_per_count + 1e-6), 0.0);
    size_t next = (size_t)fmax(ceil((double)behind * points_per_count - 1e-6), 0.0);
    config.interval_m = path->interval_m;
    next = next > last ? next : last + 1;
    return next < path->count ? fr_seam(&config, last, next, path->elevation, path->count) : FR_OK;
}

fr_status cross_seams(const struct waiting *w, const struct path *path)
{
    size_t from = 0;
    for (size_t i = 0; i < w->taken; i++) {
        if (w->counts[i] == FR_NO_COUNT)
            continue;
        if (is_seam(w, from, i, path->rate_hz))
            TRY(cross(path, w->counts[from], w->counts[i]));
        from = i;
    }
    return FR_OK;
}
