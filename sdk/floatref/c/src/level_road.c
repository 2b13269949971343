/* SPDX-License-Identifier: Apache-2.0
 *
 * The road's points under laser and axles, and what does not change from pass to pass.
 */
#include <math.h>

#include "level_model.h"
#include "level_work.h"

#define NOISE_MPS2 0.1
#define NORMAL 1.4826
#define DECAY_S 0.5
#define JOLT_BESIDE 3

/* Merge `from` into `into`: both are in order, and fill at most six points together. */
static void merge_strips(lv_strip *into, const lv_strip *from)
{
    lv_strip sum;
    int32_t i = 0, j = 0;
    sum.count = 0;
    while (i < into->count || j < from->count) {
        int own = j >= from->count || (i < into->count && into->column[i] <= from->column[j]);
        int other = i >= into->count || (j < from->count && from->column[j] <= into->column[i]);
        sum.column[sum.count] = own != 0 ? into->column[i] : from->column[j];
        sum.value[sum.count] =
            (own != 0 ? into->value[i] : 0.0) + (other != 0 ? from->value[j] : 0.0);
        sum.count++;
        i += own != 0 ? 1 : 0;
        j += other != 0 ? 1 : 0;
    }
    *into = sum;
}

static void leave_zeros(lv_strip *strip)
{
    int32_t left = 0;
    for (int32_t i = 0; i < strip->count; i++) {
        if (strip->value[i] != 0.0) {
            strip->column[left] = strip->column[i];
            strip->value[left] = strip->value[i];
            left++;
        }
    }
    strip->count = left;
}

/* The line between the two points about a place. */
static lv_strip between_points(const lv_work *w, double place)
{
    double at = (place - w->first_m) / LV_SPACING_M;
    double low = fmin(fmax(floor(at), 0.0), (double)(w->points - 2));
    int32_t first = (int32_t)low;
    lv_strip found = {2, {first, first + 1, 0, 0, 0, 0},
                      {1.0 - (at - low), at - low, 0.0, 0.0, 0.0, 0.0}};
    return found;
}

/* The road's mean over what passes at node `k` `ahead_m` of the laser. */
static lv_strip pass_over(const lv_work *w, int32_t k, double ahead_m)
{
    double at = w->place[k] + ahead_m, reach = w->speed[k] * w->interval_s / 3.0;
    lv_strip sum = between_points(w, at - reach);
    lv_strip other = between_points(w, at);
    merge_strips(&sum, &other);
    leave_zeros(&sum);
    other = between_points(w, at + reach);
    merge_strips(&sum, &other);
    leave_zeros(&sum);
    for (int32_t i = 0; i < sum.count; i++)
        sum.value[i] /= 3.0;
    return sum;
}

/* Lay points from a metre before the rearmost place to one behind the foremost; 0 without room. */
static int lay_points(lv_work *w)
{
    double ends[LV_ENDS] = {0.0, w->config->front_m, w->config->rear_m};
    double least = LV_INFINITE, most = -LV_INFINITE, count;
    for (int32_t k = 0; k < w->nodes; k++) {
        for (int32_t end = 0; end < LV_ENDS; end++) {
            least = fmin(least, w->place[k] + ends[end]);
            most = fmax(most, w->place[k] + ends[end]);
        }
    }
    w->first_m = least - 1.0;
    count = ceil((most + 1.0 - w->first_m) / LV_SPACING_M) + 2.0;
    if (!(count <= (double)w->room.points))
        return 0;
    w->points = (int32_t)count;
    w->unknowns = 2 * w->points + LV_IN_TIME * w->nodes + LV_GLOBALS;
    for (int32_t k = 0; k < w->nodes; k++)
        for (int32_t end = 0; end < LV_ENDS; end++)
            w->strip[end][k] = pass_over(w, k, ends[end]);
    return 1;
}

/* The median of `count` values, which are left in another order. */
static double median_of(lv_work *w, double *x, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        w->order[i] = i;
    fr_lv_sort(w->order, x, w->enters, count);
    return 0.5 * (x[w->order[(count - 1) / 2]] + x[w->order[count / 2]]);
}

/* The acceleration along the road at the middles: the smooth one takes a tenth of a second for the
 * end of a brake, the second difference of places has the noise of the encoder's counts. */
static void sharpen(lv_work *w)
{
    int32_t moving = 0;
    double noise = 0.0;
    for (int32_t m = 0; m < w->middles; m++) {
        int32_t k = w->middle[m];
        w->key[moving] = fabs(lv_second(w, w->place, k) - lv_triple(w->along, k));
        moving += w->speed[k] >= LV_MOVING_MPS ? 1 : 0;
    }
    if (moving > 0)
        noise = NORMAL * median_of(w, w->key, moving) / NOISE_MPS2;
    for (int32_t m = 0; m < w->middles; m++) {
        double smooth = lv_triple(w->along, w->middle[m]);
        double off = lv_second(w, w->place, w->middle[m]) - smooth;
        w->sharp[m] = smooth + off / (1.0 + noise * noise);
    }
}

/* How much the acceleration has just changed: the sum that decays, and its largest nearby. */
static void find_jolts(lv_work *w)
{
    double total = 0.0, decay = exp(-w->interval_s / DECAY_S);
    for (int32_t k = 0; k < w->nodes; k++) {
        int goes_on = k > 0 && w->pause[k] < 1.5 * w->interval_s;
        total = goes_on != 0 ? total * decay + fabs(w->along[k] - w->along[k - 1]) : 0.0;
        w->beta[k] = total;
    }
    for (int32_t k = 0; k < w->nodes; k++) {
        int32_t low = k > JOLT_BESIDE ? k - JOLT_BESIDE : 0;
        int32_t high = k + JOLT_BESIDE < w->nodes ? k + JOLT_BESIDE : w->nodes - 1;
        w->jolt[k] = 0.0;
        for (int32_t i = low; i <= high; i++)
            w->jolt[k] = fmax(w->jolt[k], w->beta[i]);
    }
}

/* Which steps from node to node end a standstill that has lasted long enough. */
static void find_rests(lv_work *w)
{
    double stood_s = 0.0;
    for (int32_t k = 1; k < w->nodes; k++) {
        int still = fmax(w->speed[k - 1], w->speed[k]) < LV_STANDING_MPS;
        stood_s = still != 0 ? stood_s + w->pause[k] : 0.0;
        w->rested[k] = stood_s >= LV_REST_S - 1e-9 ? 1 : 0;
    }
}

int fr_lv_lay_road(lv_work *w)
{
    if (!lay_points(w))
        return 0;
    sharpen(w);
    find_jolts(w);
    find_rests(w);
    return 1;
}

double fr_lv_line(const double *places, const double *values, int32_t count, double x)
{
    int32_t low = 0, high = count - 1;
    if (x <= places[0])
        return values[0];
    if (x >= places[high])
        return values[high];
    while (high - low > 1) {
        int32_t half = (low + high) / 2;
        if (places[half] <= x)
            low = half;
        else
            high = half;
    }
    return (values[high] - values[low]) / (places[high] - places[low]) * (x - places[low]) +
           values[low];
}
