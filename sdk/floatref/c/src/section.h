/* SPDX-License-Identifier: Apache-2.0
 *
 * One sample of the high-pass sections with a cut-off of its own at every sample.
 *
 * They are the recursions (A.9) and (A.10) with the coefficients of Table A.1 taken from c_k of the
 * sample being computed. The state is not the past input but the part removed from it, e = x - y,
 * which changes slowly and by small amounts, so nothing cancels at a low cut-off. With D the
 * difference to the sample before,
 *
 *     S1:  D e = c_k (y_k + y_{k-1})
 *     S2:  D^2 e = c_k (y_k - y_{k-2}) + c_k^2 (y_k + 2 y_{k-1} + y_{k-2})
 *
 * Without the share of y_k itself, e_k is known before y_k and called r for S1 and t for S2; g is
 * the step that t is about to take. With a_k = c_k + c_k^2:
 *
 *     S1:  r += (c_{k-1} + c_k) y_{k-1},  y_k = (x_k - r) / (1 + c_k)
 *     S2:  g += (c_k^2 - c_k) y_{k-2},  b = a_{k-1} + c_k^2,
 *          t += g + 2 b y_{k-1},  g += (b + c_k^2) y_{k-1},  y_k = (x_k - t) / (1 + a_k)
 */
#ifndef FR_SECTION_H
#define FR_SECTION_H

#include "samples.h"

/* Whether an input and a c have occurred, the last of each, the states, and the last outputs. */
typedef struct fr_section {
    int32_t has_x, has_c;
    fr_real x, c, r, t, g, y1, y2, a;
} fr_section;

static inline int fr_section_started(const fr_section *section)
{
    return section->has_x != 0 && section->has_c != 0;
}

/* The part of S1 before the division, and of S2: its output is (x - t) / (1 + a). */
static inline void fr_section_1_prepare(fr_section *first, fr_real c)
{
    first->r = first->r + (first->c + c) * first->y1;
    first->c = c;
}

static inline void fr_section_2_prepare(fr_section *second, fr_real c, fr_real square)
{
    fr_real b = second->a + square;
    second->g = second->g + (square - c) * second->y2;
    second->t = (second->t + second->g) + (b + b) * second->y1;
    second->g = second->g + (b + square) * second->y1;
    second->a = c + square;
    second->y2 = second->y1;
}

static inline fr_real fr_section_1_step(fr_section *first, fr_real x, fr_real c)
{
    fr_section_1_prepare(first, c);
    first->y1 = (x - first->r) * (1 / (1 + c));
    return first->y1;
}

static inline fr_real fr_section_2_step(fr_section *second, fr_real x, fr_real c)
{
    fr_section_2_prepare(second, c, c * c);
    second->y1 = (x - second->t) * (1 / (1 + second->a));
    return second->y1;
}

/* Both sections share one division. */
static inline fr_real fr_section_12_step(fr_section *first, fr_section *second, fr_real x, fr_real c)
{
    fr_real square = c * c, one = 1 + c, two = one + square, both = 1 / (one * two);
    fr_section_1_prepare(first, c);
    first->y1 = (x - first->r) * (two * both);
    fr_section_2_prepare(second, c, square);
    second->y1 = (first->y1 - second->t) * (one * both);
    return second->y1;
}

static inline fr_real fr_section_21_step(fr_section *second, fr_section *first, fr_real x, fr_real c)
{
    fr_real square = c * c, one = 1 + c, two = one + square, both = 1 / (one * two);
    fr_section_2_prepare(second, c, square);
    second->y1 = (x - second->t) * (one * both);
    fr_section_1_prepare(first, c);
    first->y1 = (second->y1 - first->r) * (two * both);
    return first->y1;
}

/* Samples that may be missing: each is bridged by the one before it, and gives 0 before the first
 * input and c. A section starts by (A.14) or (A.15), backward (A.18) or (A.19). */
fr_real fr_section_1_any(fr_section *first, fr_real x, fr_real c);
fr_real fr_section_2_any(fr_section *second, fr_real x, fr_real c);
fr_real fr_section_12_any(fr_section *first, fr_section *second, fr_real x, fr_real c);
fr_real fr_section_21_any(fr_section *second, fr_section *first, fr_real x, fr_real c);

#endif
