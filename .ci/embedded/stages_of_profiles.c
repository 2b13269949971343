/* SPDX-License-Identifier: Apache-2.0
 *
 * Stages whose samples are the points of a profile: measures of it, and what of it is valid.
 */
#include "stages.h"

/* A call has all points of a profile; the correlation takes a window of it. */
enum { PROFILE = 1000 };

static uint8_t causes_of_points[PROFILE];

PUSH(high_pass_profile, fr_high_pass_profile_config, out)

void stage_high_pass_profile(void)
{
    fr_high_pass_profile_config config = fr_high_pass_profile_defaults();
    config.interval_m = INTERVAL_M;
    try_profile(high_pass_profile, &config, PROFILE);
}

/* In the last fifth of the points, with 20 m in front of it. */
static fr_status push_seam(void *config, size_t count, size_t *written)
{
    *written = count;
    return fr_seam((fr_seam_config *)config, 4u * count / 5u, 4u * count / 5u + 3u, out, count);
}

void stage_seam(void)
{
    fr_seam_config config = fr_seam_defaults();
    config.interval_m = INTERVAL_M;
    try_profile(push_seam, &config, PROFILE);
}

static fr_status push_correlation(void *config, size_t count, size_t *written)
{
    fr_agreement agreement;
    fr_status status =
        fr_cross_correlation((fr_cross_correlation_config *)config, out, beside, count, &agreement);
    out[0] = (fr_real)agreement.cross_correlation;
    *written = 1u;
    return status;
}

static void try_correlation(double max_offset_m)
{
    fr_cross_correlation_config config = fr_cross_correlation_defaults();
    config.interval_m = INTERVAL_M;
    config.max_offset_m = max_offset_m;
    try_profile(push_correlation, &config, PROFILE);
}

void stage_cross_correlation(void)
{
    try_correlation(1.0);
}

void stage_cross_correlation_100_mm(void)
{
    try_correlation(0.1);
}

/* One disturbed point, and a slow stretch; of each point, how many are valid up to it. */
static fr_status push_validity(void *config, size_t count, size_t *written)
{
    fr_status status;
    uint32_t valid = 0;
    for (size_t i = 0; i < count; i++)
        causes_of_points[i] = i > 2u * count / 3u ? FR_CAUSE_SLOW : 0;
    causes_of_points[count / 3u] = FR_CAUSE_DRIFT;
    status = fr_validity((fr_validity_config *)config, causes_of_points, count, causes_of_points,
                         PROFILE, written);
    for (size_t i = 0; i < *written; i++) {
        valid += causes_of_points[i];
        out[i] = (fr_real)valid;
    }
    return status;
}

void stage_validity(void)
{
    fr_validity_config config = fr_validity_defaults();
    config.interval_m = INTERVAL_M;
    config.drift_m = 5.0;
    config.run_in_m = 2.5;
    config.before_slow_m = 1.0;
    try_profile(push_validity, &config, PROFILE);
}
