/* SPDX-License-Identifier: Apache-2.0
 *
 * Which points are valid: each cause is extended over distance by its reach.
 */
#include <math.h>

#include "samples.h"

enum { CAUSES = 3, SPOILT = 128 };

/* A cause, and how many points before and behind it are not valid. */
typedef struct extension {
    unsigned cause;
    size_t before, behind;
} extension;

fr_validity_config fr_validity_defaults(void)
{
    fr_validity_config config = {0.0, 105.91, 52.955, 15.0, 30.0, 30.0};
    return config;
}

static int is_length(double length_m)
{
    return fr_finite(length_m) && length_m >= 0.0;
}

static int validity_is_possible(const fr_validity_config *config)
{
    return fr_above_zero(config->interval_m) && is_length(config->drift_m) &&
           is_length(config->run_in_m) && is_length(config->before_slow_m) &&
           is_length(config->after_slow_m) && is_length(config->after_braking_m);
}

static size_t points_within(double length_m, double interval_m, size_t count)
{
    double points = length_m / interval_m;
    return points < (double)count ? (size_t)rint(points) : count;
}

static int any_spoilt(const uint8_t *causes, size_t count)
{
    unsigned all = 0u;
    for (size_t k = 0; k < count; k++)
        all |= causes[k];
    return (all & SPOILT) != 0u;
}

/* Mark the points behind each cause, and the point itself. */
static void spread_behind(const extension *reach, const uint8_t *causes, size_t count, uint8_t *valid)
{
    size_t since[CAUSES] = {count, count, count};
    for (size_t k = 0; k < count; k++) {
        unsigned here = causes[k];
        for (int i = 0; i < CAUSES; i++) {
            since[i] = (causes[k] & reach[i].cause) != 0u ? 0u : since[i] + 1u;
            here |= since[i] <= reach[i].behind ? SPOILT : 0u;
        }
        valid[k] = (uint8_t)here;
    }
}

/* Mark those before; a point that has nothing at all is valid. */
static void spread_before(const extension *reach, size_t count, size_t run_in, uint8_t *valid)
{
    size_t until[CAUSES] = {count, count, count};
    for (size_t k = count; k > 0u; k--) {
        unsigned here = valid[k - 1u];
        int inside = k > run_in && count - k >= run_in;
        for (int i = 0; i < CAUSES; i++) {
            until[i] = (valid[k - 1u] & reach[i].cause) != 0u ? 0u : until[i] + 1u;
            here |= until[i] <= reach[i].before ? SPOILT : 0u;
        }
        valid[k - 1u] = inside && here == 0u ? 1u : 0u;
    }
}

fr_status fr_validity(const fr_validity_config *config, const uint8_t *causes, size_t count,
                      uint8_t *valid, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_room(count, valid, capacity, written);
    if (status == FR_OK && (config == NULL || (count > 0u && causes == NULL)))
        status = FR_NULL_POINTER;
    if (status == FR_OK && !validity_is_possible(config))
        status = FR_BAD_CONFIG;
    if (status == FR_OK && any_spoilt(causes, count))
        status = FR_BAD_SAMPLE;
    if (status != FR_OK)
        return status;
    double interval_m = config->interval_m;
    size_t drift = points_within(config->drift_m, interval_m, count);
    extension reach[CAUSES] = {{FR_CAUSE_DRIFT, drift, drift},
                               {FR_CAUSE_SLOW, 0u, 0u},
                               {FR_CAUSE_BRAKING, 0u, 0u}};
    reach[1].before = points_within(config->before_slow_m, interval_m, count);
    reach[1].behind = points_within(config->after_slow_m, interval_m, count);
    reach[2].behind = points_within(config->after_braking_m, interval_m, count);
    spread_behind(reach, causes, count, valid);
    spread_before(reach, count, points_within(config->run_in_m, interval_m, count), valid);
    *written = count;
    return FR_OK;
}
