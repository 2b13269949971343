/* SPDX-License-Identifier: Apache-2.0
 *
 * HPF_B3x2 of a finished profile: HPF_B3S1, HPF_B3S2R, HPF_B3S1R and HPF_B3S2 in this order.
 */
#include <string.h>

#include "filter.h"

fr_high_pass_profile_config fr_high_pass_profile_defaults(void)
{
    fr_high_pass_profile_config config = {0.0, 91.44};
    return config;
}

static void pass_whole(fr_filter_config *config, int32_t order, int32_t direction, size_t count,
                       fr_real *y)
{
    fr_filter filter;
    config->order = order;
    config->direction = direction;
    (void)memset(&filter, 0, sizeof filter);
    fr_filter_set(&filter, config);
    fr_filter_run(&filter, y, count, y);
}

fr_status fr_high_pass_profile(const fr_high_pass_profile_config *config, const fr_real *elevation,
                               size_t count, fr_real *filtered, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_filter_config pass = fr_filter_defaults();
    fr_status status = fr_room(count, filtered, capacity, written);
    if (status == FR_OK && config == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK)
        status = fr_check_samples(elevation, count, FR_MISSING_REFUSED);
    /* A wavelength of zero has no wave number. */
    if (status == FR_OK && !fr_above_zero(config->wavelength_m))
        status = FR_BAD_CONFIG;
    if (status != FR_OK)
        return status;
    pass.step = config->interval_m;
    pass.cutoff = 1.0 / fr_high_pass_wavelength_setting(config->wavelength_m);
    if (fr_filter_size(&pass) == 0u)
        return FR_BAD_CONFIG;
    fr_real datum = count > 0u ? elevation[0] : 0;
    for (size_t k = 0; k < count; k++)
        filtered[k] = elevation[k] - datum;
    pass_whole(&pass, 1, FR_FORWARD, count, filtered);
    pass_whole(&pass, 2, FR_BACKWARD, count, filtered);
    pass_whole(&pass, 1, FR_BACKWARD, count, filtered);
    pass_whole(&pass, 2, FR_FORWARD, count, filtered);
    *written = count;
    return FR_OK;
}
