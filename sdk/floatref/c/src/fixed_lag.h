/* SPDX-License-Identifier: Apache-2.0
 *
 * Smoothing with a fixed lag and bounded memory, for any filter of a height and its velocity.
 *
 * A filter with nodes hands over, node by node, what the backward pass of Bryson and Frazier
 * needs; its owner hands over the points of the profile as they are reached. When a section is
 * old enough, see lag_clock.h, its points come out: elevation, 1-sigma behind HPF_B3x2, flags.
 *
 * Order of calls. For each node, once it is filtered: fr_lag_begin_node(), fr_lag_update() for each
 * scalar update in order, fr_lag_end_node(). Points come before: fr_lag_point() with their samples,
 * in the span that they lie in; fr_lag_end_node() takes how many of them lie before the node. If it
 * returns 1, fr_lag_release() follows at once. At the end of the run comes a last node at the last
 * sample, of kind 0, unless there is one; then fr_lag_finish().
 *
 * Everything is double, in both builds: see docs/c-library.md. Objects hold no pointer, so the
 * owner makes an fr_lag_view on its stack in each call.
 */
#ifndef FR_FIXED_LAG_H
#define FR_FIXED_LAG_H

#include "lag_clock.h"

enum { FR_LAG_STATES = 10 }; /* at most; the first is the height, the second its velocity */

/* What a filter has of its own. A node is F from the node before, states that begin anew, then
 * its updates. */
typedef struct fr_lag_model {
    int32_t states;
    int32_t own;       /* numbers of a node that the two functions take, as given at its begin */
    const double *row; /* H of every update, or NULL: each brings its own, which is stored */
    /* lambda <- F' lambda over a span in s, F with the states that begin anew. */
    void (*back)(const double *own, double span, double *lambda);
    /* Psi <- F Psi; Psi is states x states, row by row. */
    void (*forth)(const double *own, double span, double *psi);
    const double *seen; /* what later readings can show of a state: rows x states, row by row; */
    int32_t seen_rows;  /* the last of them only at a standstill. NULL: the state itself */
} fr_lag_model;

/* Sizes and constants. The owner fills it from its configuration. */
typedef struct fr_lag_shape {
    fr_lag_pace pace;
    double node_s;       /* between two nodes */
    double interval_m;   /* between points */
    double wavelength_m; /* cut-off of each pass of HPF_B3x2, for the 1-sigma */
    double noise_m;      /* 1-sigma of a reading of the height sensor, which passes as it is */
    double tolerance_m;  /* points that readings to come may change by more, 1-sigma, are flagged */
} fr_lag_shape;

/* Numbers of 8 bytes of one node, update and mark; how many a section has, and marks and points in
 * all. */
typedef struct fr_lag_sizes {
    size_t node, update, mark;
    size_t nodes, updates, marks, points;
} fr_lag_sizes;

/* A point before it is smoothed: elevation from the height of the node before and `since` its
 * time s, at that node's height and velocity of zero. */
typedef struct fr_lag_point_held {
    double elevation, since;
    int32_t flags, reserved;
} fr_lag_point_held;

/* A node at its end, behind its updates. */
typedef struct fr_lag_node_end {
    double height, velocity; /* filtered */
    double rise, climb;      /* of them since the integrals from the node before: by F and updates */
    double distance_m;       /* of the encoder */
    double largest;          /* 1-sigma above which points of the span before are uncertain */
    const double *covariance; /* states x states, row by row */
    int64_t points;           /* reached before the node, from the first of the run */
    int32_t flags;            /* of the point before and of the one behind it */
    int32_t mark;             /* whether it is a mark, as the SDK's segments end with one */
} fr_lag_node_end;

/* Where output goes; `made` counts on. */
typedef struct fr_lag_output {
    fr_real *elevation, *sigma;
    uint8_t *flags;
    size_t made;
} fr_lag_output;

/* How errors pass on since the last mark: x -> psi x, with `gathered` information and `pushed`. */
typedef struct fr_lag_link {
    double psi[FR_LAG_STATES * FR_LAG_STATES];
    double gathered[FR_LAG_STATES * FR_LAG_STATES];
    double pushed[FR_LAG_STATES]; /* lambda before = psi' lambda behind + pushed */
} fr_lag_link;

typedef struct fr_lag_section {
    int32_t nodes, updates;
    int64_t first_mark; /* its first of all marks of the run */
} fr_lag_section;

/* The node at which the oldest section begins, and what was given out there. */
typedef struct fr_lag_origin {
    double rows[2 * FR_LAG_STATES]; /* of the covariance: height, velocity */
    double height, velocity, time_s, distance_m;
    double shift_m, rate;  /* correction that was given out, and its rate in m/s */
    double speed;          /* along the road, in m/s */
    int32_t known; /* 0 before the first section has come out */
    int32_t flags; /* for the next point */
} fr_lag_origin;

/* The state between two calls. Arrays lie in the room behind the owner, see fr_lag_numbers(). */
typedef struct fr_lag {
    fr_lag_shape shape;
    fr_lag_sizes sizes;
    fr_lag_link link;
    fr_lag_section sections[FR_LAG_SECTIONS]; /* places, used in turn */
    fr_lag_origin origin;
    int32_t oldest; /* place of the oldest section */
    int32_t held;   /* sections with the one in the making, 1 to 3 */
    int32_t kind;   /* of the node in the making */
    int32_t composing;         /* whether the last node stored is a standstill's in the making */
    int32_t linked;            /* whether there were nodes since the last mark */
    int64_t first_point, points; /* the oldest that is held, and how many there were */
    int64_t first_mark, marks;   /* the same of marks */
    double time_s, distance_m;   /* of the last node */
    double apart;                /* what has gone since a segment began, in distances of marks */
    int32_t begun, reserved;     /* whether the next node does not begin a segment */
    double covariance[FR_LAG_STATES * FR_LAG_STATES]; /* where the last section ended */
} fr_lag;

/* What every function takes: made anew in each call of the owner. */
typedef struct fr_lag_view {
    const fr_lag_model *model;
    fr_lag *lag;
    double *room;
} fr_lag_view;

/* How many numbers of 8 bytes the arrays take: 0 if the shape is not possible. */
uint64_t fr_lag_numbers(const fr_lag_model *model, const fr_lag_shape *shape);

/* Begin with empty memory, all of it cleared. */
void fr_lag_begin(const fr_lag_view *view, const fr_lag_shape *shape);

void fr_lag_point(const fr_lag_view *view, const fr_lag_point_held *point);

/* A node `span` s behind the one before, of the kind that the clock has said for it. */
void fr_lag_begin_node(const fr_lag_view *view, int32_t kind, double span, const double *own);
/* Gain K, innovation over its variance S, 1/S; `row` of H only if the model has none. */
void fr_lag_update(const fr_lag_view *view, const double *gain, const double *row,
                   double innovation, double information);
/* Return whether the oldest section has to come out before the next node. */
int fr_lag_end_node(const fr_lag_view *view, const fr_lag_node_end *node);

/* Smooth back from the last node, and give out the oldest section. */
void fr_lag_release(const fr_lag_view *view, fr_lag_output *output);

/* Give out all that is left; `lambda` behind the last node, or NULL for zero. */
void fr_lag_finish(const fr_lag_view *view, const double *lambda, fr_lag_output *output);

#endif
