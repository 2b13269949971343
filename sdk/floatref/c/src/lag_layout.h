/* SPDX-License-Identifier: Apache-2.0
 *
 * Where nodes, updates, marks and points of a fixed-lag smoother lie in its room.
 */
#ifndef FR_LAG_LAYOUT_H
#define FR_LAG_LAYOUT_H

#include "fixed_lag.h"

/* A node; behind it the first two rows of its covariance, then the numbers of its own. */
typedef struct fr_lag_node {
    double span; /* since the node before in s; of a standstill's record the whole of it */
    double height, velocity, rise, climb, distance_m, largest;
    int64_t points; /* of the run, up to here */
    int64_t mark;   /* a standstill's record: the mark that says how it is passed, else -1 */
    int32_t updates; /* of the section, up to here */
    int32_t flags;
} fr_lag_node;

/* A mark; behind it P e_r, (I - Lambda P) e_r, the adjoint's push, then Psi and the information
 * since the mark before. */
typedef struct fr_lag_mark {
    double time_s, distance_m, sigma;
    double change; /* by readings to come when it came out, 1-sigma in m */
    double doubt;  /* the largest of that within half a wavelength */
} fr_lag_mark;

/* Marks are so far apart, in travel and in time, where the vehicle moves. */
#define FR_LAG_APART_M 8.0
#define FR_LAG_APART_S 0.5

/* Marks behind the sections, within reach of the filter of the 1-sigma. */
enum { FR_LAG_HISTORY = 64 };

#define FR_LAG_NUMBERS(type) ((sizeof(type) + sizeof(double) - 1u) / sizeof(double))

fr_lag_sizes fr_lag_sizes_of(const fr_lag_model *model, const fr_lag_shape *shape);

/* How many marks there may be before a further one for its distance is left out. */
size_t fr_lag_marks_spaced(const fr_lag *lag);

/* Nodes and updates lie by section, then marks and points as rings over their numbers. */
static inline double *fr_lag_updates_begin(const fr_lag_view *view)
{
    const fr_lag_sizes *sizes = &view->lag->sizes;
    return view->room + FR_LAG_SECTIONS * sizes->nodes * sizes->node;
}

static inline double *fr_lag_marks_begin(const fr_lag_view *view)
{
    const fr_lag_sizes *sizes = &view->lag->sizes;
    return fr_lag_updates_begin(view) + FR_LAG_SECTIONS * sizes->updates * sizes->update;
}

static inline fr_lag_node *fr_lag_node_at(const fr_lag_view *view, int32_t place, int32_t k)
{
    const fr_lag_sizes *sizes = &view->lag->sizes;
    size_t number = (size_t)place * sizes->nodes + (size_t)k;
    return (fr_lag_node *)(void *)(view->room + number * sizes->node);
}

static inline double *fr_lag_rows(fr_lag_node *node)
{
    return (double *)(void *)(node + 1);
}

static inline double *fr_lag_own(const fr_lag_view *view, fr_lag_node *node)
{
    return fr_lag_rows(node) + 2 * view->model->states;
}

/* Innovation and information, then the gain, then the row of H if each update has its own. */
static inline double *fr_lag_update_at(const fr_lag_view *view, int32_t place, int32_t k)
{
    const fr_lag_sizes *sizes = &view->lag->sizes;
    size_t number = (size_t)place * sizes->updates + (size_t)k;
    return fr_lag_updates_begin(view) + number * sizes->update;
}

static inline const double *fr_lag_row(const fr_lag_model *model, const double *update)
{
    return model->row != NULL ? model->row : update + 2 + model->states;
}

static inline fr_lag_mark *fr_lag_mark_at(const fr_lag_view *view, int64_t number)
{
    const fr_lag_sizes *sizes = &view->lag->sizes;
    size_t at = (size_t)number % sizes->marks;
    return (fr_lag_mark *)(void *)(fr_lag_marks_begin(view) + at * sizes->mark);
}

static inline double *fr_lag_column(fr_lag_mark *mark)
{
    return (double *)(void *)(mark + 1);
}

static inline double *fr_lag_left(const fr_lag_view *view, fr_lag_mark *mark)
{
    return fr_lag_column(mark) + view->model->states;
}

static inline double *fr_lag_pushed(const fr_lag_view *view, fr_lag_mark *mark)
{
    return fr_lag_left(view, mark) + view->model->states;
}

static inline double *fr_lag_passed(const fr_lag_view *view, fr_lag_mark *mark)
{
    return fr_lag_pushed(view, mark) + view->model->states;
}

static inline double *fr_lag_gathered(const fr_lag_view *view, fr_lag_mark *mark)
{
    return fr_lag_passed(view, mark) + view->model->states * view->model->states;
}

static inline fr_lag_point_held *fr_lag_point_at(const fr_lag_view *view, int64_t number)
{
    const fr_lag_sizes *sizes = &view->lag->sizes;
    double *begin = fr_lag_marks_begin(view) + sizes->marks * sizes->mark;
    fr_lag_point_held *points = (fr_lag_point_held *)(void *)begin;
    return points + (size_t)number % sizes->points;
}

/* End the last node of a run with a mark. */
void fr_lag_end_run(const fr_lag_view *view);

/* Begin with the place of the section in the making. */
void fr_lag_begin_section(fr_lag *lag);

/* That place. */
static inline int32_t fr_lag_making(const fr_lag *lag)
{
    return (lag->oldest + lag->held - 1) % FR_LAG_SECTIONS;
}

#endif
