#include "points.h"

#include <math.h>
#include <stdlib.h>

static const double TIE = 1e-6; /* a distance this close below a point, in intervals, has reached it */
static const double MOST_POINTS = 5e7;

bool points_open(struct points *points, int tracks, double interval_m, double length_m,
                 struct failure *failure)
{
    size_t paths = (size_t)tracks;
    points->tracks = tracks;
    points->interval_m = interval_m;
    if (!(length_m >= interval_m))
        return fail(failure, "channel distance: %g m are less than the profile interval", length_m);
    if (length_m > MOST_POINTS * interval_m)
        return fail(failure, "channel distance: %g m are too many points", length_m);
    points->room = (long)(length_m / interval_m + 2 * TIE) + 1;
    points->speed = malloc((size_t)points->room * sizeof *points->speed);
    points->elevation = calloc(paths, sizeof *points->elevation);
    points->flags = calloc(paths, sizeof *points->flags);
    points->elevation_before = calloc(paths, sizeof *points->elevation_before);
    points->flags_before = calloc(paths, sizeof *points->flags_before);
    points->pending = calloc(paths, sizeof *points->pending);
    bool done = points->speed && points->elevation && points->flags && points->elevation_before &&
                points->flags_before && points->pending;
    for (int i = 0; done && i < tracks; i++) {
        points->elevation[i] = malloc((size_t)points->room * sizeof **points->elevation);
        points->flags[i] = malloc((size_t)points->room);
        done = points->elevation[i] != NULL && points->flags[i] != NULL;
    }
    return done || fail(failure, "out of memory for %ld points", points->room);
}

void points_close(struct points *points)
{
    for (int i = 0; i < points->tracks; i++) {
        if (points->elevation != NULL)
            free(points->elevation[i]);
        if (points->flags != NULL)
            free(points->flags[i]);
    }
    free(points->speed);
    free(points->elevation);
    free(points->flags);
    free(points->elevation_before);
    free(points->flags_before);
    free(points->pending);
}

/* Store one point, `part` of the way from the sample before to this one. */
static void keep(struct points *points, const struct sample *sample, real part)
{
    long k = points->count++;
    real before = (real)points->speed_before, now = (real)sample->motion.speed_mps;
    points->speed[k] = part < 1 ? before + part * (now - before) : now;
    for (int i = 0; i < points->tracks; i++) {
        real z = sample->elevation[i], z_before = points->elevation_before[i];
        unsigned flags = sample->flags[i] | points->pending[i];
        points->elevation[i][k] = part < 1 ? z_before + part * (z - z_before) : z;
        points->flags[i][k] = (unsigned char)(part < 1 ? flags | points->flags_before[i] : flags);
        points->pending[i] = 0;
    }
}

/* Point k is taken by the first sample whose distance has reached it. Where samples are farther
   apart than the interval, it is read between two of them, linear in distance. A distance that is
   not known, or goes back, is the last one of the vehicle. */
void points_step(struct points *points, const struct sample *sample)
{
    double slack = TIE * points->interval_m;
    if (!points->started)
        points->start_m = points->distance_m = sample->motion.distance_m;
    double now = fmax(points->distance_m, sample->motion.distance_m);
    points->started = true;
    for (int i = 0; i < points->tracks; i++)
        points->pending[i] |= sample->flags[i] & LASTING;
    double step = now - points->distance_m;
    while (points->count < points->room) {
        double point = points->start_m + (double)points->count * points->interval_m;
        bool between = step > points->interval_m + slack && point < now - slack;
        if (point > now + slack)
            break;
        keep(points, sample, between ? (real)((point - points->distance_m) / step) : 1);
    }
    points->distance_m = now;
    points->speed_before = sample->motion.speed_mps;
    for (int i = 0; i < points->tracks; i++) {
        points->elevation_before[i] = sample->elevation[i];
        points->flags_before[i] = sample->flags[i];
    }
}

void points_finish(struct points *points)
{
    for (int i = 0; i < points->tracks && points->count > 0; i++)
        points->flags[i][points->count - 1] |= (unsigned char)points->pending[i];
}
