/* SPDX-License-Identifier: Apache-2.0
 *
 * Points, updates and nodes of a fixed-lag smoother, as they come.
 */
#include <math.h>
#include <string.h>

#include "lag_link.h"

void fr_lag_begin(const fr_lag_view *view, const fr_lag_shape *shape)
{
    fr_lag *lag = view->lag;
    (void)memset(lag, 0, sizeof *lag);
    lag->shape = *shape;
    lag->sizes = fr_lag_sizes_of(view->model, shape);
    lag->held = 1;
    fr_lag_link_clear(&lag->link, view->model->states);
}

void fr_lag_point(const fr_lag_view *view, const fr_lag_point_held *point)
{
    *fr_lag_point_at(view, view->lag->points) = *point;
    view->lag->points++;
}

static fr_lag_section *making(const fr_lag *lag, fr_lag_section *sections)
{
    return &sections[fr_lag_making(lag)];
}

static fr_lag_node *last_node(const fr_lag_view *view)
{
    fr_lag *lag = view->lag;
    const fr_lag_section *section = making(lag, lag->sections);
    return fr_lag_node_at(view, fr_lag_making(lag), section->nodes - 1);
}

/* End the record of a standstill: a mark says how it is passed. */
static void close_stop(const fr_lag_view *view)
{
    fr_lag_node *record = last_node(view);
    record->mark = view->lag->marks;
    fr_lag_link_mark(view, fr_lag_rows(record));
    view->lag->composing = 0;
}

/* A place for a node that is stored, or the record of the standstill that goes on. */
static fr_lag_node *next_node(const fr_lag_view *view, int32_t kind)
{
    fr_lag *lag = view->lag;
    int composed = (kind & FR_LAG_COMPOSED) != 0;
    if (composed && lag->composing != 0)
        return last_node(view);
    if (lag->composing != 0)
        close_stop(view);
    lag->composing = composed;
    making(lag, lag->sections)->nodes++;
    (void)memset(last_node(view), 0, lag->sizes.node * sizeof(double));
    return last_node(view);
}

void fr_lag_begin_node(const fr_lag_view *view, int32_t kind, double span, const double *own)
{
    fr_lag *lag = view->lag;
    fr_lag_node *node = next_node(view, kind);
    lag->kind = kind;
    lag->linked = 1;
    lag->time_s += span;
    node->span += span;
    node->mark = -1;
    (void)memcpy(fr_lag_own(view, node), own, (size_t)view->model->own * sizeof *own);
    view->model->forth(own, span, lag->link.psi);
}

/* A standstill's record carries its updates in its link alone. */
static void store_update(const fr_lag_view *view, const double *gain, const double *row,
                         double innovation, double information)
{
    fr_lag *lag = view->lag;
    fr_lag_section *section = making(lag, lag->sections);
    double *update = fr_lag_update_at(view, fr_lag_making(lag), section->updates);
    size_t bytes = (size_t)view->model->states * sizeof *gain;
    update[0] = innovation;
    update[1] = information;
    (void)memcpy(update + 2, gain, bytes);
    if (view->model->row == NULL)
        (void)memcpy(update + 2 + view->model->states, row, bytes);
    section->updates++;
}

void fr_lag_update(const fr_lag_view *view, const double *gain, const double *row,
                   double innovation, double information)
{
    fr_lag *lag = view->lag;
    const double *own = view->model->row != NULL ? view->model->row : row;
    if (lag->composing == 0)
        store_update(view, gain, own, innovation, information);
    fr_lag_link_update(&lag->link, view->model->states, gain, own, innovation, information);
}

/* A section ends; the next one begins where there is room for it. Return whether there is not. */
static int close_section(const fr_lag_view *view, const double *covariance)
{
    fr_lag *lag = view->lag;
    size_t states = (size_t)view->model->states;
    (void)memcpy(lag->covariance, covariance, states * states * sizeof *covariance);
    if (lag->held == FR_LAG_SECTIONS)
        return 1;
    lag->held++;
    fr_lag_begin_section(lag);
    return 0;
}

void fr_lag_begin_section(fr_lag *lag)
{
    fr_lag_section *section = making(lag, lag->sections);
    section->nodes = 0;
    section->updates = 0;
    section->first_mark = lag->marks;
}

/* Whether a node is far enough from the mark before, as the SDK has it: time at a standstill does
 * not count, and the way to the first node of a segment does not either. */
static int is_apart(fr_lag *lag, double travel_m, double span)
{
    double before = floor(lag->apart), elapsed = travel_m != 0.0 ? span / FR_LAG_APART_S : 0.0;
    if (lag->begun != 0)
        lag->apart += fmax(travel_m / FR_LAG_APART_M, elapsed);
    lag->begun = 1;
    return floor(lag->apart) > before;
}

static void mark_node(const fr_lag_view *view, const fr_lag_node_end *end, double span)
{
    fr_lag *lag = view->lag;
    size_t held = (size_t)(lag->marks - lag->first_mark);
    int apart = is_apart(lag, end->distance_m - lag->distance_m, span);
    lag->distance_m = fmax(end->distance_m, lag->distance_m);
    if (end->mark != 0) {
        lag->apart = 0.0;
        lag->begun = 0;
    }
    if ((lag->kind & FR_LAG_COMPOSED) != 0)
        return;
    if ((lag->kind & FR_LAG_MARK) != 0 ||
        ((apart || end->mark != 0) && held < fr_lag_marks_spaced(lag)))
        fr_lag_link_mark(view, fr_lag_rows(last_node(view)));
}

int fr_lag_end_node(const fr_lag_view *view, const fr_lag_node_end *end)
{
    fr_lag *lag = view->lag;
    fr_lag_node *node = last_node(view);
    size_t states = (size_t)view->model->states;
    node->height = end->height;
    node->velocity = end->velocity;
    node->rise = end->rise;
    node->climb = end->climb;
    node->distance_m = end->distance_m;
    node->largest = end->largest;
    node->points = end->points;
    node->updates = making(lag, lag->sections)->updates;
    node->flags |= end->flags;
    (void)memcpy(fr_lag_rows(node), end->covariance, 2u * states * sizeof(double));
    mark_node(view, end, node->span);
    return (lag->kind & FR_LAG_ENDS) != 0 ? close_section(view, end->covariance) : 0;
}

void fr_lag_end_run(const fr_lag_view *view)
{
    fr_lag *lag = view->lag;
    if (lag->composing != 0)
        close_stop(view);
    if (lag->linked != 0)
        fr_lag_link_mark(view, fr_lag_rows(last_node(view)));
}
