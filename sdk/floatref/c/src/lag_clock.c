/* SPDX-License-Identifier: Apache-2.0
 *
 * Sections of half a lag, marks and standstills, by the numbers of nodes and points alone.
 */
#include "lag_clock.h"

/* Four times the points of a section: three sections, and a leap or a delay behind them. */
#define SECTIONS_OF_POINTS 4

int fr_lag_clock_holds(const fr_lag_clock *clock, const fr_lag_pace *pace, int64_t points)
{
    return points - clock->released <= SECTIONS_OF_POINTS * (int64_t)pace->points;
}

/* The oldest section has come out. */
static void release_section(fr_lag_clock *clock)
{
    clock->released = clock->ends[0];
    clock->sections--;
    for (int32_t k = 0; k < clock->sections; k++)
        clock->ends[k] = clock->ends[k + 1];
}

/* One more node passes the filter, which may be where the third section has ended. */
static void let_pass(fr_lag_clock *clock)
{
    if (clock->due == 0)
        return;
    clock->due--;
    if (clock->due == 0)
        release_section(clock);
}

static int may_compose(const fr_lag_clock *clock, const fr_lag_pace *pace)
{
    if (clock->empty <= pace->patience)
        return 0;
    /* The record begins behind a mark, and one more node has to fit in to end the section. */
    return clock->composing != 0 || (clock->stops < pace->stops && clock->marked != 0 &&
                                     clock->nodes + 2 <= pace->nodes);
}

static int section_ends(const fr_lag_clock *clock, const fr_lag_pace *pace)
{
    int64_t before = clock->sections > 0 ? clock->ends[clock->sections - 1] : clock->released;
    return clock->nodes > pace->delay &&
           (clock->nodes == pace->nodes || clock->updates + FR_LAG_UPDATES > pace->updates ||
            clock->points - before >= pace->points);
}

static void end_section(fr_lag_clock *clock, const fr_lag_pace *pace)
{
    clock->ends[clock->sections] = clock->points;
    clock->sections++;
    clock->nodes = 0;
    clock->updates = 0;
    clock->stops = 0;
    if (clock->sections < FR_LAG_SECTIONS)
        return;
    clock->due = pace->delay;
    if (clock->due == 0)
        release_section(clock);
}

static int32_t store_node(fr_lag_clock *clock, const fr_lag_pace *pace, int32_t updates)
{
    clock->composing = 0;
    clock->nodes++;
    clock->updates += updates;
    clock->marked = clock->empty >= pace->patience && clock->stops < pace->stops;
    if (!section_ends(clock, pace))
        return clock->marked != 0 ? FR_LAG_MARK : 0;
    end_section(clock, pace);
    clock->marked = 1;
    return FR_LAG_ENDS | FR_LAG_MARK;
}

/* Nodes without a point; more than the patience is all the same. */
static void count_empty(fr_lag_clock *clock, const fr_lag_pace *pace, int64_t points)
{
    int32_t empty = clock->empty <= pace->patience ? clock->empty + 1 : clock->empty;
    clock->empty = points > clock->points ? 0 : empty;
    clock->points = points;
}

int32_t fr_lag_clock_node(fr_lag_clock *clock, const fr_lag_pace *pace, int64_t points,
                          int32_t updates)
{
    let_pass(clock);
    count_empty(clock, pace, points);
    if (!may_compose(clock, pace))
        return store_node(clock, pace, updates);
    if (clock->composing == 0) {
        clock->composing = 1;
        clock->stops++;
        clock->nodes++;
    }
    return FR_LAG_COMPOSED;
}
