/* SPDX-License-Identifier: Apache-2.0
 *
 * How much room a fixed-lag smoother takes.
 */
#include "lag_layout.h"

/* Marks in all cases that a smoother has room for, in any time: ends of sections, of the run, and
 * rounding up. */
#define FURTHER_MARKS 16
#define MOST_NODES 100000000
#define MOST_POINTS_HELD 500000000

/* Marks that have to be: of standstills, ends and the history. */
static size_t marks_reserved(const fr_lag_pace *pace)
{
    return 6u * (size_t)pace->stops + FR_LAG_HISTORY + FURTHER_MARKS;
}

/* So many more than by time or travel alone, since segments end too. */
static size_t marks_of(const fr_lag_shape *shape)
{
    double by_points = 4.0 * shape->pace.points * shape->interval_m / FR_LAG_APART_M;
    double by_nodes = 3.0 * shape->pace.nodes * shape->node_s / FR_LAG_APART_S;
    double reserved = (double)marks_reserved(&shape->pace);
    return (size_t)(by_points + 1.25 * by_nodes + reserved);
}

size_t fr_lag_marks_spaced(const fr_lag *lag)
{
    return lag->sizes.marks - marks_reserved(&lag->shape.pace);
}

fr_lag_sizes fr_lag_sizes_of(const fr_lag_model *model, const fr_lag_shape *shape)
{
    size_t states = (size_t)model->states, rows = model->row == NULL ? 2u : 1u;
    fr_lag_sizes sizes;
    sizes.node = FR_LAG_NUMBERS(fr_lag_node) + 2u * states + (size_t)model->own;
    sizes.update = 2u + rows * states;
    sizes.mark = FR_LAG_NUMBERS(fr_lag_mark) + 3u * states + 2u * states * states;
    sizes.nodes = (size_t)shape->pace.nodes;
    sizes.updates = (size_t)shape->pace.updates;
    sizes.marks = marks_of(shape);
    sizes.points = 4u * (size_t)shape->pace.points;
    return sizes;
}

static int pace_is_possible(const fr_lag_pace *pace)
{
    return pace->nodes >= 8 && pace->nodes <= MOST_NODES && pace->delay >= 0 &&
           pace->delay < pace->nodes && pace->updates >= FR_LAG_UPDATES &&
           pace->updates <= 8 * (pace->nodes + 1) && pace->points >= 1 &&
           pace->points <= MOST_POINTS_HELD && pace->stops >= 0 && pace->stops <= pace->nodes &&
           pace->patience >= 1;
}

uint64_t fr_lag_numbers(const fr_lag_model *model, const fr_lag_shape *shape)
{
    if (!pace_is_possible(&shape->pace))
        return 0u;
    fr_lag_sizes sizes = fr_lag_sizes_of(model, shape);
    uint64_t nodes = (uint64_t)sizes.nodes * sizes.node;
    uint64_t updates = (uint64_t)sizes.updates * sizes.update;
    return FR_LAG_SECTIONS * (nodes + updates) + (uint64_t)sizes.marks * sizes.mark +
           (uint64_t)sizes.points * FR_LAG_NUMBERS(fr_lag_point_held);
}
