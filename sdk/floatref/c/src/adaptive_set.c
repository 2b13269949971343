/* SPDX-License-Identifier: Apache-2.0
 *
 * The set of filters at the cut-off of the travel speed, 5.7.
 */
#include "backward.h"
#include "calls.h"
#include "datum.h"
#include "section.h"

#define ADAPTIVE_SET_MAGIC FR_MAGIC(7)

struct fr_adaptive_set {
    fr_head head;
    int32_t missing, tangent_form;
    fr_calls calls;
    fr_datum datum;
    fr_schedule schedule;
    fr_tangent tangent;
    fr_section acceleration, velocity, height_1, height_2;
};

fr_adaptive_set_config fr_adaptive_set_defaults(void)
{
    fr_adaptive_set_config config = {0.0, {0.0, 0.0, 0.0, 0.0}, FR_MISSING_REFUSED, FR_TANGENT_EXACT};
    config.cut_off = fr_cut_off_defaults();
    return config;
}

size_t fr_adaptive_set_size(const fr_adaptive_set_config *config)
{
    int possible = config != NULL && fr_above_zero(config->rate_hz) &&
                   fr_above_zero(1.0 / config->rate_hz) &&
                   fr_cut_off_is_possible(&config->cut_off) &&
                   fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) &&
                   fr_one_of(config->tangent, FR_TANGENT_EXACT, FR_TANGENT_SHORT);
    return possible ? sizeof(fr_adaptive_set) : 0u;
}

fr_status fr_adaptive_set_init(void *memory, size_t size, const fr_adaptive_set_config *config,
                               fr_adaptive_set **out)
{
    fr_adaptive_set *set = (fr_adaptive_set *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_adaptive_set_size(config), ADAPTIVE_SET_MAGIC);
    if (status != FR_OK)
        return status;
    set->missing = config->missing;
    set->tangent_form = config->tangent;
    set->schedule = fr_schedule_of(&config->cut_off);
    set->tangent = fr_tangent_of(1.0 / config->rate_hz, config->tangent);
    *out = set;
    return FR_OK;
}

static fr_real pass_one(fr_adaptive_set *set, int signal, fr_real x, fr_real c)
{
    if (signal == FR_ACCELERATION)
        return fr_section_1_any(&set->acceleration, x, c);
    if (signal == FR_VELOCITY)
        return fr_section_2_any(&set->velocity, x, c);
    return fr_section_12_any(&set->height_1, &set->height_2, fr_from_datum(&set->datum, x), c);
}

static void run_set(fr_adaptive_set *set, int signal, const fr_real *x, const fr_real *speed,
                    size_t count, fr_real *y)
{
    fr_real cutoff[FR_BLOCK], c[FR_BLOCK];
    for (size_t done = 0; done < count; done += FR_BLOCK) {
        size_t size = count - done < FR_BLOCK ? count - done : FR_BLOCK;
        fr_frequencies(&set->schedule, speed + done, size, cutoff);
        fr_tangents(&set->tangent, cutoff, size, c);
        for (size_t k = 0; k < size; k++)
            y[done + k] = pass_one(set, signal, x[done + k], c[k]);
    }
}

static fr_status pass_signal(fr_adaptive_set *set, int signal, const fr_real *x,
                             const fr_real *speed, size_t count, fr_real *y, size_t capacity,
                             size_t *written)
{
    fr_status status = fr_ready(set, ADAPTIVE_SET_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, y, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(x, count, set->missing);
    if (status == FR_OK)
        status = fr_check_speeds(&set->schedule, &set->tangent, speed, count, set->missing);
    if (status == FR_OK)
        status = fr_calls_check(&set->calls, signal, count);
    if (status != FR_OK)
        return status;
    /* Before the samples: `y` may be the array of the speed. */
    fr_calls_add(&set->calls, signal, speed, count);
    run_set(set, signal, x, speed, count, y);
    *written = count;
    return FR_OK;
}

fr_status fr_adaptive_set_acceleration(fr_adaptive_set *set, const fr_real *x, const fr_real *speed,
                                       size_t count, fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    return pass_signal(set, FR_ACCELERATION, x, speed, count, y, capacity, written);
}

fr_status fr_adaptive_set_velocity(fr_adaptive_set *set, const fr_real *x, const fr_real *speed,
                                   size_t count, fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    return pass_signal(set, FR_VELOCITY, x, speed, count, y, capacity, written);
}

fr_status fr_adaptive_set_height(fr_adaptive_set *set, const fr_real *x, const fr_real *speed,
                                 size_t count, fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    return pass_signal(set, FR_HEIGHT, x, speed, count, y, capacity, written);
}

/* Whether the run may end with a backward pass over these samples. */
static fr_status check_reverse(const fr_adaptive_set *set, const fr_real *elevation,
                               const fr_real *speed, size_t count, const fr_real *profile,
                               size_t capacity, size_t *written)
{
    fr_status status = fr_ready(set, ADAPTIVE_SET_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, profile, capacity, written);
    if (status == FR_OK)
        status = fr_check_profile(elevation, count, set->missing);
    return status == FR_OK ? fr_check_samples(speed, count, set->missing) : status;
}

fr_status fr_adaptive_set_reverse(fr_adaptive_set *set, const fr_real *elevation,
                                  const fr_real *speed, size_t count, fr_real *profile,
                                  size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_reverse(set, elevation, speed, count, profile, capacity, written);
    if (status == FR_OK)
        status = fr_check_speeds(&set->schedule, &set->tangent, speed, count, set->missing);
    if (status == FR_OK)
        status = fr_calls_complete_in_time(&set->calls, speed, count);
    if (status != FR_OK)
        return status;
    fr_pass_backward(&set->schedule, &set->tangent, 0, elevation, speed, count, profile);
    set->head.state = FR_STATE_ENDED;
    *written = count;
    return FR_OK;
}

fr_status fr_adaptive_set_reverse_over_distance(fr_adaptive_set *set, double interval_m,
                                                const fr_real *elevation, const fr_real *speed,
                                                size_t count, fr_real *profile, size_t capacity,
                                                size_t *written)
{
    fr_nothing(written);
    fr_status status = check_reverse(set, elevation, speed, count, profile, capacity, written);
    if (status == FR_OK && !(fr_above_zero(interval_m) && fr_above_zero(1.0 / interval_m)))
        status = FR_BAD_CONFIG;
    if (status == FR_OK)
        status = fr_calls_complete(&set->calls);
    if (status != FR_OK)
        return status;
    fr_tangent tangent = fr_tangent_of(interval_m, set->tangent_form);
    fr_pass_backward(&set->schedule, &tangent, fr_largest_wave_number(interval_m), elevation, speed,
                     count, profile);
    set->head.state = FR_STATE_ENDED;
    *written = count;
    return FR_OK;
}

fr_status fr_adaptive_set_finish(fr_adaptive_set *set)
{
    fr_status status = fr_ready(set, ADAPTIVE_SET_MAGIC);
    if (status == FR_OK)
        status = fr_calls_complete(&set->calls);
    if (status == FR_OK)
        set->head.state = FR_STATE_ENDED;
    return status;
}
