/* SPDX-License-Identifier: Apache-2.0
 *
 * The transition of the Golden Car over one interval at constant slope, exact and diagonal.
 *
 * From the slope of the profile to the stroke of the suspension per distance, (2.9) and (2.10), the
 * car is H(s) = -K1 s^2 / D(s) with D(s) = mu s^4 + C (1 + mu) s^3 + (K1 + K2 (1 + mu)) s^2
 * + K1 C s + K1 K2. With a root p of D and the residue q = -K1 p^2 / D'(p) a mode has the pole
 * exp(p dt) and the gain 2 q (exp(p dt) - 1) / p; the output is the sum of the real parts.
 */
#include <math.h>

#include "quarter_car.h"

static const double K1 = 653.0, K2 = 63.3, C = 6.0, MU = 0.15; /* 1/s^2, 1/s^2, 1/s, 1 */
#define M_PER_KM 1000.0
#define NEWTON_STEPS 60

typedef struct number {
    double re, im;
} number;

static number times(number a, number b)
{
    number product = {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    return product;
}

static number over(number a, number b)
{
    double size = b.re * b.re + b.im * b.im;
    number quotient = {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
    return quotient;
}

/* a p + b: one step of Horner's scheme. */
static number horner(number a, number p, double b)
{
    number next = times(a, p);
    next.re += b;
    return next;
}

static number determinant(number p)
{
    number value = {MU, 0.0};
    value = horner(value, p, C * (1.0 + MU));
    value = horner(value, p, K1 + K2 * (1.0 + MU));
    value = horner(value, p, K1 * C);
    return horner(value, p, K1 * K2);
}

static number derivative(number p)
{
    number value = {4.0 * MU, 0.0};
    value = horner(value, p, 3.0 * C * (1.0 + MU));
    value = horner(value, p, 2.0 * (K1 + K2 * (1.0 + MU)));
    return horner(value, p, K1 * C);
}

/* The root of D near `p`, by Newton's method. */
static number root_near(number first)
{
    number p = first;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        number step = over(determinant(p), derivative(p));
        p.re -= step.re;
        p.im -= step.im;
    }
    return p;
}

/* exp(z) - 1 without a difference of numbers that are nearly one. */
static number expm1_of(number z)
{
    double half = sin(0.5 * z.im);
    number value = {expm1(z.re) * cos(z.im) - 2.0 * half * half, exp(z.re) * sin(z.im)};
    return value;
}

static void set_mode(fr_mode *mode, number near, double step_s)
{
    number p = root_near(near), moved = {p.re * step_s, p.im * step_s}, minus = {-K1, 0.0};
    number residue = over(times(minus, times(p, p)), derivative(p)), grown = expm1_of(moved);
    number gain = over(times(residue, grown), p);
    mode->pole_re = FR_R(grown.re + 1.0);
    mode->pole_im = FR_R(grown.im);
    mode->gain_re = FR_R(2.0 * M_PER_KM * gain.re);
    mode->gain_im = FR_R(2.0 * M_PER_KM * gain.im);
    mode->x = 0;
    mode->y = 0;
}

void fr_golden_car(fr_mode modes[2], double step_s)
{
    /* The sprung mass on its spring, and the unsprung mass between both springs, half damped. */
    number body = {-0.5 * C, sqrt(K2)}, axle = {-0.5 * C / MU, sqrt((K1 + K2) / MU)};
    set_mode(&modes[0], body, step_s);
    set_mode(&modes[1], axle, step_s);
}
