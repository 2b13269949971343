/* SPDX-License-Identifier: Apache-2.0
 *
 * The set of filters at a fixed cut-off: HPF_B3 (A.1) in two stages, one before each integration,
 * both on the height, in time (5.5) or over distance (5.9).
 */
#include "calls.h"
#include "datum.h"
#include "filter.h"

#define HIGH_PASS_MAGIC FR_MAGIC(6)

struct fr_high_pass_set {
    fr_head head;
    int32_t missing;
    fr_calls calls;
    fr_datum datum;
    fr_filter acceleration, velocity, height_1, height_2, back_2, back_1;
};

fr_high_pass_set_config fr_high_pass_set_defaults(void)
{
    fr_high_pass_set_config config = {0.0, 0.0, FR_MISSING_REFUSED};
    return config;
}

static fr_filter_config section_of(const fr_high_pass_set_config *config, int32_t order,
                                   int32_t direction)
{
    fr_filter_config section = fr_filter_defaults();
    section.step = config->step;
    section.cutoff = config->cutoff;
    section.order = order;
    section.direction = direction;
    section.missing = config->missing;
    return section;
}

size_t fr_high_pass_set_size(const fr_high_pass_set_config *config)
{
    if (config == NULL)
        return 0u;
    fr_filter_config section = section_of(config, 1, FR_FORWARD);
    return fr_filter_size(&section) > 0u ? sizeof(fr_high_pass_set) : 0u;
}

static void set_section(fr_filter *filter, const fr_high_pass_set_config *config, int32_t order,
                        int32_t direction)
{
    fr_filter_config section = section_of(config, order, direction);
    fr_filter_set(filter, &section);
}

fr_status fr_high_pass_set_init(void *memory, size_t size, const fr_high_pass_set_config *config,
                                fr_high_pass_set **out)
{
    fr_high_pass_set *set = (fr_high_pass_set *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_high_pass_set_size(config), HIGH_PASS_MAGIC);
    if (status != FR_OK)
        return status;
    set->missing = config->missing;
    set_section(&set->acceleration, config, 1, FR_FORWARD);
    set_section(&set->velocity, config, 2, FR_FORWARD);
    set_section(&set->height_1, config, 1, FR_FORWARD);
    set_section(&set->height_2, config, 2, FR_FORWARD);
    set_section(&set->back_2, config, 2, FR_BACKWARD);
    set_section(&set->back_1, config, 1, FR_BACKWARD);
    *out = set;
    return FR_OK;
}

static fr_status check_call(const fr_high_pass_set *set, int signal, const fr_real *x, size_t count,
                            const fr_real *y, size_t capacity, size_t *written)
{
    fr_status status = fr_ready(set, HIGH_PASS_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, y, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(x, count, set->missing);
    return status == FR_OK ? fr_calls_check(&set->calls, signal, count) : status;
}

fr_status fr_high_pass_set_acceleration(fr_high_pass_set *set, const fr_real *x, size_t count,
                                        fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_call(set, FR_ACCELERATION, x, count, y, capacity, written);
    if (status != FR_OK)
        return status;
    fr_filter_run(&set->acceleration, x, count, y);
    fr_calls_add(&set->calls, FR_ACCELERATION, NULL, count);
    *written = count;
    return FR_OK;
}

fr_status fr_high_pass_set_velocity(fr_high_pass_set *set, const fr_real *x, size_t count,
                                    fr_real *y, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_call(set, FR_VELOCITY, x, count, y, capacity, written);
    if (status != FR_OK)
        return status;
    fr_filter_run(&set->velocity, x, count, y);
    fr_calls_add(&set->calls, FR_VELOCITY, NULL, count);
    *written = count;
    return FR_OK;
}

fr_status fr_high_pass_set_height(fr_high_pass_set *set, const fr_real *x, size_t count, fr_real *y,
                                  size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = check_call(set, FR_HEIGHT, x, count, y, capacity, written);
    if (status != FR_OK)
        return status;
    for (size_t i = 0; i < count; i++)
        y[i] = fr_from_datum(&set->datum, x[i]);
    fr_filter_run(&set->height_1, y, count, y);
    fr_filter_run(&set->height_2, y, count, y);
    fr_calls_add(&set->calls, FR_HEIGHT, NULL, count);
    *written = count;
    return FR_OK;
}

fr_status fr_high_pass_set_reverse(fr_high_pass_set *set, const fr_real *elevation, size_t count,
                                   fr_real *profile, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(set, HIGH_PASS_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, profile, capacity, written);
    if (status == FR_OK)
        status = fr_check_profile(elevation, count, set->missing);
    if (status == FR_OK)
        status = fr_calls_complete_in_time(&set->calls, NULL, count);
    if (status != FR_OK)
        return status;
    fr_filter_run(&set->back_2, elevation, count, profile);
    fr_filter_run(&set->back_1, profile, count, profile);
    set->head.state = FR_STATE_ENDED;
    *written = count;
    return FR_OK;
}

fr_status fr_high_pass_set_finish(fr_high_pass_set *set)
{
    fr_status status = fr_ready(set, HIGH_PASS_MAGIC);
    if (status == FR_OK)
        status = fr_calls_complete(&set->calls);
    if (status == FR_OK)
        set->head.state = FR_STATE_ENDED;
    return status;
}
