/* SPDX-License-Identifier: Apache-2.0
 *
 * Nodes of the road-prior smoother: filtered as soon as the encoder behind them is known.
 */
#include <math.h>

#include "road_prior.h"
#include "samples.h"

/* Nodes after which the spectrum of the road is renewed by that of the road so far. */
#define RENEWAL 500
/* Less than that is an edge of the road under a laser that sways: cracks, joints, leaves. */
#define LEAST_LEAP_M 0.01
/* Part of a lean that one wheel path has from the mean of all, where that is levelled. */
#define LEVELLED_LEAN (1.0 / 3.0)

double *fr_road_room(fr_road_prior *road)
{
    return (double *)FR_BEHIND(road, fr_road_prior);
}

fr_road_waiting *fr_road_waiting_at(fr_road_prior *road, int64_t node)
{
    double *begin = fr_road_room(road) + fr_excitation_numbers(road->excitation.reach);
    return (fr_road_waiting *)(void *)begin + node % (road->excitation.reach + 1);
}

fr_lag_view fr_road_view(fr_road_prior *road)
{
    size_t waiting = (size_t)road->excitation.reach + 1u;
    fr_lag_view view = {&fr_road_lag_model, &road->lag, fr_road_room(road)};
    view.room += fr_excitation_numbers(road->excitation.reach) + waiting * FR_WAITING_NUMBERS;
    return view;
}

/* Whether the next node lies in the next segment. */
static int32_t ends_segment(const fr_road_prior *road)
{
    int64_t at = road->filtered * road->sub_block;
    return (at + road->sub_block) / road->segment > at / road->segment;
}

/* Hand a node that is filtered to the smoother; a section that is old enough comes out. */
static void hand_over(fr_road_prior *road, const fr_road_waiting *at, const fr_road_node *node,
                      int32_t leapt, fr_lag_output *output)
{
    fr_lag_view view = fr_road_view(road);
    fr_lag_node_end end = {0.0, 0.0, node->rise, node->climb, at->distance_m, road->largest,
                           NULL, at->points, leapt ? FR_POINT_LEAP : 0, ends_segment(road)};
    end.height = road->filter.x[ROAD_R];
    end.velocity = road->filter.x[ROAD_V];
    end.covariance = road->filter.p[0];
    fr_lag_begin_node(&view, at->kind, at->span, node->own);
    if (node->updated != 0)
        fr_lag_update(&view, node->gain, NULL, node->innovation, node->information);
    if (fr_lag_end_node(&view, &end) != 0)
        fr_lag_release(&view, output);
}

/* The travel to a node; where the encoder does not give it, that to the node before. */
static double travel_to(fr_road_prior *road, const fr_road_waiting *at)
{
    double travel = at->place_m - road->place_m;
    if (road->filtered > 0 && travel == travel)
        road->pace_m = fmax(travel, 0.0);
    road->place_m = at->place_m;
    return road->pace_m;
}

/* Filter a node with what is known of it by now. */
static void filter_node(fr_road_prior *road, const fr_road_waiting *at, fr_road_ends *ends,
                        fr_lag_output *output)
{
    fr_road_node node;
    double elevation;
    int32_t leapt;
    ends->travel = travel_to(road, at);
    ends->seen = at->seen;
    ends->missing = at->missing;
    ends->span = at->span;
    ends->once = at->once;
    ends->twice = at->twice;
    ends->anew = at->anew;
    fr_road_step(&road->model, &road->filter, ends, &node);
    leapt = node.let_go != 0 && fabs(node.error) > LEAST_LEAP_M;
    hand_over(road, at, &node, leapt, output);
    elevation = road->filter.x[ROAD_R] - at->seen;
    fr_spectrum_add(&road->spectrum, elevation, ends->travel, node.gain[ROAD_R] * node.error,
                    node.gain[ROAD_V] * node.error);
}

void fr_road_filter_next(fr_road_prior *road, fr_lag_output *output)
{
    const fr_road_waiting *at = fr_road_waiting_at(road, road->filtered);
    fr_road_ends ends = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0};
    double a, response;
    fr_excitation_take(&road->excitation, fr_road_room(road), road->filtered, &a, &response);
    ends.leaning = a * (1.0 - at->level * (1.0 - LEVELLED_LEAN));
    ends.tilting = a * response * (1.0 - at->level);
    ends.along = a * (1.0 - at->level);
    if (road->filtered % RENEWAL == 0)
        fr_spectrum_renew(&road->spectrum, road->reading, &road->model);
    filter_node(road, at, &ends, output);
    /* Points before the node were reached before the renewal. */
    if (road->filtered % RENEWAL == 0)
        road->largest = road->most_share * fr_spectrum_bend_m(&road->spectrum);
    road->filtered++;
}

/* A node at the last sample, which has no reading of its own; the inputs stay as they were. */
static void filter_last(fr_road_prior *road, fr_lag_output *output)
{
    const fr_road_motion *motion = &road->motion;
    fr_road_ends ends = {road->filter.leaning, road->filter.tilting, road->filter.along,
                         0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0};
    fr_road_waiting at = {0.0, motion->velocity, motion->height, 0.0, NAN, 0.0, 0.0, 0.0,
                          road->progress.reached, FR_LAG_MARK, 0};
    at.span = motion->steps * road->step;
    at.distance_m = (double)(road->count - road->progress.points.origin) * road->metres_per_count;
    at.place_m = at.distance_m;
    /* Behind a place that is not known, no travel is. */
    road->pace_m = 0.0;
    filter_node(road, &at, &ends, output);
}

void fr_road_end(fr_road_prior *road, fr_lag_output *output)
{
    fr_lag_view view = fr_road_view(road);
    while (road->filtered < road->nodes)
        fr_road_filter_next(road, output);
    if (road->motion.steps > 0)
        filter_last(road, output);
    fr_lag_finish(&view, NULL, output);
}
