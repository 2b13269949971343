/* SPDX-License-Identifier: Apache-2.0
 *
 * For the 1-sigma of levelling: the road outside of the brake, which the smoother knows, and by how
 * much it turns under the wheels where the vehicle brakes.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"

#define KNOWN_M 2e-3
#define BESIDE_M 2.0

static int brakes(const lv_work *w, int32_t k)
{
    return fabs(w->along[k]) > LV_BRAKING_MPS2;
}

/* Mark the points that are near the place of a node. */
static void mark_near(const lv_work *w, double place, int32_t *near)
{
    double low = floor((place - BESIDE_M - w->first_m) / LV_SPACING_M);
    int32_t first = (int32_t)fmin(fmax(low, 0.0), (double)w->points);
    for (int32_t j = first; j < w->points; j++) {
        double off = w->first_m + LV_SPACING_M * (double)j - place;
        if (off >= BESIDE_M)
            break;
        if (off > -BESIDE_M)
            near[j] = 1;
    }
}

/* Lay a row about each point that is outside, with those 8 m to both sides. */
void fr_lv_lay_known(lv_work *w)
{
    int32_t *near = w->enters, count = 0;
    for (int32_t j = 0; j < w->points; j++)
        near[j] = 0;
    for (int32_t k = 0; k < w->nodes; k++)
        if (brakes(w, k))
            mark_near(w, w->place[k], near);
    for (int32_t j = LV_SIDE; j + LV_SIDE < w->points; j++) {
        if (near[j - LV_SIDE] + near[j] + near[j + LV_SIDE] == 0) {
            w->sigma[w->begin[LV_KNOWN] + count] = KNOWN_M;
            w->middle_of[count] = j;
            count++;
        }
    }
    w->rows = w->begin[LV_KNOWN] + count;
    w->begin[LV_GROUPS] = w->rows;
}

/* The root mean square of what the slope under the wheels has changed by over a wheelbase, at the
 * nodes that brake; of nodes in one place the first counts. */
double fr_lv_turn(lv_work *w)
{
    double *places = w->key, *slopes = w->solved, sum = 0.0;
    double length = w->config->front_m - w->config->rear_m;
    int32_t count = 0, active = 0;
    for (int32_t k = 0; k < w->nodes; k++) {
        if (count == 0 || w->place[k] > places[count - 1]) {
            places[count] = w->place[k];
            slopes[count] = w->beta[k];
            count++;
        }
    }
    for (int32_t k = 0; k < w->nodes; k++) {
        if (brakes(w, k)) {
            double off = w->beta[k] - fr_lv_line(places, slopes, count, w->place[k] - length);
            sum += off * off;
            active++;
        }
    }
    return active > 0 ? sqrt(sum / (double)active) : 0.0;
}
