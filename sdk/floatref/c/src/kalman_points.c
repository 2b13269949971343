/* SPDX-License-Identifier: Apache-2.0
 *
 * From the Kalman filter to the fixed-lag machinery: points of the profile, and nodes.
 */
#include <math.h>

#include "kalman_smoother.h"

/* A point at an elevation as filtered, `since` s behind the latest node. */
static void hold_point(const fr_kalman_view *view, double elevation, double since)
{
    fr_kalman_progress *progress = &view->kalman->progress;
    double start = progress->height + since * progress->velocity;
    fr_lag_point_held point = {elevation - start, since, progress->flags, 0};
    if (elevation != elevation)
        point.flags |= FR_POINT_MISSING;
    fr_lag_point(&view->lag, &point);
    progress->flags = 0;
}

/* A point in the step before a sample, on the line between both elevations. */
static void hold_between(const fr_kalman_view *view, const fr_kalman_step *step, double now,
                         double part)
{
    const fr_kalman *kalman = view->kalman;
    double before = kalman->progress.elevation, steps;
    steps = (double)(step->at - kalman->progress.node) - (1.0 - part);
    hold_point(view, before + part * (now - before), steps * kalman->engine.model.step);
}

/* Take the points that a sample reaches. Return 1 if the last of them is the sample itself, which
 * has not been held yet. */
static int take_points_before(const fr_kalman_view *view, const fr_kalman_step *step, double now)
{
    fr_points *points = &view->kalman->points;
    fr_place_of_point place = {0, 0};
    fr_points_begin(points, step->count);
    while (fr_points_reached(points, step->count) != 0) {
        fr_points_next(points, step->count, &place);
        if (place.whole == 0)
            hold_between(view, step, now, (double)place.part);
    }
    fr_points_pass(points, step->count);
    return place.whole;
}

static void hand_over_updates(const fr_kalman_view *view, const fr_kalman_node *node)
{
    for (int32_t k = 0; k < node->updated; k++) {
        const fr_kalman_update *update = &node->updates[k];
        fr_lag_update(&view->lag, update->gain, update->row, update->innovation,
                      update->information);
    }
}

/* Whether the sub-block behind a node ends in the next segment. */
static int ends_kalman_segment(const fr_kalman *kalman, int64_t at)
{
    int64_t length = kalman->engine.model.sub_block, segment = kalman->progress.segment;
    return (at / length + 1) * length / segment > at / segment;
}

/* Return whether points have to come out. */
static int end_node(const fr_kalman_view *view, const fr_kalman_node *node, int64_t points)
{
    fr_kalman *kalman = view->kalman;
    fr_kalman_progress *progress = &kalman->progress;
    fr_lag_node_end end = {0};
    progress->height = kalman->engine.state.x[FR_K_HEIGHT];
    progress->velocity = kalman->engine.state.x[FR_K_VELOCITY];
    progress->node = node->at;
    end.height = progress->height;
    end.velocity = progress->velocity;
    end.rise = node->rise;
    end.climb = node->climb;
    end.distance_m = (double)progress->furthest * kalman->engine.metres_per_count;
    end.largest = HUGE_VAL;
    end.covariance = &kalman->engine.state.p[0][0];
    end.points = points;
    end.mark = ends_kalman_segment(kalman, node->at);
    return fr_lag_end_node(&view->lag, &end);
}

/* Hand over a node with the points before it. */
static int hand_over_node(const fr_kalman_view *view, const fr_kalman_node *node, int32_t kind,
                          int64_t points)
{
    double own[FR_K_OWN];
    fr_kalman_own(node, own);
    fr_lag_begin_node(&view->lag, kind, node->span, own);
    hand_over_updates(view, node);
    return end_node(view, node, points);
}

static void pass_node(const fr_kalman_view *view, const fr_kalman_node *node, int64_t points,
                      fr_lag_output *output)
{
    fr_kalman *kalman = view->kalman;
    int32_t kind = fr_lag_clock_node(&kalman->clock, &kalman->lag.shape.pace, points,
                                     node->observed);
    if (hand_over_node(view, node, kind, points) != 0)
        fr_lag_release(&view->lag, output);
}

void fr_kalman_hand_over(const fr_kalman_view *view, const fr_kalman_step *step,
                         const fr_kalman_node *node, fr_lag_output *output)
{
    fr_kalman *kalman = view->kalman;
    fr_kalman_progress *progress = &kalman->progress;
    double rise = step->is_node != 0 ? node->rise : 0.0;
    double now = step->reference_height - rise - step->height;
    int whole;
    progress->flags |= step->missing != 0 ? FR_POINT_MISSING : 0;
    whole = take_points_before(view, step, now);
    progress->furthest = step->count > progress->furthest || step->at == 0 ? step->count
                                                                          : progress->furthest;
    if (step->is_node != 0)
        pass_node(view, node, kalman->points.next - (whole != 0 ? 1 : 0), output);
    progress->elevation = step->reference_height - step->height;
    if (whole != 0)
        hold_point(view, progress->elevation,
                   (double)(step->at - progress->node) * kalman->engine.model.step);
}

/* Lambda behind the end, by the constants there; 0 if nothing is observed. */
static int find_beyond(const fr_kalman *kalman, double *lambda)
{
    fr_kalman_observation observed;
    const fr_kalman_engine *engine = &kalman->engine;
    if (fr_kalman_schedule_end(&engine->references, engine->state.latest, &observed) == 0)
        return 0;
    fr_kalman_beyond(&engine->model, &engine->state, &observed, lambda);
    return 1;
}

void fr_kalman_hand_over_end(const fr_kalman_view *view, fr_lag_output *output)
{
    fr_kalman *kalman = view->kalman;
    fr_kalman_engine *engine = &kalman->engine;
    double lambda[FR_K_STATES];
    fr_kalman_node node;
    if (engine->state.latest < 0)
        return;
    if (engine->state.steps > 0.0) {
        fr_kalman_make_node(&engine->model, &engine->state, NULL, &node);
        (void)hand_over_node(view, &node, 0, kalman->points.next);
    }
    fr_lag_finish(&view->lag, find_beyond(kalman, lambda) != 0 ? lambda : NULL, output);
}
