/* SPDX-License-Identifier: Apache-2.0
 *
 * The frequencies of pitch that are modelled: Butterworth filters forward and backward.
 */
#include <math.h>

#include "pitch.h"

#define SLOW_HZ 0.3
#define FAST_HZ 20.0
#define FAST_SHARE 0.4 /* of the bins, where these are slower than usual */

/* Each end is gone on with by as many bins, mirrored about it. */
enum { MIRRORED = 12 };

/* Third order: a section of first and one of second order, by the bilinear transform. `sign` of the
 * zeros is 1 at half the rate, for a low-pass, and -1 at 0. */
static void set_sections(pt_section *section, double cutoff_hz, double step_s, double sign)
{
    double c = tan(FR_PI * cutoff_hz * step_s), c2 = c * c;
    double first = (sign > 0.0 ? c : 1.0) / (1.0 + c);
    double second = (sign > 0.0 ? c2 : 1.0) / (1.0 + c + c2);
    pt_section one = {{first, sign * first, 0.0}, {1.0, (c - 1.0) / (1.0 + c), 0.0}};
    pt_section two = {{second, 2.0 * sign * second, second},
                      {1.0, 2.0 * (c2 - 1.0) / (1.0 + c + c2), (1.0 - c + c2) / (1.0 + c + c2)}};
    section[0] = one;
    section[1] = two;
}

void fr_pt_set_band(pt_band *band, double step_s)
{
    set_sections(band->slow, SLOW_HZ, step_s, -1.0);
    set_sections(band->fast, fmin(FAST_HZ, FAST_SHARE / step_s), step_s, 1.0);
    band->step_s = step_s;
}

/* A cascade that runs: two states of each section. */
typedef struct run_of_two {
    const pt_section *section;
    double state[2][2];
} run_of_two;

/* At rest under a constant input: what such a constant passes with is the gain at 0 Hz. */
static void rest_on(run_of_two *run, double x)
{
    double input = x;
    for (int32_t i = 0; i < 2; i++) {
        const pt_section *s = &run->section[i];
        double y = input * (s->b[0] + s->b[1] + s->b[2]) / (s->a[0] + s->a[1] + s->a[2]);
        run->state[i][1] = s->b[2] * input - s->a[2] * y;
        run->state[i][0] = s->b[1] * input - s->a[1] * y + run->state[i][1];
        input = y;
    }
}

static double step_two(run_of_two *run, double x)
{
    double y = x;
    for (int32_t i = 0; i < 2; i++) {
        const pt_section *s = &run->section[i];
        double *z = run->state[i], input = y;
        y = s->b[0] * input + z[0];
        z[0] = s->b[1] * input - s->a[1] * y + z[1];
        z[1] = s->b[2] * input - s->a[2] * y;
    }
    return y;
}

/* Forward and backward over at least MIRRORED + 1 values, each end gone on with beyond it. */
static void both_ways(const pt_section *section, double *x, int32_t count)
{
    run_of_two run = {section, {{0.0, 0.0}, {0.0, 0.0}}};
    double behind[MIRRORED], begin = x[0], end = x[count - 1];
    for (int32_t i = 0; i < MIRRORED; i++)
        behind[i] = 2.0 * end - x[count - 2 - i];
    rest_on(&run, 2.0 * begin - x[MIRRORED]);
    for (int32_t i = MIRRORED; i > 0; i--)
        (void)step_two(&run, 2.0 * begin - x[i]);
    for (int32_t i = 0; i < count; i++)
        x[i] = step_two(&run, x[i]);
    for (int32_t i = 0; i < MIRRORED; i++)
        behind[i] = step_two(&run, behind[i]);
    rest_on(&run, behind[MIRRORED - 1]);
    for (int32_t i = MIRRORED - 1; i >= 0; i--)
        (void)step_two(&run, behind[i]);
    for (int32_t i = count - 1; i >= 0; i--)
        x[i] = step_two(&run, x[i]);
}

void fr_pt_pass_band(const pt_band *band, double *x, int32_t count)
{
    both_ways(band->slow, x, count);
    both_ways(band->slow, x, count);
    both_ways(band->fast, x, count);
}

void fr_pt_height_of(const pt_band *band, double *x, int32_t count)
{
    double mean = 0.0;
    for (int32_t i = 0; i < count; i++)
        mean += x[i] / (double)count;
    for (int32_t i = 0; i < count; i++)
        x[i] -= mean;
    for (int32_t pass = 0; pass < 2; pass++) {
        double sum = 0.0;
        for (int32_t i = 0; i < count; i++) {
            sum += x[i];
            x[i] = sum * band->step_s;
        }
        both_ways(band->slow, x, count);
    }
    both_ways(band->fast, x, count);
}
