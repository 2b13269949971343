/* SPDX-License-Identifier: Apache-2.0
 *
 * The delivered elevation is filtered by HPF_B3x2 over distance; of the error e of the smoothed
 * height that leaves e - L e, L the complementary low-pass. With E[e_i e_j] = (P_i e_r)' Psi_ji'
 * (I - Lambda_j P_j) e_r, i before j, its variance is one sum along the marks: m goes on by Psi, takes
 * w P e_r at each mark, and what it was before meets w (I - Lambda P) e_r there.
 *
 * Behind the last mark m is the covariance of that error with the state there, P_T. Were that
 * state known, the error would change by m' P_T^-1 m, and no reading to come can tell more.
 */
#include <math.h>
#include <string.h>

#include "lag_sigma.h"
#include "samples.h"

/* Cut-off wavelengths to either side beyond which the low-pass is nothing. */
#define REACH_OF_LOW_PASS 1.5
/* Directions of so small a variance, relative, are known as they are. */
#define KNOWN_ALREADY 1e-10

void fr_lag_settle(const fr_lag_view *view)
{
    int32_t states = view->model->states, square = states * states;
    double information[FR_LAG_STATES * FR_LAG_STATES] = {0};
    for (int64_t k = view->lag->marks - 1; k >= view->lag->first_mark; k--) {
        fr_lag_mark *mark = fr_lag_mark_at(view, k);
        const double *column = fr_lag_column(mark), *gathered = fr_lag_gathered(view, mark);
        double *left = fr_lag_left(view, mark);
        (void)memcpy(left, column, (size_t)states * sizeof *left);
        fr_lag_apply(information, states, left);
        for (int32_t i = 0; i < states; i++)
            left[i] = (i == 0 ? 1.0 : 0.0) - left[i];
        fr_lag_enclose(fr_lag_passed(view, mark), states, information);
        for (int32_t i = 0; i < square; i++)
            information[i] += gathered[i];
    }
}

/* The window of the low-pass about a mark. */
typedef struct window {
    double place_m, reach_m, cutoff, total;
    int64_t low, high; /* marks from low to high - 1 */
} window;

static double distance_of(const fr_lag_view *view, int64_t k)
{
    return fr_lag_mark_at(view, k)->distance_m;
}

/* Impulse response of L, times the distance that the mark is for. */
static double low_pass(const fr_lag_view *view, const window *about, int64_t k)
{
    const fr_lag *lag = view->lag;
    double root = sqrt(0.75);
    int64_t after = k + 1 < lag->marks ? k + 1 : k, before = k > lag->first_mark ? k - 1 : k;
    double width_m = distance_of(view, after) - distance_of(view, before);
    double a = about->cutoff * fabs(distance_of(view, k) - about->place_m), b = root * a;
    return width_m * (exp(-a) + exp(-0.5 * a) * (cos(b) + 2.0 * root * sin(b)));
}

static window window_about(const fr_lag_view *view, int64_t wanted)
{
    const fr_lag *lag = view->lag;
    window about = {0.0, 0.0, 0.0, 0.0, wanted, wanted};
    about.place_m = distance_of(view, wanted);
    about.reach_m = REACH_OF_LOW_PASS * lag->shape.wavelength_m;
    about.cutoff = 2.0 * FR_PI / lag->shape.wavelength_m;
    while (about.low > lag->first_mark &&
           about.place_m - distance_of(view, about.low - 1) <= about.reach_m)
        about.low--;
    while (about.high < lag->marks &&
           distance_of(view, about.high) - about.place_m <= about.reach_m)
        about.high++;
    for (int64_t k = about.low; k < about.high; k++)
        about.total += low_pass(view, &about, k);
    return about;
}

/* What HPF_B3x2 takes of mark k for the one wanted. */
static double weight_of(const fr_lag_view *view, const window *about, int64_t k, int64_t wanted)
{
    double own = k == wanted ? 1.0 : 0.0;
    if (k >= about->high)
        return 0.0;
    if (!(about->total > 0.0))
        return own - 1.0 / (double)(about->high - about->low);
    return own - low_pass(view, about, k) / about->total;
}

/* Go along the marks to the last; return the variance, and m behind it. */
static double variance_along(const fr_lag_view *view, int64_t wanted, int64_t last, double *m)
{
    int32_t states = view->model->states;
    window about = window_about(view, wanted);
    double variance = 0.0;
    (void)memset(m, 0, (size_t)states * sizeof *m);
    for (int64_t k = about.low; k < (about.high > last ? about.high : last); k++) {
        fr_lag_mark *mark = fr_lag_mark_at(view, k);
        const double *column = fr_lag_column(mark), *left = fr_lag_left(view, mark);
        double weight = weight_of(view, &about, k, wanted);
        if (k > about.low)
            fr_lag_apply(fr_lag_passed(view, mark), states, m);
        for (int32_t i = 0; i < states; i++) {
            variance += weight * left[i] * (2.0 * m[i] + weight * column[i]);
            m[i] += weight * column[i];
        }
    }
    return variance;
}

/* Rows of what can be seen, or 0 for the state itself. */
static int32_t rows_seen(const fr_lag_view *view)
{
    int64_t last = view->lag->marks - 1;
    int moving = last <= view->lag->first_mark ||
                 distance_of(view, last) > distance_of(view, last - 1);
    return view->model->seen == NULL ? 0 : view->model->seen_rows - moving;
}

/* z <- seen m, and spread <- seen P seen'; both as they are without `seen`. Return their size. */
static int32_t see_last(const fr_lag_view *view, const double *m, double *z, double *spread)
{
    int32_t states = view->model->states, rows = rows_seen(view);
    const double *seen = view->model->seen;
    double half[FR_LAG_STATES];
    if (rows == 0) {
        (void)memcpy(z, m, (size_t)states * sizeof *z);
        (void)memcpy(spread, view->lag->covariance, (size_t)(states * states) * sizeof *spread);
        return states;
    }
    for (int32_t i = 0; i < rows; i++) {
        fr_lag_turn(view->lag->covariance, &seen[(size_t)i * (size_t)states], states, half);
        z[i] = 0.0;
        for (int32_t k = 0; k < states; k++)
            z[i] += seen[i * states + k] * m[k];
        for (int32_t j = 0; j < rows; j++) {
            spread[i * rows + j] = 0.0;
            for (int32_t k = 0; k < states; k++)
                spread[i * rows + j] += half[k] * seen[j * states + k];
        }
    }
    return rows;
}

/* Scale to a diagonal of one. */
static void scale(double *z, double *spread, int32_t size)
{
    double deviation[FR_LAG_STATES];
    for (int32_t i = 0; i < size; i++)
        deviation[i] = sqrt(spread[i * size + i] > 0.0 ? spread[i * size + i] : 1.0);
    for (int32_t i = 0; i < size; i++) {
        z[i] /= deviation[i];
        for (int32_t j = 0; j < size; j++)
            spread[i * size + j] /= deviation[i] * deviation[j];
    }
}

/* z' spread^-1 z by elimination, without the directions that are known already. */
static double explained(double *z, double *spread, int32_t size)
{
    double sum = 0.0;
    for (int32_t k = 0; k < size; k++) {
        double pivot = spread[k * size + k];
        if (pivot <= KNOWN_ALREADY)
            continue;
        sum += z[k] * z[k] / pivot;
        for (int32_t i = k + 1; i < size; i++) {
            double factor = spread[i * size + k] / pivot;
            z[i] -= factor * z[k];
            for (int32_t j = k + 1; j < size; j++)
                spread[i * size + j] -= factor * spread[k * size + j];
        }
    }
    return sum;
}

static double sigma_of(const fr_lag_view *view, double variance)
{
    double noise_m = view->lag->shape.noise_m;
    return sqrt((variance > 0.0 ? variance : 0.0) + noise_m * noise_m);
}

static void look_ahead(const fr_lag_view *view, int64_t number)
{
    fr_lag_mark *mark = fr_lag_mark_at(view, number);
    double m[FR_LAG_STATES], z[FR_LAG_STATES], spread[FR_LAG_STATES * FR_LAG_STATES];
    int32_t size;
    mark->sigma = sigma_of(view, variance_along(view, number, view->lag->marks, m));
    size = see_last(view, m, z, spread);
    scale(z, spread, size);
    mark->change = sqrt(explained(z, spread, size));
}

/* The largest change of marks before `end` within half a wavelength. */
static double doubt_about(const fr_lag_view *view, int64_t number, int64_t end)
{
    double within_m = 0.5 * view->lag->shape.wavelength_m, place_m = distance_of(view, number);
    double most = 0.0;
    int64_t k = number;
    while (k > view->lag->first_mark && place_m - distance_of(view, k - 1) <= within_m)
        k--;
    while (k < end && distance_of(view, k) - place_m <= within_m) {
        most = fmax(most, fr_lag_mark_at(view, k)->change);
        k++;
    }
    return most;
}

void fr_lag_sigmas(const fr_lag_view *view, int64_t begin, int64_t end, int ended)
{
    int64_t before = begin > view->lag->first_mark ? begin - 1 : begin;
    double m[FR_LAG_STATES];
    if (before < begin)
        fr_lag_mark_at(view, before)->sigma = sigma_of(view, variance_along(view, before, 0, m));
    for (int64_t k = begin; k < end; k++) {
        if (ended != 0)
            fr_lag_mark_at(view, k)->sigma = sigma_of(view, variance_along(view, k, 0, m));
        else
            look_ahead(view, k);
    }
    for (int64_t k = before; k < end; k++)
        fr_lag_mark_at(view, k)->doubt = doubt_about(view, k, end);
}
