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
/* HPF_B3x2 leaves of a bend by one its wavelength times 1/(6 pi), and within half a wavelength. */
#define LEFT_OF_BEND 0.0530516476972984
#define WIDTH_OF_BEND 0.5
/* Slower than this the slope of an error over distance is not asked for. */
#define SLOWEST_MPS 1.0

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
    double step_m, from_m; /* the step that fades, and where */
    double bend_from_m, bend_to_m; /* points in front of a bend, and behind the one before */
    double largest;        /* of the last node */
    size_t first;          /* of this call, in the output */
} emission;

static double fading(const emission *out, double distance_m)
{
    double travel_m = distance_m - out->from_m;
    return out->step_m == 0.0 ? 0.0 : out->step_m * exp(-(travel_m > 0.0 ? travel_m : 0.0) / FADE_M);
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
    if (fmax(early->change, late->change) > lag->shape.tolerance_m)
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
    if (node->distance_m >= out->bend_from_m || node->distance_m <= out->bend_to_m)
        flags |= FR_POINT_UNSETTLED;
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
    emission out = {view, output, {0.0, 0.0, 0.0, {0.0, 0.0}, 0}, 0, end, 0.0, 0.0, HUGE_VAL,
                    -HUGE_VAL, 0.0, output->made};
    out.mark = lag->sections[lag->oldest].first_mark;
    if (origin->known == 0)
        return out;
    out.before.height = origin->height;
    out.before.velocity = origin->velocity;
    out.before.time_s = origin->time_s;
    out.before.flags = origin->flags;
    out.before.added = fr_lag_correct(origin->rows, view->model->states, lambda);
    out.step_m = origin->shift_m - out.before.added.height;
    out.from_m = origin->distance_m;
    out.bend_to_m = origin->bend_to_m;
    out.before.added.height += out.step_m;
    return out;
}

static void emit_section(emission *out, int32_t place)
{
    for (int32_t k = 0; k < out->view->lag->sections[place].nodes; k++)
        emit_span(out, fr_lag_node_at(out->view, place, k));
}

/* Travel speed at a mark, by the one before. */
static double speed_at_mark(const fr_lag_view *view, int64_t number)
{
    const fr_lag_mark *late = fr_lag_mark_at(view, number), *early = late;
    double speed_mps = 0.0;
    if (number > view->lag->first_mark)
        early = fr_lag_mark_at(view, number - 1);
    if (late->time_s > early->time_s)
        speed_mps = (late->distance_m - early->distance_m) / (late->time_s - early->time_s);
    return fmax(speed_mps, SLOWEST_MPS);
}

/* What comes out stays, so readings to come that change level and slope at its end bend the profile
 * there. Say from where on that may show, and up to where. */
static void foresee_bend(emission *out, const double *rows)
{
    const fr_lag_view *view = out->view;
    const fr_lag_mark *last = fr_lag_mark_at(view, out->end - 1);
    double m[FR_LAG_STATES], speed_mps = speed_at_mark(view, out->end - 1), width_m, bend;
    for (int32_t i = 0; i < view->model->states; i++)
        m[i] = rows[view->model->states + i] / speed_mps + rows[i] / FADE_M;
    bend = fr_lag_change_of(view, out->end, m);
    view->lag->origin.bend_to_m = -HUGE_VAL;
    if (!(LEFT_OF_BEND * view->lag->shape.wavelength_m * bend > view->lag->shape.tolerance_m))
        return;
    width_m = WIDTH_OF_BEND * view->lag->shape.wavelength_m;
    out->bend_from_m = last->distance_m - width_m;
    view->lag->origin.bend_to_m = last->distance_m + width_m;
}

/* Remember the last node of the oldest section, before its rows go. */
static void keep_rows(const fr_lag_view *view, double *rows)
{
    const fr_lag *lag = view->lag;
    fr_lag_node *node = fr_lag_node_at(view, lag->oldest, lag->sections[lag->oldest].nodes - 1);
    (void)memcpy(rows, fr_lag_rows(node), 2u * (size_t)view->model->states * sizeof *rows);
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
    end.distance_m = lag->distance_m;
    for (; lag->first_point < lag->points; lag->first_point++)
        emit(out, fr_lag_point_at(out->view, lag->first_point), &end, out->before.added);
}

void fr_lag_release(const fr_lag_view *view, fr_lag_output *output)
{
    fr_lag *lag = view->lag;
    int32_t second = (lag->oldest + 1) % FR_LAG_SECTIONS;
    int64_t begin = lag->sections[lag->oldest].first_mark, end = lag->sections[second].first_mark;
    double lambda[FR_LAG_STATES] = {0.0}, rows[2 * FR_LAG_STATES];
    emission out;
    fr_lag_settle(view);
    /* The mark before begins the line to the first one, as it is known now. */
    fr_lag_sigmas(view, begin > lag->first_mark ? begin - 1 : begin, end, 0);
    fr_lag_back_marks(view, end, lambda);
    keep_rows(view, rows);
    fr_lag_back_nodes(view, lag->oldest, lambda);
    out = begin_emission(view, output, end, lambda);
    foresee_bend(&out, rows);
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
    double behind[FR_LAG_STATES] = {0.0};
    emission out;
    fr_lag_end_run(view);
    if (lambda != NULL)
        (void)memcpy(behind, lambda, (size_t)view->model->states * sizeof *behind);
    fr_lag_settle(view);
    fr_lag_sigmas(view, begin > lag->first_mark ? begin - 1 : begin, lag->marks, 1);
    for (int32_t k = lag->held - 1; k >= 0; k--)
        fr_lag_back_nodes(view, (lag->oldest + k) % FR_LAG_SECTIONS, behind);
    out = begin_emission(view, output, lag->marks, behind);
    for (int32_t k = 0; k < lag->held; k++)
        emit_section(&out, (lag->oldest + k) % FR_LAG_SECTIONS);
    emit_rest(&out);
}
