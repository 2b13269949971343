/* SPDX-License-Identifier: Apache-2.0
 *
 * The pitch of the body through one stretch of a brake, from the road that its sensors measure
 * (docs/road-prior-slope.md): the pure computation, in memory of the caller.
 */
#include <math.h>
#include <string.h>

#include "level_model.h"
#include "level_work.h"
#include "samples.h"

#define UNSETTLED_RAD 3e-3
#define UNLIKELY 33.0
#define MOST_VALUE 1e9

size_t fr_level_fit_size(const fr_level_fit_config *config)
{
    lv_work work;
    return fr_lv_lay_out(&work, config, NULL);
}

static int is_usual(double x)
{
    return fabs(x) <= MOST_VALUE;
}

static fr_status check_bin(const fr_level_bins *b, size_t i)
{
    int known = is_usual(b->force[i]) && b->missing[i] >= 0.0 && b->missing[i] <= 1.0 &&
                (b->height[i] != b->height[i] || is_usual(b->height[i])) &&
                is_usual(b->distance[i]) && is_usual(b->speed[i]) && is_usual(b->along[i]) &&
                b->number[i] > -(INT64_C(1) << 50) && b->number[i] < (INT64_C(1) << 50);
    if (!known)
        return FR_BAD_SAMPLE;
    if (i > 0u && b->number[i] <= b->number[i - 1u])
        return FR_WRONG_ORDER;
    return i > 0u && b->distance[i] < b->distance[i - 1u] ? FR_GOES_BACK : FR_OK;
}

static fr_status check_bins(const fr_level_bins *b)
{
    fr_status status = FR_OK;
    if (b == NULL)
        return FR_NULL_POINTER;
    if (b->count > 0u && (b->number == NULL || b->force == NULL || b->missing == NULL ||
                          b->height == NULL || b->distance == NULL || b->speed == NULL ||
                          b->along == NULL))
        return FR_NULL_POINTER;
    if (b->count > FR_MOST_SAMPLES)
        return FR_TOO_MANY;
    for (size_t i = 0; i < b->count && status == FR_OK; i++)
        status = check_bin(b, i);
    return status;
}

/* Lay the rows and find the order in which their unknowns are eliminated. */
static int32_t prepare(lv_work *w, const fr_level_bins *bins)
{
    int32_t nodes = fr_lv_read(w, bins);
    if (nodes < 0)
        return FR_LEVEL_TOO_LONG;
    if (w->middles == 0)
        return FR_LEVEL_TOO_SHORT;
    if (!fr_lv_lay_road(w))
        return FR_LEVEL_TOO_LONG;
    fr_lv_start(w);
    fr_lv_fix_sigmas(w);
    fr_lv_hold(w, 1.0, 1);
    w->width = 0;
    fr_lv_derive(w, 0);
    return fr_lv_plan(w, w->room.width) ? FR_LEVEL_FOUND : FR_LEVEL_TOO_LONG;
}

static int is_finite_fit(const lv_work *w)
{
    for (int32_t i = 0; i < w->unknowns; i++)
        if (!fr_finite(w->y[i]))
            return 0;
    return 1;
}

/* Whether the fit has settled on a vehicle that there may be. */
static int32_t judge(const lv_work *w, const fr_level_result *result)
{
    if (!(result->changed_rad < UNSETTLED_RAD) || !is_finite_fit(w))
        return FR_LEVEL_UNSETTLED;
    return result->prior_misfit < UNLIKELY ? FR_LEVEL_FOUND : FR_LEVEL_UNLIKELY;
}

static void keep_result(lv_work *w, fr_level_result *result)
{
    result->passes = fr_lv_fit(w, &result->changed_rad);
    result->prior_misfit = fr_lv_prior_misfit(w);
    result->grade = fr_lv_grade(w);
    for (int32_t i = 0; i < LV_GLOBALS; i++)
        result->vehicle[i] = w->y[lv_global(w, i)];
    result->outcome = judge(w, result);
}

/* Marks from the first bin to the last, about 8 m apart. */
static void place_marks(lv_work *w, const fr_level_bins *bins)
{
    double first = bins->distance[0], length = bins->distance[bins->count - 1u] - first;
    double most = fmin(rint(length / LV_MARKS_M), (double)(w->room.marks - 1));
    w->marks = (int32_t)fmax(2.0, most + 1.0);
    for (int32_t i = 0; i < w->marks; i++)
        w->mark[i] = first + length * ((double)i / (double)(w->marks - 1));
}

static void write_pitch(const lv_work *w, const fr_level_bins *bins, double *pitch)
{
    const double *turned = w->y + lv_in_time(w, LV_PITCH);
    for (size_t i = 0; i < bins->count; i++) {
        double bin = (double)(bins->number[i] - bins->number[0]);
        pitch[i] = fr_lv_line(w->bin, turned, w->nodes, bin);
    }
}

/* Pitch and 1-sigma of every bin: nothing is levelled by a fit that is not believed. */
static void write_bins(lv_work *w, const fr_level_bins *bins, const fr_level_result *result,
                       double *pitch, double *sigma_m)
{
    int known = result->outcome == FR_LEVEL_FOUND;
    for (size_t i = 0; i < bins->count; i++) {
        pitch[i] = 0.0;
        sigma_m[i] = LV_UNKNOWN_M;
    }
    if (known == 0)
        return;
    write_pitch(w, bins, pitch);
    place_marks(w, bins);
    if (!fr_lv_elevation_sigma(w))
        return;
    for (size_t i = 0; i < bins->count; i++)
        sigma_m[i] = fr_lv_line(w->mark, w->found, w->marks, bins->distance[i]);
}

void fr_lv_fit_bins(lv_work *w, const fr_level_bins *bins, fr_level_result *result, double *pitch,
                    double *sigma_m)
{
    (void)memset(result, 0, sizeof *result);
    result->outcome = prepare(w, bins);
    if (result->outcome == FR_LEVEL_FOUND)
        keep_result(w, result);
    write_bins(w, bins, result, pitch, sigma_m);
}

static fr_status check_memory(const void *memory, size_t size, size_t needed)
{
    if (memory == NULL)
        return FR_NULL_POINTER;
    if (needed == 0u)
        return FR_BAD_CONFIG;
    if ((uintptr_t)memory % FR_ALIGNMENT != 0u)
        return FR_MISALIGNED;
    return size < needed ? FR_TOO_SMALL : FR_OK;
}

static fr_status check_room(const double *pitch, const double *sigma_m, const fr_level_bins *bins,
                            size_t capacity, size_t *written)
{
    if (bins->count > 0u && (pitch == NULL || sigma_m == NULL))
        return FR_NULL_POINTER;
    *written = bins->count;
    return bins->count > capacity ? FR_OUTPUT_FULL : FR_OK;
}

fr_status fr_level_fit(const fr_level_fit_config *config, void *memory, size_t size,
                       const fr_level_bins *bins, fr_level_result *result, double *pitch,
                       double *sigma_m, size_t capacity, size_t *written)
{
    fr_nothing(written);
    lv_work work;
    fr_status status;
    if (config == NULL || result == NULL || written == NULL)
        return FR_NULL_POINTER;
    *written = 0u;
    status = check_memory(memory, size, fr_level_fit_size(config));
    if (status == FR_OK)
        status = check_bins(bins);
    if (status == FR_OK)
        status = check_room(pitch, sigma_m, bins, capacity, written);
    if (status != FR_OK)
        return status;
    (void)fr_lv_lay_out(&work, config, memory);
    fr_lv_fit_bins(&work, bins, result, pitch, sigma_m);
    return FR_OK;
}
