/* The road prior as the firmware's stage, behind levelling: it measures through stops. */
#include <math.h>

#include "waiting.h"

static const double LONGEST_WAVE_M = 91.44; /* of both passes of the high-pass; 105.91 m each */
static const double LAG_S = 180.0;          /* as long as the SDK waits at most */
static const double MOST_SIGMA_M = 7.8e-3;  /* 0.3 of the least bend of a road, 26 mm in 32 m */

static fr_status begin_levelling(struct vehicle *vehicle, const struct path *path)
{
    fr_level_config config = fr_level_defaults();
    config.rate_hz = path->rate_hz;
    config.metres_per_count = path->metres_per_count;
    config.back = FR_BACK_TAKEN;
    config.missing = FR_MISSING_BRIDGED;
    config.paths = vehicle->paths;
    config.fit.front_m = vehicle->front_m;
    config.fit.rear_m = vehicle->rear_m;
    config.fit.lever_m = vehicle->lever_m;
    config.fit.lean_sigma_rad = 0.03 / sqrt((double)vehicle->paths);
    TRY(begin_waiting(vehicle, path->rate_hz));
    TRY(MAKE(level, &config, &vehicle->waiting->level));
    TRY(fr_level_every(vehicle->waiting->level, &vehicle->waiting->every));
    return begin_pitch(vehicle, path);
}

fr_status stage_begin(struct path *path)
{
    fr_road_prior_config config = fr_road_prior_defaults();
    config.rate_hz = path->rate_hz;
    config.metres_per_count = path->metres_per_count;
    config.interval_m = path->interval_m;
    config.gravity_mps2 = 9.80665;
    config.lag_s = LAG_S;
    config.missing = FR_MISSING_BRIDGED;
    config.back = FR_BACK_TAKEN;
    path->through_stops = true;
    path->validity.drift_m = path->validity.before_slow_m = 2.0;
    path->validity.after_slow_m = 7.0;
    if (path->number == 0)
        TRY(begin_levelling(path->vehicle, path));
    TRY(add_waiting(path));
    return MAKE(road_prior, &config, &path->road_prior);
}

/* Samples up to number `end` are between two bins: level them, and give them to the smoother. */
static fr_status send(struct waiting *w, struct path *path, size_t end)
{
    fr_real share[CHUNK], *force = w->force[path->number], *height = w->height[path->number];
    size_t first = w->sent, n = end - first, k = path->made, room = path->room - k, made;
    const fr_level_bin *a = &w->before, *b = &w->behind;
    double middle = (double)a->first + 0.5 * (double)(w->every - 1);
    double between = b->first > a->first ? (double)(b->first - a->first) : 1.0;
    for (size_t i = first; i < end; i++) {
        double t = fmin(fmax(((double)i - middle) / between, 0.0), 1.0);
        double place = (double)w->counts[i] * path->metres_per_count / path->interval_m;
        force[i] += (fr_real)(a->added + t * (b->added - a->added));
        double sin_pitch = a->sin_pitch + t * (b->sin_pitch - a->sin_pitch) + moved_pitch(w, i);
        height[i] -= (fr_real)(path->lever_m * sin_pitch);
        share[i - first] = (fr_real)(a->share + t * (b->share - a->share));
        for (; path->placed < path->room && (double)path->placed <= place; path->placed++)
            path->unlevel[path->placed] = (fr_real)(a->sigma_m + t * (b->sigma_m - a->sigma_m));
    }
    TRY(fr_road_prior_push_levelled(path->road_prior, force + first, height + first, w->counts + first,
                                    share, NULL, n, path->elevation + k, path->sigma + k,
                                    path->flags + k, room, &made));
    path->made += made;
    return FR_OK;
}

/* All samples up to number `end` of all wheel paths. */
static fr_status send_up_to(struct waiting *w, int paths, size_t end)
{
    while (w->sent < end) {
        size_t to = end - w->sent > CHUNK ? w->sent + CHUNK : end;
        for (int i = 0; i < paths; i++)
            TRY(send(w, w->path[i], to));
        w->sent = to;
    }
    return FR_OK;
}

/* Take the bins that are level, and send the samples up to the middle of each whose pitch is known. */
static fr_status take_bins(struct waiting *w, int paths)
{
    size_t found, room = w->room - w->levelled;
    TRY(fr_level_take(w->level, w->bins + w->levelled, room, &found));
    w->levelled += found;
    while (next_bin(w))
        TRY(send_up_to(w, paths, (size_t)(w->behind.first + w->every / 2)));
    return FR_OK;
}

/* Give the samples whose way is known to the levelling. */
static fr_status level_known(struct waiting *w, int paths)
{
    fr_real force[CHUNK * MOST_LEVELLED], height[CHUNK * MOST_LEVELLED];
    while (w->pushed < w->known) {
        size_t n = w->known - w->pushed > CHUNK ? CHUNK : w->known - w->pushed, ready;
        interleave(w, (size_t)paths, n, force, height);
        TRY(fr_level_push(w->level, force, height, w->travelled + w->pushed, n, &ready));
        TRY(model_pitch(w, force, height, w->travelled + w->pushed, n));
        w->pushed += n;
        TRY(take_bins(w, paths));
    }
    return FR_OK;
}

/* The stage: samples wait for levelling, which has to see all wheel paths. */
fr_status stage_take(struct path *path, fr_real *force, fr_real *height, const int64_t *counts, size_t n)
{
    TRY(store(path, force, height, counts, n));
    return level_known(path->vehicle->waiting, path->vehicle->paths);
}

/* The end of the run: all that waits. */
static fr_status end_levelling(struct waiting *w, int paths)
{
    size_t ready;
    if (w->ended)
        return FR_OK;
    w->ended = true;
    end_counts(w);
    TRY(level_known(w, paths));
    TRY(fr_level_finish(w->level, &ready));
    TRY(end_pitch(w));
    TRY(take_bins(w, paths));
    w->before = w->behind;
    return send_up_to(w, paths, w->taken);
}

/* The end of a wheel path: its last points, the high-pass, and the points that are not sure. */
fr_status stage_end(struct path *path)
{
    fr_high_pass_profile_config config = {path->interval_m, LONGEST_WAVE_M};
    TRY(end_levelling(path->vehicle->waiting, path->vehicle->paths));
    size_t n = path->count, k = path->made, made;
    TRY(fr_road_prior_finish(path->road_prior, path->elevation + k, path->sigma + k, path->flags + k,
                             path->room - k, &made));
    path->count = n = n < k + made ? n : k + made;
    for (size_t i = 0; i < n; i++) {
        path->sigma[i] = (fr_real)hypot(path->sigma[i], path->unlevel[i]);
        if (path->flags[i] != 0 || path->sigma[i] > MOST_SIGMA_M)
            path->valid[i] |= (path->flags[i] & FR_POINT_LEAP) != 0 ? FR_CAUSE_SLOW : FR_CAUSE_MISSING;
    }
    TRY(cross_seams(path->vehicle->waiting, path));
    return fr_high_pass_profile(&config, path->elevation, n, path->elevation, path->room, &made);
}
