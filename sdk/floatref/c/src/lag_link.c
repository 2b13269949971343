/* SPDX-License-Identifier: Apache-2.0
 *
 * Links between marks, and marks that go.
 */
#include <string.h>

#include "lag_link.h"

/* Cut-off wavelengths behind which the filter of the 1-sigma takes nothing. */
#define WITHIN 1.5

void fr_lag_link_clear(fr_lag_link *link, int32_t states)
{
    (void)memset(link, 0, sizeof *link);
    for (int32_t i = 0; i < states; i++)
        link->psi[i * states + i] = 1.0;
}

void fr_lag_link_update(fr_lag_link *link, int32_t states, const double *gain, const double *row,
                        double innovation, double information)
{
    double seen[FR_LAG_STATES];
    fr_lag_turn(link->psi, row, states, seen);
    for (int32_t i = 0; i < states; i++) {
        double scaled = seen[i] * information;
        link->pushed[i] -= seen[i] * innovation;
        for (int32_t c = 0; c < states; c++) {
            link->gathered[i * states + c] += scaled * seen[c];
            link->psi[i * states + c] -= gain[i] * seen[c];
        }
    }
}

void fr_lag_link_mark(const fr_lag_view *view, const double *column)
{
    fr_lag *lag = view->lag;
    fr_lag_mark *mark = fr_lag_mark_at(view, lag->marks);
    size_t states = (size_t)view->model->states, square = states * states;
    mark->time_s = lag->time_s;
    mark->distance_m = lag->distance_m;
    mark->sigma = 0.0;
    mark->change = 0.0;
    mark->doubt = 0.0;
    (void)memcpy(fr_lag_column(mark), column, states * sizeof *column);
    (void)memcpy(fr_lag_pushed(view, mark), lag->link.pushed, states * sizeof *column);
    (void)memcpy(fr_lag_passed(view, mark), lag->link.psi, square * sizeof *column);
    (void)memcpy(fr_lag_gathered(view, mark), lag->link.gathered, square * sizeof *column);
    lag->marks++;
    lag->linked = 0;
    fr_lag_link_clear(&lag->link, view->model->states);
}

void fr_lag_turn(const double *a, const double *vector, int32_t states, double *found)
{
    for (int32_t c = 0; c < states; c++) {
        double total = 0.0;
        for (int32_t i = 0; i < states; i++)
            total += vector[i] * a[i * states + c];
        found[c] = total;
    }
}

void fr_lag_apply(const double *a, int32_t states, double *vector)
{
    double found[FR_LAG_STATES] = {0};
    for (int32_t i = 0; i < states; i++)
        for (int32_t c = 0; c < states; c++)
            found[i] += a[i * states + c] * vector[c];
    (void)memcpy(vector, found, (size_t)states * sizeof *vector);
}

/* product <- a' b. */
static void multiply_turned(const double *a, const double *b, int32_t states, double *product)
{
    for (int32_t i = 0; i < states; i++) {
        for (int32_t c = 0; c < states; c++) {
            double total = 0.0;
            for (int32_t k = 0; k < states; k++)
                total += a[k * states + i] * b[k * states + c];
            product[i * states + c] = total;
        }
    }
}

void fr_lag_enclose(const double *a, int32_t states, double *found)
{
    /* (found a)' first, since found is symmetric; then that turned, times a. */
    double half[FR_LAG_STATES * FR_LAG_STATES];
    multiply_turned(found, a, states, half);
    multiply_turned(half, a, states, found);
    /* Rounding that is not symmetric would grow from mark to mark. */
    for (int32_t i = 0; i < states; i++) {
        for (int32_t c = 0; c < i; c++) {
            double mean = 0.5 * (found[i * states + c] + found[c * states + i]);
            found[i * states + c] = mean;
            found[c * states + i] = mean;
        }
    }
}

/* Let the later of two marks, one behind the other, carry what the earlier has linked. */
static void join_marks(const fr_lag_view *view, fr_lag_mark *early, fr_lag_mark *late)
{
    int32_t states = view->model->states, square = states * states;
    double product[FR_LAG_STATES * FR_LAG_STATES] = {0}, *passed = fr_lag_passed(view, late);
    const double *first = fr_lag_passed(view, early);
    double *gathered = fr_lag_gathered(view, late);
    const double *earlier = fr_lag_gathered(view, early);
    late->change = late->change > early->change ? late->change : early->change;
    fr_lag_enclose(first, states, gathered);
    for (int32_t i = 0; i < square; i++)
        gathered[i] += earlier[i];
    for (int32_t i = 0; i < states; i++)
        fr_lag_turn(first, &passed[(size_t)i * (size_t)states], states,
                    &product[(size_t)i * (size_t)states]);
    (void)memcpy(passed, product, (size_t)square * sizeof *passed);
}

/* Halve the marks before `begin`, the last of which stays; they move up to it. */
static void halve(const fr_lag_view *view, int64_t begin)
{
    fr_lag *lag = view->lag;
    size_t size = lag->sizes.mark * sizeof(double);
    int64_t kept = begin;
    for (int64_t k = begin - 1; k >= lag->first_mark; k -= 2) {
        fr_lag_mark *mark = fr_lag_mark_at(view, k);
        if (k > lag->first_mark)
            join_marks(view, fr_lag_mark_at(view, k - 1), mark);
        kept--;
        if (kept != k)
            (void)memcpy(fr_lag_mark_at(view, kept), mark, size);
    }
    lag->first_mark = kept;
}

void fr_lag_link_forget(const fr_lag_view *view, int64_t begin)
{
    fr_lag *lag = view->lag;
    double reach_m = WITHIN * lag->shape.wavelength_m;
    double place_m = fr_lag_mark_at(view, begin - 1)->distance_m;
    while (lag->first_mark < begin - 1 &&
           fr_lag_mark_at(view, lag->first_mark)->distance_m < place_m - reach_m)
        lag->first_mark++;
    while (begin - lag->first_mark > FR_LAG_HISTORY)
        halve(view, begin);
}
