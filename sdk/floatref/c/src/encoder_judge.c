/* SPDX-License-Identifier: Apache-2.0
 *
 * A way is judged by the last two sound ones: what a vehicle would travel at 20 % more or less, and
 * speeding up or braking with 2 g. The limits are those of the SDK (decision 0012).
 */
#include <math.h>

#include "encoder_judge.h"

#define HARDEST (2.0 * 9.80665) /* braking and speeding up of any vehicle */
#define UNEVEN 0.2              /* a wheel that hops or is out of round is faster or slower */
#define SOUND_MPS 2.5           /* slower travel is not valid anyway */
#define SOUND_MOST_MPS 90.0
#define LEAP_RISES 5.0          /* usual rises of a leap, at least */
#define ROUGH 1.5         /* uncertainty of a way, in usual rises */
#define LATE 2.5          /* a rise is late after so many usual waits */
#define SHORTEST_S 0.02   /* of a silence */
#define AT_ONCE 2.5       /* usual rises of the step behind a silence */
#define MADE_UP 2.5       /* this step is what was travelled, within the factor */

/* What the ways before lead to expect. */
typedef struct expected {
    double speed, local, slowest, most;
} expected;

static double shortest_travel(double speed, double time_s)
{
    double v = fmax(speed, 0.0), braked_s = fmin(time_s, v / HARDEST);
    return (v - 0.5 * HARDEST * braked_s) * braked_s;
}

static double seconds_of(const fr_judge *j, fr_moment from, fr_moment to)
{
    return (double)(to.tick - from.tick) * j->period_s;
}

static double metres_of(const fr_judge *j, int64_t counts)
{
    return (double)counts * j->metres_per_count;
}

static expected expect(const fr_judge *j, const fr_way *from, double took)
{
    expected e;
    double m = j->older.m + j->newer.m, s = j->older.s + j->newer.s;
    double since = seconds_of(j, j->sound_at, from->at);
    double unsure = j->off_m / s + HARDEST * (0.5 * s + since);
    e.speed = m / s;
    e.local = fmax(j->usual_m, m / fmax(j->older.rises + j->newer.rises, 1.0));
    e.slowest = (1.0 - UNEVEN) * e.speed - unsure;
    e.most = ((1.0 + UNEVEN) * e.speed + unsure + 0.5 * HARDEST * took) * took;
    return e;
}

/* Whether the vehicle cannot have stopped while one rise was waited for. */
static int is_stalled(const fr_judge *j, const fr_way *from, const fr_way *way, const expected *e,
                      double hidden_m)
{
    double gap_s = seconds_of(j, way->gap, way->behind_gap);
    double at_gap = e->slowest - HARDEST * seconds_of(j, from->at, way->gap);
    double gone = metres_of(j, way->gap_height) + hidden_m + j->off_m;
    return e->speed >= SOUND_MPS && gone < shortest_travel(at_gap, gap_s) &&
           e->speed * gap_s > LATE * e->local;
}

/* Whether the way is more than a vehicle goes: by a leap, or by counting too much. */
static int32_t too_far(const fr_judge *j, const fr_way *way, const expected *e, double gone,
                       double took)
{
    double step = metres_of(j, way->height), step_s = seconds_of(j, way->before_step, way->step);
    double since_s = seconds_of(j, way->front, way->step);
    int steep = step > fmax(SOUND_MOST_MPS * step_s + LEAP_RISES * e->local, MADE_UP * e->speed * since_s);
    if (!steep && !(gone > fmin(e->most, SOUND_MOST_MPS * took) + ROUGH * e->local))
        return 0;
    return step - e->speed * step_s >= 0.5 * (gone - e->speed * took) ? FR_LEAPT : FR_TOO_MANY_COUNTS;
}

static int is_silent(const fr_judge *j, const fr_way *way, const expected *e)
{
    double step = metres_of(j, way->height), since_s = seconds_of(j, way->front, way->step);
    return way->before_step.index > way->front.index && since_s >= SHORTEST_S && step > AT_ONCE * e->local &&
           step * MADE_UP > e->speed * since_s;
}

static void take_sound(fr_judge *j, const fr_way *way, double gone, double took)
{
    j->older = j->newer;
    j->newer.m = gone;
    j->newer.s = took;
    j->newer.rises = (double)way->rises;
    j->sound_at = way->at;
    /* The first way is taken as it is, and for both. */
    if (j->ways == 0)
        j->older = j->newer;
    j->ways = 1;
}

int32_t fr_judge_way(fr_judge *j, const fr_way *from, const fr_way *way, double hidden_m,
                     int *stalled)
{
    double gone = metres_of(j, way->far - from->far), took = seconds_of(j, from->at, way->at);
    int32_t kind = 0;
    *stalled = 0;
    if (j->ways > 0) {
        expected e = expect(j, from, took);
        *stalled = is_stalled(j, from, way, &e, hidden_m);
        kind = *stalled ? FR_LOST : too_far(j, way, &e, gone, took);
        if (kind == 0 && e.speed >= SOUND_MPS &&
            gone + hidden_m + ROUGH * e.local < shortest_travel(e.slowest, took))
            kind = FR_LOST;
        if (kind == 0 && is_silent(j, way, &e))
            kind = FR_SILENT;
    }
    if (kind == 0 || kind == FR_SILENT)
        take_sound(j, way, gone, took);
    return kind;
}
