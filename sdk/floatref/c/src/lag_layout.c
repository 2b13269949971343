/* SPDX-License-Identifier: Apache-2.0
 *
 * How much room a fixed-lag smoother takes.
 */
#include "lag_layout.h"

/* Ends of sections, ends of the run, and rounding up. */
#define FURTHER_MARKS 16
#define MOST_NODES 100000000
#define MOST_POINTS_HELD 500000000

static size_t marks_of(const fr_lag_pace *pace)
{
    size_t by_points = 4u * (size_t)pace->points / (size_t)pace->mark_points;
    size_t by_nodes = 3u * (size_t)pace->nodes / (size_t)pace->mark_nodes;
    return by_points + by_nodes + 6u * (size_t)pace->stops + FR_LAG_HISTORY + FURTHER_MARKS;
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
    sizes.marks = marks_of(&shape->pace);
    sizes.points = 4u * (size_t)shape->pace.points;
    return sizes;
}

static int pace_is_possible(const fr_lag_pace *pace)
{
    return pace->nodes >= 8 && pace->nodes <= MOST_NODES && pace->delay >= 0 &&
           pace->delay < pace->nodes && pace->updates >= FR_LAG_UPDATES &&
           pace->updates <= 8 * (pace->nodes + 1) && pace->points >= 1 &&
           pace->points <= MOST_POINTS_HELD && pace->stops >= 0 && pace->stops <= pace->nodes &&
           pace->patience >= 1 && pace->mark_nodes >= 1 && pace->mark_points >= 1;
}

size_t fr_lag_numbers(const fr_lag_model *model, const fr_lag_shape *shape)
{
    if (!pace_is_possible(&shape->pace))
        return 0u;
    fr_lag_sizes sizes = fr_lag_sizes_of(model, shape);
    return FR_LAG_SECTIONS * (sizes.nodes * sizes.node + sizes.updates * sizes.update) +
           sizes.marks * sizes.mark + sizes.points * FR_LAG_NUMBERS(fr_lag_point_held);
}
