/* SPDX-License-Identifier: Apache-2.0
 *
 * Factors of the normal matrix J'J = L D L', by fronts: dense matrices that move along it.
 *
 * Those unknowns that are together in rows now make up the front, a lower triangle. Groups of eight
 * are eliminated at once: their part of all slots, the panel, is taken out of the front, and what
 * they leave to the others is subtracted from it. The panel is L by slots, each column times its D.
 */
#include <math.h>

#include "level_work.h"

#define CORRECTIONS 2

/* Add the products of the values of each row that comes with the group. */
static void add_squares(lv_work *w, int32_t group)
{
    for (int32_t r = w->bounds[group]; r < w->bounds[group + 1]; r++) {
        int32_t begin = w->start[w->by_group[r]], end = w->start[w->by_group[r] + 1];
        for (int32_t a = begin; a < end; a++) {
            double *row = w->front + lv_at(w->slot[w->column[a]], w->width);
            for (int32_t b = begin; b <= a; b++)
                row[w->slot[w->column[b]]] += w->value[a] * w->value[b];
        }
    }
}

/* Move the row of the pivot from the front to the panel. */
static void take_pivot(lv_work *w, int32_t pivot, double *panel)
{
    size_t width = (size_t)w->width, q = (size_t)pivot;
    for (size_t i = 0; i <= q; i++) {
        panel[i] = w->front[q * width + i];
        w->front[q * width + i] = 0.0;
    }
    for (size_t i = q + 1u; i < width; i++) {
        panel[i] = w->front[i * width + q];
        w->front[i * width + q] = 0.0;
    }
}

static void take_panel(lv_work *w, const int32_t *pivots, double *panel)
{
    for (int32_t p = 0; p < LV_PIVOTS; p++) {
        double *row = panel + lv_at(p, w->width);
        if (pivots[p] >= 0)
            take_pivot(w, pivots[p], row);
        for (int32_t i = 0; pivots[p] < 0 && i < w->width; i++)
            row[i] = 0.0;
    }
}

/* Take what the scaled pivot leaves from a later one of its group. */
static void take_share(double *later, const double *scaled, double share, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        later[i] -= share * scaled[i];
}

/* Eliminate the pivots of a group from each other; 0 unless all are finite and above 0. */
static int eliminate(lv_work *w, const int32_t *pivots, double *panel, double *diagonal)
{
    int32_t n = w->width;
    for (int32_t p = 0; p < LV_PIVOTS; p++) {
        int32_t q = pivots[p] >= 0 ? pivots[p] : 0;
        double *row = panel + lv_at(p, n), *scaled = w->scaled + lv_at(p, n);
        diagonal[p] = pivots[p] >= 0 ? row[q] : 1.0;
        if (!(diagonal[p] > 0.0 && diagonal[p] < LV_INFINITE))
            return 0;
        row[q] = 0.0;
        for (int32_t i = 0; i < n; i++)
            scaled[i] = row[i] * (1.0 / sqrt(diagonal[p]));
        for (int32_t later = p + 1; later < LV_PIVOTS; later++) {
            double share = pivots[later] >= 0 ? scaled[pivots[later]] : 0.0;
            take_share(panel + lv_at(later, n), scaled, share, n);
            panel[later * n + q] = 0.0;
        }
    }
    return 1;
}

/* The pivots are no part of what they leave to the others. */
static void clear_pivots(lv_work *w, const int32_t *pivots)
{
    for (int32_t later = 0; later < LV_PIVOTS; later++)
        for (int32_t p = 0; p < LV_PIVOTS; p++)
            w->scaled[p * w->width + (pivots[later] >= 0 ? pivots[later] : 0)] = 0.0;
}

/* Take all rows of `s`, each times its share, from a row of `count`: one sum for each place. */
void fr_lv_take_products(double *out, const double *s, int32_t stride,
                         const double *shares, int32_t count)
{
    double c0 = shares[0], c1 = shares[1], c2 = shares[2], c3 = shares[3];
    double c4 = shares[4], c5 = shares[5], c6 = shares[6], c7 = shares[7];
    const double *s4 = s + lv_at(4, stride);
    for (int32_t i = 0; i < count; i++) {
        double first = c0 * s[i] + c1 * s[i + stride] + c2 * s[i + 2 * stride] +
                       c3 * s[i + 3 * stride];
        out[i] -= first + (c4 * s4[i] + c5 * s4[i + stride] + c6 * s4[i + 2 * stride] +
                           c7 * s4[i + 3 * stride]);
    }
}

static void subtract(lv_work *w)
{
    for (int32_t a = 0; a < w->width; a++) {
        double shares[LV_PIVOTS];
        int any = 0;
        for (int32_t p = 0; p < LV_PIVOTS; p++) {
            shares[p] = w->scaled[p * w->width + a];
            any |= shares[p] != 0.0;
        }
        if (any != 0)
            fr_lv_take_products(w->front + lv_at(a, w->width), w->scaled, w->width, shares,
                                a + 1);
    }
}

int fr_lv_eliminate_group(lv_work *w, int32_t group, double *panel, double *diagonal)
{
    const int32_t *pivots = w->pivots + lv_at(group, LV_PIVOTS);
    add_squares(w, group);
    take_panel(w, pivots, panel);
    if (!eliminate(w, pivots, panel, diagonal))
        return 0;
    clear_pivots(w, pivots);
    subtract(w);
    return 1;
}

static void clear(double *x, size_t count)
{
    for (size_t i = 0; i < count; i++)
        x[i] = 0.0;
}

/* The factors, in `panel` and `diagonal`; 0 if rounding leaves no positive matrix. */
int fr_lv_factor(lv_work *w)
{
    size_t panel = (size_t)w->width * LV_PIVOTS;
    clear(w->front, (size_t)w->width * (size_t)w->width);
    for (int32_t g = 0; g < w->groups; g++)
        if (!fr_lv_eliminate_group(w, g, w->panel + (size_t)g * panel,
                                   w->diagonal + lv_at(g, LV_PIVOTS)))
            return 0;
    return 1;
}

static void solve_forward(lv_work *w, double *x)
{
    clear(w->scaled, (size_t)w->width);
    for (int32_t k = 0; k < w->groups * LV_PIVOTS; k++) {
        const double *row = w->panel + lv_at(k, w->width);
        int32_t q = w->pivots[k] >= 0 ? w->pivots[k] : 0;
        x[k] += w->scaled[q];
        w->scaled[q] = 0.0;
        take_share(w->scaled, row, x[k] / w->diagonal[k], w->width);
    }
}

static void solve_back(lv_work *w, double *x)
{
    clear(w->scaled, (size_t)w->width);
    for (int32_t k = w->groups * LV_PIVOTS - 1; k >= 0; k--) {
        const double *row = w->panel + lv_at(k, w->width);
        double sums[LV_SLOTS] = {0.0, 0.0, 0.0, 0.0};
        for (int32_t i = 0; i < w->width; i += LV_SLOTS)
            for (int32_t s = 0; s < LV_SLOTS; s++)
                sums[s] += row[i + s] * w->scaled[i + s];
        x[k] = (x[k] - ((sums[0] + sums[1]) + (sums[2] + sums[3]))) / w->diagonal[k];
        w->scaled[w->pivots[k] >= 0 ? w->pivots[k] : 0] = x[k];
    }
}

/* The solution as the factors alone give it. */
static void solve_once(lv_work *w, const double *right, double *x)
{
    clear(w->key, (size_t)w->groups * LV_PIVOTS);
    for (int32_t i = 0; i < w->unknowns; i++)
        w->key[i] = right[w->order[i]];
    solve_forward(w, w->key);
    solve_back(w, w->key);
    for (int32_t i = 0; i < w->unknowns; i++)
        x[w->order[i]] = w->key[i];
}

/* What the solution so far leaves of the right side: right - J'(J x), into `moved`. */
static void find_rest(lv_work *w, const double *right, const double *x)
{
    for (int32_t i = 0; i < w->unknowns; i++)
        w->moved[i] = right[i];
    for (int32_t row = 0; row < w->rows; row++) {
        double sum = 0.0;
        for (int32_t a = w->start[row]; a < w->start[row + 1]; a++)
            sum += w->value[a] * x[w->column[a]];
        for (int32_t a = w->start[row]; a < w->start[row + 1]; a++)
            w->moved[w->column[a]] -= w->value[a] * sum;
    }
}

/* The solution, corrected twice by the same factors: a normal matrix of the condition 1e14 has it
 * right within some hundredths, then each time as much better again. */
void fr_lv_solve(lv_work *w, const double *right, double *x)
{
    solve_once(w, right, x);
    for (int32_t time = 0; time < CORRECTIONS; time++) {
        find_rest(w, right, x);
        solve_once(w, w->moved, w->solved);
        for (int32_t i = 0; i < w->unknowns; i++)
            x[i] += w->solved[i];
    }
}
