/* SPDX-License-Identifier: Apache-2.0
 *
 * The half car from reading to reading: its transition, and the gain to which its filter settles.
 */
#include <math.h>
#include <string.h>

#include "pitch.h"

#define DISTURBANCE_MPS2 0.3
#define DISTURBED_TWICE_RADPS (4.0 * FR_PI)
#define READING_MPS2 0.03
#define SERIES_TERMS 20
#define MOST_DOUBLINGS 40
#define SETTLED 1e-15

enum { SQUARE = PT_STATES * PT_STATES, WIDE = PT_STATES * PT_INPUTS };

/* c = a b, or a transposed times b: `a` of 10 by 10, `b` and `c` of 10 by `columns`. */
static void multiply_ten(const double *a, int transposed, const double *b, int32_t columns, double *c)
{
    for (int32_t i = 0; i < PT_STATES; i++)
        for (int32_t j = 0; j < columns; j++) {
            double sum = 0.0;
            for (int32_t k = 0; k < PT_STATES; k++)
                sum += a[transposed != 0 ? k * PT_STATES + i : i * PT_STATES + k] * b[k * columns + j];
            c[i * columns + j] = sum;
        }
}

/* The matrix transposed, in its place. */
static void flip(double *a)
{
    for (int32_t i = 0; i < PT_STATES; i++)
        for (int32_t j = 0; j < i; j++) {
            double held = a[i * PT_STATES + j];
            a[i * PT_STATES + j] = a[j * PT_STATES + i];
            a[j * PT_STATES + i] = held;
        }
}

static double largest_entry(const double *a, int32_t count)
{
    double most = 0.0;
    for (int32_t i = 0; i < count; i++)
        most = fmax(most, fabs(a[i]));
    return most;
}

/* Exchange row `k` with the one below it that has the largest pivot. */
static void exchange(double *a, int32_t size, double *b, int32_t columns, int32_t k)
{
    int32_t best = k;
    for (int32_t i = k + 1; i < size; i++)
        best = fabs(a[i * size + k]) > fabs(a[best * size + k]) ? i : best;
    for (int32_t j = 0; best != k && j < size; j++) {
        double held = a[k * size + j];
        a[k * size + j] = a[best * size + j];
        a[best * size + j] = held;
    }
    for (int32_t j = 0; best != k && j < columns; j++) {
        double held = b[k * columns + j];
        b[k * columns + j] = b[best * columns + j];
        b[best * columns + j] = held;
    }
}

void fr_pt_solve(double *a, int32_t size, double *b, int32_t columns)
{
    for (int32_t k = 0; k < size; k++) {
        exchange(a, size, b, columns, k);
        for (int32_t i = k + 1; i < size; i++) {
            double factor = a[i * size + k] / a[k * size + k];
            for (int32_t j = k; j < size; j++)
                a[i * size + j] -= factor * a[k * size + j];
            for (int32_t j = 0; j < columns; j++)
                b[i * columns + j] -= factor * b[k * columns + j];
        }
    }
    for (int32_t k = size - 1; k >= 0; k--)
        for (int32_t j = 0; j < columns; j++) {
            for (int32_t i = k + 1; i < size; i++)
                b[k * columns + j] -= a[k * size + i] * b[i * columns + j];
            b[k * columns + j] /= a[k * size + k];
        }
}

/* Over a time so short that the series converges: the exponential, and its first and second
 * integral times the inputs. They are in `transition`, `before` and `now`. */
static void start_series(pt_gains *gains, const pt_car *car, double time_s)
{
    double term[SQUARE], next[SQUARE], driven[WIDE];
    (void)memset(gains, 0, sizeof *gains);
    (void)memset(term, 0, sizeof term);
    for (int32_t i = 0; i < PT_STATES; i++)
        term[i * PT_STATES + i] = 1.0;
    for (int32_t k = 1; k <= SERIES_TERMS; k++) {
        double once = time_s / (double)k, twice = once * time_s / (double)(k + 1);
        multiply_ten(term, 0, car->inputs, PT_INPUTS, driven);
        for (int32_t i = 0; i < SQUARE; i++)
            gains->transition[i] += term[i];
        for (int32_t i = 0; i < WIDE; i++) {
            gains->before[i] += once * driven[i];
            gains->now[i] += twice * driven[i];
        }
        multiply_ten(term, 0, car->dynamics, PT_STATES, next);
        for (int32_t i = 0; i < SQUARE; i++)
            term[i] = next[i] * once;
    }
}

/* The same over twice the time. */
static void double_time(pt_gains *gains, double time_s)
{
    double next[SQUARE], first[WIDE], second[WIDE];
    multiply_ten(gains->transition, 0, gains->before, PT_INPUTS, first);
    multiply_ten(gains->transition, 0, gains->now, PT_INPUTS, second);
    multiply_ten(gains->transition, 0, gains->transition, PT_STATES, next);
    for (int32_t i = 0; i < WIDE; i++) {
        gains->now[i] += second[i] + time_s * gains->before[i];
        gains->before[i] += first[i];
    }
    (void)memcpy(gains->transition, next, sizeof next);
}

/* x(t + dt) = transition x + before u(t) + now u(t + dt), u linear in between. */
static void discretize(pt_gains *gains, const pt_car *car, double step_s)
{
    double most = largest_entry(car->dynamics, SQUARE) * (double)PT_STATES, time_s = step_s;
    int32_t halvings = 0;
    for (; most * time_s > 0.5; halvings++)
        time_s *= 0.5;
    start_series(gains, car, time_s);
    for (int32_t i = 0; i < halvings; i++) {
        double_time(gains, time_s);
        time_s *= 2.0;
    }
    for (int32_t i = 0; i < WIDE; i++) {
        gains->now[i] /= step_s;
        gains->before[i] -= gains->now[i];
    }
}

/* One doubling of the steps to which covariance `p` and information `g` belong. Returns how much the
 * covariance has changed, relative to itself. */
static double double_steps(double *f, double *g, double *p)
{
    double both[SQUARE], with_f[SQUARE], with_g[SQUARE], next[SQUARE], more[SQUARE];
    double change = 0.0;
    multiply_ten(g, 0, p, PT_STATES, both);
    for (int32_t i = 0; i < PT_STATES; i++)
        both[i * PT_STATES + i] += 1.0;
    (void)memcpy(next, both, sizeof next);
    (void)memcpy(with_f, f, sizeof with_f);
    (void)memcpy(with_g, g, sizeof with_g);
    fr_pt_solve(both, PT_STATES, with_f, PT_STATES);
    fr_pt_solve(next, PT_STATES, with_g, PT_STATES);
    /* p + f' p with_f */
    multiply_ten(p, 0, with_f, PT_STATES, both);
    multiply_ten(f, 1, both, PT_STATES, more);
    for (int32_t i = 0; i < SQUARE; i++) {
        p[i] += more[i];
        change = fmax(change, fabs(more[i]));
    }
    /* g + f with_g f' */
    multiply_ten(f, 0, with_g, PT_STATES, both);
    flip(both);
    multiply_ten(f, 0, both, PT_STATES, more);
    for (int32_t i = 0; i < SQUARE; i++)
        g[i] += more[i];
    multiply_ten(f, 0, with_f, PT_STATES, more);
    (void)memcpy(f, more, sizeof more);
    return change / largest_entry(p, SQUARE);
}

/* Both halves of a covariance alike. */
static void make_symmetric(double *p)
{
    for (int32_t i = 0; i < PT_STATES; i++)
        for (int32_t j = 0; j < i; j++) {
            double mean = 0.5 * (p[i * PT_STATES + j] + p[j * PT_STATES + i]);
            p[i * PT_STATES + j] = mean;
            p[j * PT_STATES + i] = mean;
        }
}

/* The covariance before a reading to which the filter settles: each doubling takes as many steps of
 * the Riccati equation as all before it. */
static void settle(const pt_gains *gains, double step_s, double *p)
{
    double f[SQUARE], g[SQUARE], change = 1.0;
    double driven = 1.0 - exp(-DISTURBED_TWICE_RADPS * step_s);
    (void)memcpy(f, gains->transition, sizeof f);
    flip(f);
    (void)memset(p, 0, SQUARE * sizeof *p);
    for (int32_t i = 2 * PT_BODY; i < PT_STATES; i++)
        p[i * PT_STATES + i] = DISTURBANCE_MPS2 * DISTURBANCE_MPS2 * driven;
    for (int32_t i = 0; i < SQUARE; i++)
        g[i] = gains->reading[i / PT_STATES] * gains->reading[i % PT_STATES] /
               (READING_MPS2 * READING_MPS2);
    for (int32_t k = 0; change > SETTLED && k < MOST_DOUBLINGS; k++) {
        change = double_steps(f, g, p);
        make_symmetric(p);
    }
}

/* Heave, pitch and wheels at rest under constant inputs: their forces are in balance. */
static void set_rest(pt_gains *gains, const pt_car *car)
{
    double stiffness[PT_BODY * PT_BODY];
    for (int32_t i = 0; i < PT_BODY; i++) {
        for (int32_t j = 0; j < PT_BODY; j++)
            stiffness[i * PT_BODY + j] = -car->dynamics[(PT_BODY + i) * PT_STATES + j];
        for (int32_t j = 0; j < PT_INPUTS; j++)
            gains->rest[i * PT_INPUTS + j] = car->inputs[(PT_BODY + i) * PT_INPUTS + j];
    }
    fr_pt_solve(stiffness, PT_BODY, gains->rest, PT_INPUTS);
}

void fr_pt_set_gains(pt_gains *gains, const pt_car *car, double step_s)
{
    double p[SQUARE];
    discretize(gains, car, step_s);
    set_rest(gains, car);
    (void)memcpy(gains->reading, car->reading, sizeof gains->reading);
    (void)memcpy(gains->direct, car->direct, sizeof gains->direct);
    settle(gains, step_s, p);
    multiply_ten(p, 0, gains->reading, 1, gains->filter);
    gains->expected = READING_MPS2 * READING_MPS2;
    for (int32_t i = 0; i < PT_STATES; i++)
        gains->expected += gains->reading[i] * gains->filter[i];
    for (int32_t i = 0; i < PT_STATES; i++) {
        gains->filter[i] /= gains->expected;
        gains->spread[i] = p[PT_STATES + i];
    }
}
