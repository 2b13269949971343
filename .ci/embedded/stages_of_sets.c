/* SPDX-License-Identifier: Apache-2.0
 *
 * High-pass sets, and the algorithm of 5.7 whole, with the settings of the pages.
 */
#include "stages.h"

static fr_status push_high_pass_set(void *object, size_t count, size_t *written)
{
    fr_high_pass_set *set = (fr_high_pass_set *)object;
    fr_status status = fr_high_pass_set_acceleration(set, now.force, count, out, POINTS, written);
    if (status == FR_OK)
        status = fr_high_pass_set_velocity(set, out, count, beside, POINTS, written);
    return status == FR_OK
               ? fr_high_pass_set_height(set, now.height, count, out, POINTS, written)
               : status;
}

void stage_high_pass_set(void)
{
    fr_high_pass_set_config config = fr_high_pass_set_defaults();
    config.step = 1.0 / RATE_HZ;
    config.cutoff = 0.45;
    RUN(high_pass_set, config, push_high_pass_set);
}

static fr_status push_adaptive_set(void *object, size_t count, size_t *written)
{
    fr_adaptive_set *set = (fr_adaptive_set *)object;
    fr_status status =
        fr_adaptive_set_acceleration(set, now.force, now.speed, count, out, POINTS, written);
    if (status == FR_OK)
        status = fr_adaptive_set_velocity(set, out, now.speed, count, beside, POINTS, written);
    return status == FR_OK ? fr_adaptive_set_height(set, now.height, now.speed, count, out, POINTS,
                                                    written)
                           : status;
}

void stage_adaptive_set(void)
{
    fr_adaptive_set_config config = fr_adaptive_set_defaults();
    config.rate_hz = RATE_HZ;
    RUN(adaptive_set, config, push_adaptive_set);
}

static fr_status push_adaptive(void *object, size_t count, size_t *written)
{
    return fr_adaptive_push((fr_adaptive *)object, now.force, now.height, now.counts, count, out,
                            beside, POINTS, written);
}

/* `held_ms`: for how long the cut-off is held, 0 for each sample its own. */
static void try_adaptive(int32_t tangent, uint32_t held_ms)
{
    fr_adaptive_config config = fr_adaptive_defaults();
    config.travel.rate_hz = RATE_HZ;
    config.travel.metres_per_count = COUNT_M;
    config.interval_m = INTERVAL_M;
    config.tangent = tangent;
    config.cut_off_every = held_ms == 0u ? 1 : (int32_t)(held_ms * now.rate / 1000u);
    RUN(adaptive, config, push_adaptive);
}

void stage_adaptive(void)
{
    try_adaptive(FR_TANGENT_EXACT, 0u);
}

void stage_adaptive_short(void)
{
    try_adaptive(FR_TANGENT_SHORT, 0u);
}

void stage_adaptive_held_4_ms(void)
{
    try_adaptive(FR_TANGENT_EXACT, 4u);
}

/* The end of a run: the backward pass over its points, in one call. Its samples are points. */
void stage_adaptive_end(void)
{
    fr_adaptive_config config = fr_adaptive_defaults();
    fr_adaptive *object = NULL;
    size_t piece = now.rate / 100u, points = 0, written = 0;
    uint32_t begin, ticks;
    config.travel.rate_hz = RATE_HZ;
    config.travel.metres_per_count = COUNT_M;
    config.interval_m = INTERVAL_M;
    (void)fr_adaptive_init(memory, sizeof memory, &config, &object);
    for (int k = 0; k < warm_pieces() + timed_pieces() && points < POINTS - MOST; k++) {
        signals_next(&now, piece);
        (void)fr_adaptive_push(object, now.force, now.height, now.counts, piece, out + points,
                               beside + points, POINTS - points, &written);
        points += written;
    }
    begin = board_ticks();
    if (fr_adaptive_finish(object, out, beside, points, out, POINTS, &written) != FR_OK)
        board_put("refused\n");
    ticks = since(begin);
    put_costs(fr_adaptive_size(&config), points, ticks, ticks);
    put_bits(written, out);
}
