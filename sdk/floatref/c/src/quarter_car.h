/* SPDX-License-Identifier: Apache-2.0
 *
 * The Golden Car as two modes, each a complex number that is advanced by one interval.
 */
#ifndef FR_QUARTER_CAR_H
#define FR_QUARTER_CAR_H

#include "samples.h"

typedef struct fr_mode {
    fr_real pole_re, pole_im, gain_re, gain_im; /* of one interval; the gain is in m/km */
    fr_real x, y;                               /* real and imaginary part of the state */
} fr_mode;

/* Set both modes, at rest, for a slope that is held for `step_s`. */
void fr_golden_car(fr_mode modes[2], double step_s);

/* Advance a mode by one interval and return its share of the output. The newest state enters each
 * sum last: the chain from point to point stays short. Products of the state come first, since
 * compilers keep this order and a processor begins with the oldest. */
static inline fr_real fr_mode_step(fr_mode *mode, fr_real slope)
{
    fr_real x = mode->x, y = mode->y, across_x = mode->pole_im * y, across_y = mode->pole_im * x;
    fr_real along_x = mode->pole_re * x, along_y = mode->pole_re * y;
    mode->x = (mode->gain_re * slope - across_x) + along_x;
    mode->y = (mode->gain_im * slope + across_y) + along_y;
    return mode->x;
}

#endif
