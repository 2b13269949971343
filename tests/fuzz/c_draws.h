/* SPDX-License-Identifier: Apache-2.0
 *
 * Numbers, samples and readings drawn at random, for the fuzzer of the C library.
 */
#ifndef C_DRAWS_H
#define C_DRAWS_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "floatref.h"

enum { MOST = 200, POINTS = 4000 };

typedef struct arrays {
    fr_real *x, *h, *f, *s, *p, *y, *z; /* p: shares */
    int64_t *n;
    fr_span *spans;
    double *imu[7], *heights;
    uint8_t *b;
    size_t count, capacity, written;
} arrays;

static uint64_t state;

static uint32_t draw(uint32_t below)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(state >> 33) % below;
}

static double odd_number(void)
{
    static const double odd[] = {0.0,   -0.0,  1e-300, -1.0, 1e300,     INFINITY, -INFINITY,
                                 1e-30, 1e-12, 0.5,    2.0,  3.4e38,    1e12,     0.25};
    uint32_t k = draw(sizeof odd / sizeof *odd + 1);
    return k == sizeof odd / sizeof *odd ? NAN : odd[k];
}

static double number(void)
{
    return draw(400) == 0 ? odd_number() : (double)draw(2000) / 100.0;
}

static fr_real *drawn_reals(size_t count)
{
    fr_real *x = malloc(count * sizeof *x + (count == 0));
    for (size_t i = 0; i < count; i++)
        x[i] = (fr_real)number();
    return x;
}

static double *drawn_doubles(size_t count)
{
    double *x = malloc(count * sizeof *x + (count == 0));
    int odd = draw(3) == 0;
    for (size_t i = 0; i < count; i++)
        x[i] = odd ? number() : (double)draw(200) / 100.0 - 1.0;
    return x;
}

static arrays drawn_arrays(int64_t *counts)
{
    arrays a;
    memset(&a, 0, sizeof a);
    a.count = draw(4) ? draw(MOST) : draw(3);
    a.capacity = draw(6) ? POINTS : draw(MOST);
    a.x = drawn_reals(a.count);
    a.h = drawn_reals(a.count);
    a.f = drawn_reals(a.count);
    a.s = drawn_reals(a.count);
    a.p = drawn_reals(a.count);
    for (size_t i = 0; i < a.count && draw(9); i++)
        a.p[i] /= (fr_real)20;
    a.y = drawn_reals(a.capacity);
    a.z = drawn_reals(a.capacity);
    for (int i = 0; i < 7; i++)
        a.imu[i] = drawn_doubles(a.count);
    a.heights = drawn_doubles(a.capacity);
    a.b = malloc(a.capacity + (a.capacity == 0));
    a.spans = malloc(a.capacity * sizeof *a.spans + (a.capacity == 0));
    a.n = malloc(a.count * sizeof *a.n + (a.count == 0));
    for (size_t i = 0; i < a.count; i++)
        a.n[i] = *counts += draw(5000) == 0 ? (draw(2) ? -300000 : 1) * ((int64_t)1 << draw(33))
                                            : (int64_t)draw(60);
    *counts = *counts > ((int64_t)1 << 52) || *counts < -((int64_t)1 << 52) ? 0 : *counts;
    return a;
}

static void release(arrays *a)
{
    free(a->x);
    free(a->h);
    free(a->f);
    free(a->s);
    free(a->y);
    free(a->z);
    free(a->n);
    free(a->spans);
    for (int i = 0; i < 7; i++)
        free(a->imu[i]);
    free(a->heights);
    free(a->b);
    free(a->p);
}

#endif
