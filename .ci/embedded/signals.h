/* SPDX-License-Identifier: Apache-2.0
 *
 * Signals of a wheel path at 20 m/s, by integers and exact products: they have the same bits
 * wherever they are computed.
 */
#ifndef SIGNALS_H
#define SIGNALS_H

#include <floatref.h>

enum { MOST = 160 }; /* samples of 10 ms at 16 kHz */

typedef struct signals {
    uint32_t seed, rate;
    int64_t sample; /* of the run, behind those of the arrays */
    fr_real force[MOST], height[MOST], speed[MOST], cutoff[MOST], step[MOST];
    int64_t counts[MOST]; /* of 1 mm */
} signals;

/* Fill the arrays with the next `count` samples. */
void signals_next(signals *s, size_t count);

#endif
