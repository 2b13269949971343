/* SPDX-License-Identifier: Apache-2.0
 *
 * Agreement of two filtered profiles over a range of offsets, (2.12) to (2.16). Sums are double in
 * both precisions: over 10 km a sum in float has lost the shape that it is to measure.
 */
#include <math.h>

#include "samples.h"

/* A grid of 5.08 mm has to reach 1.016 m as its 200th lag, whatever the rounding. */
#define LAG_SLACK 1e-9
/* A deviation below this share of the largest sample is its rounding. */
#define ROUNDING 1e-13

/* Moments of the two signals over their overlap at one lag. */
typedef struct overlap {
    double p, q;          /* standard deviations */
    double rho, gamma;    /* (2.14), (2.15) */
} overlap;

fr_cross_correlation_config fr_cross_correlation_defaults(void)
{
    fr_cross_correlation_config config = {0.0, 1.0};
    return config;
}

static double largest_of(const fr_real *x, size_t count)
{
    double largest = 0.0;
    for (size_t k = 0; k < count; k++)
        largest = fmax(largest, fabs((double)x[k]));
    return largest;
}

static double mean_of(const fr_real *x, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; k++)
        sum += (double)x[k];
    return sum / (double)count;
}

static double deviation_of(double square, double largest)
{
    return square > ROUNDING * largest * ROUNDING * largest ? sqrt(square) : 0.0;
}

/* Both factors over `count` samples that lie on each other. */
static overlap factors_of(const fr_real *p, const fr_real *q, size_t count, double largest_p,
                          double largest_q)
{
    double mean_p = mean_of(p, count), mean_q = mean_of(q, count);
    double pp = 0.0, qq = 0.0, pq = 0.0, n = (double)count;
    overlap found = {0.0, 0.0, 0.0, 1.0};
    for (size_t k = 0; k < count; k++) {
        double a = (double)p[k] - mean_p, b = (double)q[k] - mean_q;
        pp += a * a;
        qq += b * b;
        pq += a * b;
    }
    found.p = deviation_of(pp / n, largest_p);
    found.q = deviation_of(qq / n, largest_q);
    if (found.p > 0.0 && found.q > 0.0)
        found.rho = fmin(1.0, fmax(-1.0, pq / n / (found.p * found.q)));
    if (fmax(found.p, found.q) > 0.0)
        found.gamma = fmin(found.p, found.q) / fmax(found.p, found.q);
    return found;
}

/* The n-th lag from zero outwards: 0, -1, 1, -2 and so on, so that the nearest of equals is found
 * first. */
static int64_t lag_of(size_t n)
{
    int64_t far = (int64_t)((n + 1u) / 2u);
    return n % 2u == 1u ? -far : far;
}

static void find_best(const fr_real *p, const fr_real *q, size_t count, size_t most,
                      double interval_m, fr_agreement *best)
{
    double largest_p = largest_of(p, count), largest_q = largest_of(q, count);
    best->correlation = -2.0;
    for (size_t n = 0; n <= 2u * most; n++) {
        int64_t lag = lag_of(n);
        size_t far = (n + 1u) / 2u, before = lag < 0 ? far : 0u, behind = lag > 0 ? far : 0u;
        overlap found = factors_of(p + before, q + behind, count - far, largest_p, largest_q);
        if (found.rho > best->correlation) {
            best->correlation = found.rho;
            best->amplitude_factor = found.gamma;
            best->offset_m = (double)lag * interval_m;
        }
    }
    best->cross_correlation = best->correlation * best->amplitude_factor;
}

fr_status fr_cross_correlation(const fr_cross_correlation_config *config, const fr_real *p,
                               const fr_real *q, size_t count, fr_agreement *agreement)
{
    fr_status status = config == NULL || agreement == NULL ? FR_NULL_POINTER : FR_OK;
    if (status == FR_OK && !(fr_above_zero(config->interval_m) && config->max_offset_m >= 0.0))
        status = FR_BAD_CONFIG;
    if (status == FR_OK)
        status = fr_check_samples(p, count, FR_MISSING_REFUSED);
    if (status == FR_OK)
        status = fr_check_samples(q, count, FR_MISSING_REFUSED);
    if (status != FR_OK)
        return status;
    double lags = floor(config->max_offset_m / config->interval_m + LAG_SLACK);
    if (count < 2u || !(4.0 * lags <= (double)count))
        return FR_BAD_CONFIG;
    find_best(p, q, count, (size_t)lags, config->interval_m, agreement);
    return FR_OK;
}
