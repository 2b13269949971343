/* SPDX-License-Identifier: Apache-2.0
 *
 * Points come out: the cubic of the corrections at both nodes, 1-sigma as a line between marks.
 *
 * What has come out stays. Where later readings have changed the level at the end of it, what
 * follows begins there, and the step fades over so much travel that HPF_B3x2 takes it away.
 */
#include <math.h>
#include <string.h>

#include "lag_back.h"
#include "lag_sigma.h"
#include "samples.h"

/* Over so much travel a step fades. */
#define FADE_M 500.0
/* Below this speed a rate in time is no slope along the road. */
#define SLOWEST_MPS 1.0
#define HALF_SECOND 0.5

/* A node with its correction, as the points behind it need it. */
typedef struct corrected {
    double height, velocity, time_s;
    fr_lag_correction added;
    int32_t flags;
} corrected;

/* Where the emission is. */
typedef struct emission {
    const fr_lag_view *view;
    fr_lag_output *output;
    corrected before;
    int64_t mark, end; /* the mark at or behind the point, and behind the last one to be used */
    double step_m, slope, from_m; /* the step that fades, its slope at first, and where */
    double largest;        /* of the last node */
    size_t first;          /* of this call, in the output */
} emission;

static double fading(const emission *out, double distance_m)
{
    double travel_m = fmax(distance_m - out->from_m, 0.0);
    double line_m = out->step_m + (out->slope + out->step_m / FADE_M) * travel_m;
    return line_m == 0.0 ? 0.0 : line_m * exp(-travel_m / FADE_M);
}

/* The correction `since` s behind a node, `span` s before the next. */
static double cubic(const corrected *before, fr_lag_correction near, double span, double since)
{
    double t = span > 0.0 ? since / span : 0.0, rise = near.height - before->added.height;
    double slope_0 = span * before->added.velocity, slope_1 = span * near.velocity;
    double square = 3.0 * rise - 2.0 * slope_0 - slope_1, cube = slope_0 + slope_1 - 2.0 * rise;
    return before->added.height + t * (slope_0 + t * (square + t * cube));
}

/* 1-sigma at a time, and whether readings to come may change it. */
static double sigma_at(emission *out, double time_s, int32_t *flags)
{
    const fr_lag *lag = out->view->lag;
    while (out->mark + 1 < out->end && fr_lag_mark_at(out->view, out->mark)->time_s < time_s)
        out->mark++;
    const fr_lag_mark *late = fr_lag_mark_at(out->view, out->mark), *early = late;
    if (out->mark > lag->first_mark)
        early = fr_lag_mark_at(out->view, out->mark - 1);
    if (fmax(early->doubt, late->doubt) > lag->shape.tolerance_m)
        *flags |= FR_POINT_UNSETTLED;
    if (!(late->time_s > early->time_s) || time_s >= late->time_s)
        return late->sigma;
    return early->sigma + (time_s - early->time_s) * (late->sigma - early->sigma) /
                              (late->time_s - early->time_s);
}

static void emit(emission *out, const fr_lag_point_held *point, const fr_lag_node *node,
                 fr_lag_correction near)
{
    const corrected *before = &out->before;
    fr_lag_output *output = out->output;
    int32_t flags = point->flags | before->flags;
    double sigma = sigma_at(out, before->time_s + point->since, &flags);
    double height = before->height + point->since * before->velocity;
    if (sigma > node->largest)
        flags |= FR_POINT_UNCERTAIN;
    height += cubic(before, near, node->span, point->since);
    output->elevation[output->made] = FR_R(point->elevation + height);
    output->sigma[output->made] = FR_R(sigma);
    output->flags[output->made] = (uint8_t)flags;
    output->made++;
    out->before.flags = 0;
}

/* Give out the points of a span, and go to its end. */
static void emit_span(emission *out, fr_lag_node *node)
{
    fr_lag *lag = out->view->lag;
    const double *found = fr_lag_rows(node);
    double left_m = fading(out, node->distance_m);
    fr_lag_correction near = {found[0] + left_m + node->rise, found[1] + node->climb};
    while (lag->first_point < node->points) {
        emit(out, fr_lag_point_at(out->view, lag->first_point), node, near);
        lag->first_point++;
    }
    if (node->flags != 0 && out->output->made > out->first)
        out->output->flags[out->output->made - 1u] |= (uint8_t)node->flags;
    out->largest = node->largest;
    out->before.flags |= node->flags;
    out->before.height = node->height;
    out->before.velocity = node->velocity;
    out->before.time_s += node->span;
    out->before.added.height = found[0] + left_m;
    out->before.added.velocity = found[1];
}

/* Begin where the last section that has come out has ended; lambda is the one behind that. */
static emission begin_emission(const fr_lag_view *view, fr_lag_output *output, int64_t end,
                               const double *lambda)
{
    fr_lag *lag = view->lag;
    const fr_lag_origin *origin = &lag->origin;
    emission out = {view, output, {0.0, 0.0, 0.0, {0.0, 0.0}, 0}, 0, end,
                    0.0,  0.0,    0.0,  0.0, output->made};
    out.mark = lag->sections[lag->oldest].first_mark;
    if (origin->known == 0)
        return out;
    out.before.height = origin->height;
    out.before.velocity = origin->velocity;
    out.before.time_s = origin->time_s;
    out.before.flags = origin->flags;
    out.before.added = fr_lag_correct(origin->rows, view->model->states, lambda);
    out.step_m = origin->shift_m - out.before.added.height;
    if (origin->speed > 0.0)
        out.slope = (origin->rate - out.before.added.velocity) / origin->speed;
    out.from_m = origin->distance_m;
    out.before.added.height += out.step_m;
    return out;
}

static void emit_section(emission *out, int32_t place)
{
    for (int32_t k = 0; k < out->view->lag->sections[place].nodes; k++)
        emit_span(out, fr_lag_node_at(out->view, place, k));
}

/* Remember the last node of the oldest section, before its rows go. */
static void keep_rows(const fr_lag_view *view, double *rows)
{
    const fr_lag *lag = view->lag;
    fr_lag_node *node = fr_lag_node_at(view, lag->oldest, lag->sections[lag->oldest].nodes - 1);
    (void)memcpy(rows, fr_lag_rows(node), 2u * (size_t)view->model->states * sizeof *rows);
}

/* Slope of what fades. */
static double fading_slope(const emission *out, double distance_m)
{
    double travel_m = fmax(distance_m - out->from_m, 0.0), first = out->slope + out->step_m / FADE_M;
    double line_m = out->step_m + first * travel_m;
    return (first - line_m / FADE_M) * exp(-travel_m / FADE_M);
}

/* Speed along the road in the last half second of the oldest section; 0 where it is slow, or next
 * to a standstill. */
static double speed_at_end(const fr_lag_view *view)
{
    int32_t place = view->lag->oldest, last = view->lag->sections[place].nodes - 1, k = last;
    double span = 0.0, speed;
    while (k > 0 && fr_lag_node_at(view, place, k)->mark < 0 && span < HALF_SECOND - 1e-9) {
        span += fr_lag_node_at(view, place, k)->span;
        k--;
    }
    speed = fr_lag_node_at(view, place, last)->distance_m - fr_lag_node_at(view, place, k)->distance_m;
    speed = span > 0.0 ? speed / span : 0.0;
    return speed >= SLOWEST_MPS ? speed : 0.0;
}

static void keep_origin(const emission *out, const double *rows)
{
    fr_lag *lag = out->view->lag;
    fr_lag_origin *origin = &lag->origin;
    int32_t last = lag->sections[lag->oldest].nodes - 1;
    (void)memcpy(origin->rows, rows, 2u * (size_t)out->view->model->states * sizeof *rows);
    origin->height = out->before.height;
    origin->velocity = out->before.velocity;
    origin->time_s = out->before.time_s;
    origin->distance_m = fr_lag_node_at(out->view, lag->oldest, last)->distance_m;
    origin->shift_m = out->before.added.height;
    origin->speed = speed_at_end(out->view);
    origin->rate = out->before.added.velocity + fading_slope(out, origin->distance_m) * origin->speed;
    origin->flags = out->before.flags;
    origin->known = 1;
}

/* Points at the last node itself, behind it. */
static void emit_rest(emission *out)
{
    fr_lag *lag = out->view->lag;
    fr_lag_node end;
    (void)memset(&end, 0, sizeof end);
    end.largest = out->largest;
    for (; lag->first_point < lag->points; lag->first_point++)
        emit(out, fr_lag_point_at(out->view, lag->first_point), &end, out->before.added);
}

void fr_lag_release(const fr_lag_view *view, fr_lag_output *output)
{
    fr_lag *lag = view->lag;
    int32_t second = (lag->oldest + 1) % FR_LAG_SECTIONS;
    int64_t begin = lag->sections[lag->oldest].first_mark, end = lag->sections[second].first_mark;
    double lambda[FR_LAG_STATES] = {0}, rows[2 * FR_LAG_STATES];
    emission out;
    fr_lag_settle(view);
    fr_lag_sigmas(view, begin, end, 0);
    fr_lag_back_marks(view, end, lambda);
    keep_rows(view, rows);
    fr_lag_back_nodes(view, lag->oldest, lambda);
    out = begin_emission(view, output, end, lambda);
    emit_section(&out, lag->oldest);
    keep_origin(&out, rows);
    fr_lag_link_forget(view, end);
    lag->oldest = second;
    fr_lag_begin_section(lag);
}

void fr_lag_finish(const fr_lag_view *view, const double *lambda, fr_lag_output *output)
{
    fr_lag *lag = view->lag;
    int64_t begin = lag->sections[lag->oldest].first_mark;
    double behind[FR_LAG_STATES] = {0};
    emission out;
    fr_lag_end_run(view);
    if (lambda != NULL)
        (void)memcpy(behind, lambda, (size_t)view->model->states * sizeof *behind);
    fr_lag_settle(view);
    fr_lag_sigmas(view, begin, lag->marks, 1);
    for (int32_t k = lag->held - 1; k >= 0; k--)
        fr_lag_back_nodes(view, (lag->oldest + k) % FR_LAG_SECTIONS, behind);
    out = begin_emission(view, output, lag->marks, behind);
    for (int32_t k = 0; k < lag->held; k++)
        emit_section(&out, (lag->oldest + k) % FR_LAG_SECTIONS);
    emit_rest(&out);
}
