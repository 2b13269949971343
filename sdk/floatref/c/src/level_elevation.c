/* SPDX-License-Identifier: Apache-2.0
 *
 * What levelling leaves in the elevation: 1-sigma of the high-passed road of a fit, at marks.
 *
 * The covariance W (J'J)^-1 W' of weights W is the sum of the squares of L^-1 W' over D, which the
 * factors give group by group; so neither they nor the weights are stored.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"
#include "samples.h"

#define GAIN_DOUBT 0.045
#define TURN_DOUBT 1.0
#define TOGETHER 8.0
#define GRADE_DOUBT 0.016

enum { FROM_LEFT, ALONG_LEFT, FROM_RIGHT, ALONG_RIGHT, TAILS };

/* What the high-pass takes of a point `offset` points away; they sum to 0. */
static void lay_high_pass(lv_work *w)
{
    double cutoff = 2.0 * FR_PI / w->config->wavelength_m, total = 0.0;
    double reach_m = LV_REACH * w->config->wavelength_m;
    for (int32_t o = 0; o <= w->wide; o++) {
        double a = cutoff * LV_SPACING_M * (double)o, b = sqrt(0.75) * a;
        double share = exp(-a) + exp(-0.5 * a) * (cos(b) + 2.0 * sqrt(0.75) * sin(b));
        w->high_pass[o] = LV_SPACING_M * (double)o <= reach_m ? share : 0.0;
        total += o > 0 ? 2.0 * w->high_pass[o] : w->high_pass[o];
    }
    for (int32_t o = 0; o <= w->wide; o++)
        w->high_pass[o] = -w->high_pass[o] / total;
    w->high_pass[0] += 1.0;
}

/* Beyond the stretch the road goes on with the slope of its end: what a mark takes of that. */
static void lay_tails(lv_work *w, int32_t mark)
{
    double *tail = w->tails + lv_at(mark, TAILS);
    int32_t left = w->point_of[mark], right = w->points - 1 - left;
    for (int32_t i = 0; i < TAILS; i++)
        tail[i] = 0.0;
    for (int32_t o = 1; o <= w->wide; o++) {
        double left_m = LV_SPACING_M * (double)(o - left);
        double right_m = LV_SPACING_M * (double)(o - right);
        if (o > left) {
            tail[FROM_LEFT] += w->high_pass[o];
            tail[ALONG_LEFT] -= w->high_pass[o] * left_m;
        }
        if (o > right) {
            tail[FROM_RIGHT] += w->high_pass[o];
            tail[ALONG_RIGHT] += w->high_pass[o] * right_m;
        }
    }
}

static void lay_weights(lv_work *w)
{
    lay_high_pass(w);
    for (int32_t mark = 0; mark < w->marks; mark++) {
        double at = rint((w->mark[mark] - w->first_m) / LV_SPACING_M);
        w->point_of[mark] = (int32_t)fmin(fmax(at, 0.0), (double)(w->points - 1));
        lay_tails(w, mark);
    }
}

/* The weight of the elevation at a point in a mark. */
static double of_elevation(const lv_work *w, int32_t mark, int32_t j)
{
    int32_t offset = j < w->point_of[mark] ? w->point_of[mark] - j : j - w->point_of[mark];
    double found = offset <= w->wide ? w->high_pass[offset] : 0.0;
    found += j == 0 ? w->tails[mark * TAILS + FROM_LEFT] : 0.0;
    return found + (j == w->points - 1 ? w->tails[mark * TAILS + FROM_RIGHT] : 0.0);
}

static double of_slope(const lv_work *w, int32_t mark, int32_t j)
{
    double found = j == 0 ? w->tails[mark * TAILS + ALONG_LEFT] : 0.0;
    return found + (j == w->points - 1 ? w->tails[mark * TAILS + ALONG_RIGHT] : 0.0);
}

/* The weights of an unknown in all marks, in the gain and in the mean slope. */
static void weigh(const lv_work *w, int32_t unknown, double *row)
{
    int32_t j = unknown - w->points;
    int is_slope = j >= 0 && j < w->points;
    for (int32_t mark = 0; mark < w->marks; mark++) {
        row[mark] = j < 0 ? of_elevation(w, mark, unknown) : 0.0;
        if (is_slope)
            row[mark] = of_slope(w, mark, j);
    }
    row[w->marks] = unknown == lv_global(w, LV_GAIN) ? 1.0 : 0.0;
    row[w->marks + 1] = is_slope ? 1.0 / (double)w->points : 0.0;
}

/* The rows of the weights of a group, with what the front has of them. */
static void take_rows(lv_work *w, int32_t group, int32_t columns)
{
    for (int32_t p = 0; p < LV_PIVOTS; p++) {
        int32_t place = group * LV_PIVOTS + p, pivot = w->pivots[place];
        double *row = w->rows_of + lv_at(p, columns);
        if (place < w->unknowns)
            weigh(w, w->order[place], row);
        for (int32_t i = 0; i < columns; i++)
            row[i] = pivot >= 0 ? row[i] + w->carried[pivot * columns + i] : 0.0;
    }
}

/* Divide them by L among each other. */
static void divide_rows(lv_work *w, int32_t group, int32_t columns)
{
    const int32_t *pivots = w->pivots + lv_at(group, LV_PIVOTS);
    for (int32_t p = 0; p < LV_PIVOTS; p++) {
        const double *panel = w->panel + lv_at(p, w->width), *row = w->rows_of + lv_at(p, columns);
        for (int32_t later = p + 1; later < LV_PIVOTS; later++) {
            double share = pivots[later] >= 0 ? panel[pivots[later]] / w->diagonal[p] : 0.0;
            for (int32_t i = 0; i < columns; i++)
                w->rows_of[later * columns + i] -= share * row[i];
        }
        for (int32_t i = 0; i < columns; i++)
            w->scaled_of[p * columns + i] = row[i] / w->diagonal[p];
    }
}

/* Leave to the others in the front what they have of the rows. */
static void carry_on(lv_work *w, int32_t group, int32_t columns)
{
    const int32_t *pivots = w->pivots + lv_at(group, LV_PIVOTS);
    for (int32_t i = 0; i < w->width; i++) {
        double shares[LV_PIVOTS];
        for (int32_t p = 0; p < LV_PIVOTS; p++)
            shares[p] = w->panel[p * w->width + i];
        fr_lv_take_products(w->carried + lv_at(i, columns), w->scaled_of, columns, shares, columns);
    }
    for (int32_t p = 0; p < LV_PIVOTS; p++)
        for (int32_t i = 0; i < columns && pivots[p] >= 0; i++)
            w->carried[lv_at(pivots[p], columns) + (size_t)i] = 0.0;
}

/* Add the products with itself, with gain and with grade of every column. */
static void add_products(lv_work *w, int32_t columns)
{
    for (int32_t p = 0; p < LV_PIVOTS; p++) {
        const double *row = w->rows_of + lv_at(p, columns);
        const double *scaled = w->scaled_of + lv_at(p, columns);
        for (int32_t i = 0; i < columns; i++) {
            double *with = w->with + lv_at(i, 3);
            with[0] += row[i] * scaled[i];
            with[1] += row[i] * scaled[columns - 2];
            with[2] += row[i] * scaled[columns - 1];
        }
    }
}

static int find_products(lv_work *w, int32_t columns)
{
    for (int32_t i = 0; i < w->width * w->width; i++)
        w->front[i] = 0.0;
    for (int32_t i = 0; i < w->width * columns; i++)
        w->carried[i] = 0.0;
    for (int32_t i = 0; i < 3 * columns; i++)
        w->with[i] = 0.0;
    for (int32_t group = 0; group < w->groups; group++) {
        if (!fr_lv_eliminate_group(w, group, w->panel, w->diagonal))
            return 0;
        take_rows(w, group, columns);
        divide_rows(w, group, columns);
        carry_on(w, group, columns);
        add_products(w, columns);
    }
    return 1;
}

/* Widen by a gain and a grade that are off by more than the rows know. */
static void widen_by_doubts(lv_work *w, double gain, int32_t columns)
{
    const double *of_gain = w->with + lv_at(columns - 2, 3), *of_grade = of_gain + 3;
    double grade = fmin(TOGETHER * sqrt(of_grade[2]), GRADE_DOUBT);
    for (int32_t mark = 0; mark < w->marks; mark++) {
        const double *with = w->with + lv_at(mark, 3);
        double by_gain = gain * with[1] / of_gain[1], by_grade = grade * with[2] / of_grade[2];
        w->found[mark] = sqrt(with[0] + (by_gain * by_gain + by_grade * by_grade));
    }
}

int fr_lv_elevation_sigma(lv_work *w)
{
    int32_t columns = w->marks + 2;
    double gain;
    w->width = 0;
    fr_lv_hold(w, 1.0, 0);
    fr_lv_lay_known(w);
    gain = hypot(GAIN_DOUBT, TURN_DOUBT * fr_lv_turn(w)) * w->y[lv_global(w, LV_GAIN)];
    fr_lv_derive(w, 1);
    if (!fr_lv_plan(w, w->room.width + LV_WIDER))
        return 0;
    fr_lv_derive(w, 1);
    lay_weights(w);
    if (!find_products(w, columns))
        return 0;
    widen_by_doubts(w, gain, columns);
    return 1;
}
