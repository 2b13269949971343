/* SPDX-License-Identifier: Apache-2.0
 *
 * A smoother among the stages of samples: with many short sections in each run.
 */
#include "stages.h"

static uint64_t large[1 << 17];
static uint8_t flags[POINTS];

static fr_status push_road_prior(void *object, size_t count, size_t *written)
{
    return fr_road_prior_push((fr_road_prior *)object, now.force, now.height, now.counts, count,
                              out, beside, flags, POINTS, written);
}

/* Points leave in sections of half a lag, of which there are many in each run. */
void stage_road_prior(void)
{
    fr_road_prior_config config = fr_road_prior_defaults();
    fr_road_prior *object = NULL;
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    config.interval_m = INTERVAL_M;
    config.lag_s = 0.2;
    if (fr_road_prior_init(large, sizeof large, &config, &object) != FR_OK)
        board_put("not possible\n");
    else
        try_pieces(object, fr_road_prior_size(&config), push_road_prior);
}
