/* SPDX-License-Identifier: Apache-2.0
 *
 * The modelled pitch as samples come: settings, memory, calls, and windows that pass into each other.
 */
#include <math.h>
#include <string.h>

#include "bell.h"
#include "bins.h"
#include "pitch.h"

#define PITCH_MAGIC FR_MAGIC(41)
#define LEAST_PITCH_HZ 20.0
#define MOST_PITCH_HZ 1e6
#define MOST_AHEAD_M 100.0
#define LEAST_WHEELBASE_M 0.1
#define LEAST_SHARED_S 5.0
#define MOST_WINDOW_S 3600.0

fr_pitch_config fr_pitch_defaults(void)
{
    fr_pitch_config config = {0.0,   0.0, 0.0, 0.0, 0.0, 600.0, 30.0, 2, FR_BACK_REFUSED,
                              FR_MISSING_REFUSED, 0};
    return config;
}

static void set_windows(fr_pitch *pitch, const fr_pitch_config *config)
{
    double every = fr_bin_samples(config->rate_hz);
    pitch->config = *config;
    pitch->step_s = every / config->rate_hz;
    pitch->every = (int32_t)every;
    pitch->reach = fr_bell_reach(pitch->step_s);
    pitch->window = fr_bins_in(config->window_s, pitch->step_s);
    pitch->shared = fr_bins_in(config->shared_s, pitch->step_s);
}

static double *give_bins(unsigned char *memory, size_t *used, int32_t count)
{
    void *place = memory == NULL ? NULL : (void *)(memory + *used);
    *used += (size_t)count * sizeof(double);
    return (double *)place;
}

/* Where the arrays of an object lie in its memory; returns all bytes. */
static size_t lay_arrays(const fr_pitch *pitch, void *memory, pt_arrays *a)
{
    unsigned char *base = (unsigned char *)memory;
    double **whole[] = {&a->distance, &a->force, &a->height, &a->along,
                        &a->pitch,    &a->road,  &a->measured};
    int32_t room = pitch->window + pitch->shared;
    size_t used = FR_PADDED(fr_pitch);
    for (int32_t p = 0; p < PT_PATHS; p++) {
        int32_t known = p < pitch->config.paths ? room : 0;
        a->row[p] = give_bins(base, &used, known);
        a->row[PT_PATHS + p] = give_bins(base, &used, known);
    }
    for (size_t i = 0; i < sizeof whole / sizeof whole[0]; i++)
        *whole[i] = give_bins(base, &used, room);
    a->before = give_bins(base, &used, pitch->shared);
    a->bell = give_bins(base, &used, pitch->reach + 1);
    return used;
}

static int is_place(double x)
{
    return x >= -MOST_AHEAD_M && x <= MOST_AHEAD_M;
}

static int is_possible_pitch(const fr_pitch_config *c)
{
    return c != NULL && c->rate_hz >= LEAST_PITCH_HZ && c->rate_hz <= MOST_PITCH_HZ &&
           fr_above_zero(c->metres_per_count) && c->metres_per_count <= 10.0 &&
           is_place(c->front_m) && is_place(c->rear_m) && is_place(c->lever_m) &&
           c->front_m - c->rear_m >= LEAST_WHEELBASE_M && c->shared_s >= LEAST_SHARED_S &&
           c->window_s >= c->shared_s && c->window_s <= MOST_WINDOW_S &&
           fr_one_of(c->paths, 1, PT_PATHS) &&
           fr_one_of(c->back, FR_BACK_REFUSED, FR_BACK_TAKEN) &&
           fr_one_of(c->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) && c->reserved == 0;
}

size_t fr_pitch_size(const fr_pitch_config *config)
{
    fr_pitch lengths;
    pt_arrays arrays;
    if (!is_possible_pitch(config))
        return 0u;
    set_windows(&lengths, config);
    return lay_arrays(&lengths, NULL, &arrays);
}

fr_status fr_pitch_init(void *memory, size_t size, const fr_pitch_config *config, fr_pitch **out)
{
    fr_pitch *pitch = (fr_pitch *)memory;
    pt_arrays arrays;
    pt_car car;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_pitch_size(config),
                                PITCH_MAGIC);
    if (status != FR_OK)
        return status;
    set_windows(pitch, config);
    pitch->furthest = INT64_MIN;
    fr_pt_set_car(&car, config);
    fr_pt_set_gains(&pitch->gains, &car, pitch->step_s);
    fr_pt_set_band(&pitch->band, pitch->step_s);
    (void)lay_arrays(pitch, memory, &arrays);
    fr_bell_set(arrays.bell, pitch->reach, pitch->step_s);
    *out = pitch;
    return FR_OK;
}

fr_status fr_pitch_every(const fr_pitch *pitch, int64_t *every)
{
    fr_status status = fr_readable(pitch, PITCH_MAGIC);
    if (status == FR_OK && every == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        *every = pitch->every;
    return status;
}

/* Whether the pitch that these samples may complete has room: what is ready has to be taken before. */
static fr_status check_taken(const fr_pitch *pitch, size_t count)
{
    size_t every = (size_t)pitch->every;
    size_t bins = ((size_t)pitch->filled + count) / every + (size_t)pitch->stored;
    if (count > (size_t)pitch->window * every)
        return FR_TOO_MANY;
    return bins >= (size_t)pitch->window + (size_t)pitch->shared && pitch->taken < pitch->ready
               ? FR_OUTPUT_FULL
               : FR_OK;
}

static fr_status check_pitch_push(const fr_pitch *pitch, const fr_real *force, const fr_real *height,
                                  const int64_t *counts, size_t count, const size_t *ready)
{
    fr_status status = fr_ready(pitch, PITCH_MAGIC);
    if (status == FR_OK && ready == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = fr_check_paths(force, count, pitch->config.paths, pitch->config.missing);
    if (status == FR_OK)
        status = fr_check_paths(height, count, pitch->config.paths, pitch->config.missing);
    if (status == FR_OK)
        status = fr_check_counts(counts, count, pitch->config.back, pitch->furthest);
    return status == FR_OK ? check_taken(pitch, count) : status;
}

/* The pitch of all stored bins. In those that it shares with the window before, that one passes into
 * it. `count` of them are ready, and the others are shared with the next window. */
static void end_pitch_window(fr_pitch *pitch, pt_arrays *a, int32_t count)
{
    double last = (double)(pitch->shared - 1);
    fr_pt_model_window(pitch, a, pitch->stored);
    for (int32_t k = 0; pitch->begun != 0 && k < pitch->shared; k++)
        a->pitch[k] = a->before[k] + (double)k / last * (a->pitch[k] - a->before[k]);
    if (count < pitch->stored)
        (void)memcpy(a->before, a->pitch + count, (size_t)pitch->shared * sizeof *a->before);
    pitch->ready = count;
    pitch->taken = 0;
    pitch->begun = 1;
    fr_pt_drop_bins(pitch, a, count);
}

fr_status fr_pitch_push(fr_pitch *pitch, const fr_real *force, const fr_real *height,
                        const int64_t *counts, size_t count, size_t *ready)
{
    fr_nothing(ready);
    pt_arrays a;
    fr_status status = check_pitch_push(pitch, force, height, counts, count, ready);
    if (status == FR_OUTPUT_FULL)
        *ready = (size_t)(pitch->ready - pitch->taken);
    if (status != FR_OK)
        return status;
    (void)lay_arrays(pitch, pitch, &a);
    for (size_t i = 0; i < count; i++) {
        size_t at = i * (size_t)pitch->config.paths;
        pitch->furthest = counts[i] > pitch->furthest ? counts[i] : pitch->furthest;
        if (fr_pt_add_sample(pitch, &a, force + at, height + at, counts[i]) != 0 &&
            pitch->stored == pitch->window + pitch->shared)
            end_pitch_window(pitch, &a, pitch->window);
    }
    *ready = (size_t)(pitch->ready - pitch->taken);
    return FR_OK;
}

fr_status fr_pitch_finish(fr_pitch *pitch, size_t *ready)
{
    fr_nothing(ready);
    pt_arrays a;
    fr_status status = fr_ready(pitch, PITCH_MAGIC);
    if (status == FR_OK && ready == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK && pitch->taken < pitch->ready) {
        *ready = (size_t)(pitch->ready - pitch->taken);
        status = FR_OUTPUT_FULL;
    }
    if (status != FR_OK)
        return status;
    (void)lay_arrays(pitch, pitch, &a);
    if (pitch->begun != 0 && pitch->stored == pitch->shared) {
        (void)memcpy(a.pitch, a.before, (size_t)pitch->shared * sizeof *a.pitch);
        pitch->ready = pitch->stored;
        pitch->taken = 0;
    } else
        end_pitch_window(pitch, &a, pitch->stored);
    pitch->head.state = FR_STATE_ENDED;
    *ready = (size_t)pitch->ready;
    return FR_OK;
}

fr_status fr_pitch_take(fr_pitch *pitch, double *sin_pitch, size_t capacity, size_t *written)
{
    fr_nothing(written);
    pt_arrays a;
    fr_status status = fr_readable(pitch, PITCH_MAGIC);
    if (status != FR_OK)
        return status;
    if (written == NULL || (capacity > 0u && sin_pitch == NULL))
        return FR_NULL_POINTER;
    (void)lay_arrays(pitch, pitch, &a);
    *written = 0u;
    while (*written < capacity && pitch->taken < pitch->ready) {
        sin_pitch[*written] = sin(a.pitch[pitch->taken]);
        pitch->taken++;
        *written += 1u;
    }
    return FR_OK;
}
