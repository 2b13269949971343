/* SPDX-License-Identifier: Apache-2.0
 *
 * Sections at a fixed cut-off in trapezoidal state-variable form, (A.1) to (A.19).
 *
 * The states are the integrators of the analog prototype, so nothing cancels at a cut-off a million
 * times below the sampling rate. With c = tan(pi f_c dt) (A.11):
 *
 *     S1:  hp = (x - s) / (1 + c),  lp = x - hp,  s += 2 c hp
 *     S2:  hp = (x - s2 - (1 + c) s1) / (1 + c + c^2),  bp = s1 + c hp,  lp = s2 + c bp,
 *          s1 += 2 c hp,  s2 += 2 c bp
 */
#include <math.h>

#include "filter.h"

#define FILTER_MAGIC FR_MAGIC(1)

enum { HIGH_1 = 2, LOW_1 = 3, HIGH_2 = 4, LOW_2 = 5 };

/* Ratio of (A.20): cut-off of each third-order pass over the -3 dB frequency of both. */
static double sixth_order(void)
{
    return pow(sqrt(2.0) - 1.0, 1.0 / 6.0);
}

double fr_high_pass_setting(double frequency)
{
    return sixth_order() * frequency;
}

double fr_low_pass_setting(double frequency)
{
    return frequency / sixth_order();
}

double fr_high_pass_wavelength_setting(double wavelength)
{
    return wavelength / sixth_order();
}

fr_filter_config fr_filter_defaults(void)
{
    fr_filter_config config = {0.0, 0.0, 1, FR_HIGH_PASS, FR_FORWARD, FR_MISSING_REFUSED};
    return config;
}

static int filter_is_possible(const fr_filter_config *config)
{
    double cycles = config->cutoff * config->step;
    return fr_above_zero(config->step) && fr_above_zero(config->cutoff) && cycles > 0.0 &&
           cycles < 0.5 && fr_one_of(config->order, 1, 2) &&
           fr_one_of(config->passes, FR_HIGH_PASS, FR_LOW_PASS) &&
           fr_one_of(config->direction, FR_FORWARD, FR_BACKWARD) &&
           fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED);
}

size_t fr_filter_size(const fr_filter_config *config)
{
    return config != NULL && filter_is_possible(config) ? sizeof(fr_filter) : 0u;
}

static void set_first_order(fr_filter *filter, double c)
{
    double gain = filter->kind == HIGH_1 ? 1.0 / (1.0 + c) : c / (1.0 + c);
    filter->gain = FR_R(gain);
    filter->k1 = FR_R(filter->kind == HIGH_1 ? 2.0 * c * gain : 2.0 * gain);
}

static void set_second_order(fr_filter *filter, double c)
{
    double d = 1.0 / (1.0 + c + c * c), p = 1.0 + c, k1 = 2.0 * c * d;
    filter->gain = FR_R(filter->kind == HIGH_2 ? d : c * d);
    filter->p = FR_R(p);
    filter->k1 = FR_R(k1);
    filter->k2 = FR_R(k1 * p);
    filter->k3 = FR_R(k1 * c);
    filter->first = FR_R((1.0 + c - 3.0 * c * c) * d);
    filter->band = FR_R(2.0 * c - 1.0);
    filter->low = FR_R(c * c - 2.0 * c);
}

void fr_filter_set(fr_filter *filter, const fr_filter_config *config)
{
    double c = tan(FR_PI * config->cutoff * config->step);
    filter->kind = 2 * config->order + (config->passes == FR_LOW_PASS ? 1 : 0);
    filter->backward = config->direction == FR_BACKWARD ? 1 : 0;
    filter->missing = config->missing;
    filter->c = FR_R(c);
    if (config->order == 1)
        set_first_order(filter, c);
    else
        set_second_order(filter, c);
}

fr_status fr_filter_init(void *memory, size_t size, const fr_filter_config *config, fr_filter **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_filter_size(config),
                                FILTER_MAGIC);
    if (status != FR_OK)
        return status;
    *out = (fr_filter *)memory;
    fr_filter_set(*out, config);
    return FR_OK;
}

/* States at the first sample, (A.12) to (A.19). The second sample of (A.15) sees (x1, y1) twice:
 * the states of a second-order high-pass are that past, and it gives its first output here. */
static fr_real start_filter(fr_filter *filter, fr_real x)
{
    fr_real y = filter->first * x;
    filter->started = 1;
    filter->held = x;
    filter->s1 = filter->kind == HIGH_1 ? filter->c * x : (filter->kind == LOW_1 ? x : 0);
    filter->s2 = x;
    if (filter->kind == HIGH_2) {
        filter->s1 = filter->band * y;
        filter->s2 = x + filter->low * y;
    }
    return y;
}

/* Write what comes before the first sample that is not missing, and its output if that is given by
 * the start; return how many samples are done. */
static size_t begin_filter(fr_filter *filter, const fr_real *x, size_t count, fr_real *y)
{
    size_t k = 0;
    while (k < count && fr_missing(x[fr_index(k, count, filter->backward)])) {
        y[fr_index(k, count, filter->backward)] = 0;
        k++;
    }
    if (k < count) {
        size_t i = fr_index(k, count, filter->backward);
        fr_real first = start_filter(filter, x[i]);
        if (filter->kind == HIGH_2) {
            y[i] = first;
            k++;
        }
    }
    return k;
}

/* A state less a small part of itself and with a small input. The newest input enters last, since
 * the loop waits for nothing else, as in the SDK; in single precision the state is rounded once. */
static inline fr_real advance(fr_real state, fr_real part, fr_real input)
{
#ifdef FR_FLOAT
    return state + (input - part);
#else
    return (state - part) + input;
#endif
}

/* Samples from x[0] on, `stride` apart. The last two arguments are constants where it is called, so
 * each loop is one of its own; where no sample is missing it has no comparison, which takes longer
 * than the recursion waits for itself. */
static inline void first_order(fr_filter *filter, const fr_real *x, ptrdiff_t stride, size_t count,
                               fr_real *y, int high, int missing)
{
    fr_real s = filter->s1, held = filter->held, gain = filter->gain, k1 = filter->k1;
    ptrdiff_t i = 0;
    for (size_t k = 0; k < count; k++) {
        fr_real value = missing ? fr_bridged(x[i], held) : x[i];
        held = value;
        y[i] = high ? (value - s) * gain : s + gain * (value - s);
        s = advance(s, k1 * s, k1 * value);
        i += stride;
    }
    filter->s1 = s;
    filter->held = held;
}

static inline void second_order(fr_filter *filter, const fr_real *x, ptrdiff_t stride, size_t count,
                                fr_real *y, int high, int missing)
{
    fr_real s1 = filter->s1, s2 = filter->s2, held = filter->held, gain = filter->gain;
    fr_real p = filter->p, c = filter->c, k1 = filter->k1, k2 = filter->k2, k3 = filter->k3;
    ptrdiff_t i = 0;
    for (size_t k = 0; k < count; k++) {
        fr_real value = missing ? fr_bridged(x[i], held) : x[i], band = s1, low = s2;
        fr_real of_band = k1 * band, of_low = k1 * low;
        s1 = advance(band, k2 * band, k1 * value - of_low);
        s2 = advance(low, k3 * low, of_band + k3 * value);
        y[i] = high ? ((value - low) - p * band) * gain : low + gain * (band + c * (value - low));
        held = value;
        i += stride;
    }
    filter->s1 = s1;
    filter->s2 = s2;
    filter->held = held;
}

/* Samples behind the start of which some may be missing: a loop for each order. */
static void run_bridging(fr_filter *filter, const fr_real *x, ptrdiff_t stride, size_t count,
                         fr_real *y)
{
    if (filter->kind == HIGH_1 || filter->kind == LOW_1)
        first_order(filter, x, stride, count, y, filter->kind == HIGH_1, 1);
    else
        second_order(filter, x, stride, count, y, filter->kind == HIGH_2, 1);
}

/* The same of samples that are all there: a loop for each kind. */
static void run_whole(fr_filter *filter, const fr_real *x, ptrdiff_t stride, size_t count,
                      fr_real *y)
{
    if (filter->kind == HIGH_1)
        first_order(filter, x, stride, count, y, 1, 0);
    else if (filter->kind == LOW_1)
        first_order(filter, x, stride, count, y, 0, 0);
    else if (filter->kind == HIGH_2)
        second_order(filter, x, stride, count, y, 1, 0);
    else
        second_order(filter, x, stride, count, y, 0, 0);
}

void fr_filter_run(fr_filter *filter, const fr_real *x, size_t count, fr_real *y)
{
    size_t done = filter->started == 0 ? begin_filter(filter, x, count, y) : 0u;
    ptrdiff_t stride = filter->backward != 0 ? -1 : 1;
    if (done == count)
        return;
    size_t first = fr_index(done, count, filter->backward);
    if (filter->missing == FR_MISSING_BRIDGED)
        run_bridging(filter, x + first, stride, count - done, y + first);
    else
        run_whole(filter, x + first, stride, count - done, y + first);
}

fr_status fr_filter_push(fr_filter *filter, const fr_real *x, size_t count, fr_real *y,
                         size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(filter, FILTER_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, y, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(x, count, filter->missing);
    if (status != FR_OK)
        return status;
    fr_filter_run(filter, x, count, y);
    *written = count;
    return FR_OK;
}
