/* SPDX-License-Identifier: Apache-2.0
 *
 * Stages of samples, and of points with the time between them, with the settings of the pages.
 */
#include "stages.h"

PUSH(filter_push, fr_filter, now.force)
PUSH(varying_push, fr_varying, now.force, now.cutoff)
PUSH(integral_push, fr_integral, now.force)
PUSH(integral_push_steps, fr_integral, now.force, now.step)
PUSH(integral_push_reflecting, fr_integral, now.force, now.height, now.cutoff, now.step)
PUSH(travel_speed_push, fr_travel_speed, now.counts)
PUSH(cut_off_frequency, fr_cut_off_config, now.speed)
PUSH(cut_off_wave_number, fr_cut_off_config, INTERVAL_M, now.speed)
PUSH(timer_distortion_steps, fr_timer_distortion_config, now.step)
PUSH(local_suppression_push, fr_local_suppression, now.force, now.speed)
PUSH(matched_high_pass_push, fr_matched_high_pass, now.force, now.height, now.cutoff)
PUSH(projection_push, fr_projection, now.counts, now.force)
PUSH(time_step_push, fr_time_step, now.counts)
PUSH(iri_push, fr_iri, now.height)

static void try_filter(int32_t order, int32_t passes)
{
    fr_filter_config config = fr_filter_defaults();
    config.step = 1.0 / RATE_HZ;
    config.cutoff = 0.45;
    config.order = order;
    config.passes = passes;
    RUN(filter, config, filter_push);
}

void stage_filter_high_pass_1(void)
{
    try_filter(1, FR_HIGH_PASS);
}

void stage_filter_high_pass_2(void)
{
    try_filter(2, FR_HIGH_PASS);
}

void stage_filter_low_pass_2(void)
{
    try_filter(2, FR_LOW_PASS);
}

static void try_varying(int32_t sections, int32_t tangent)
{
    fr_varying_config config = fr_varying_defaults();
    config.step = 1.0 / RATE_HZ;
    config.sections = sections;
    config.tangent = tangent;
    RUN(varying, config, varying_push);
}

void stage_varying_1(void)
{
    try_varying(FR_SECTION_1, FR_TANGENT_EXACT);
}

void stage_varying_2(void)
{
    try_varying(FR_SECTION_2, FR_TANGENT_EXACT);
}

void stage_varying_12(void)
{
    try_varying(FR_SECTION_12, FR_TANGENT_EXACT);
}

void stage_varying_12_short(void)
{
    try_varying(FR_SECTION_12, FR_TANGENT_SHORT);
}

static void try_integral(push_of push)
{
    fr_integral_config config = fr_integral_defaults();
    config.step_s = 1.0 / RATE_HZ;
    RUN(integral, config, push);
}

void stage_integral(void)
{
    try_integral(integral_push);
}

void stage_integral_steps(void)
{
    try_integral(integral_push_steps);
}

void stage_integral_reflecting(void)
{
    try_integral(integral_push_reflecting);
}

void stage_travel_speed(void)
{
    fr_travel_speed_config config = fr_travel_speed_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    RUN(travel_speed, config, travel_speed_push);
}

void stage_cut_off_frequency(void)
{
    fr_cut_off_config config = fr_cut_off_defaults();
    try_pieces(&config, 0u, cut_off_frequency);
}

void stage_cut_off_wave_number(void)
{
    fr_cut_off_config config = fr_cut_off_defaults();
    try_pieces(&config, 0u, cut_off_wave_number);
}

void stage_timer_distortion_steps(void)
{
    fr_timer_distortion_config config = fr_timer_distortion_defaults();
    config.interval_m = INTERVAL_M;
    try_pieces(&config, 0u, timer_distortion_steps);
}

void stage_local_suppression(void)
{
    fr_local_suppression_config config = fr_local_suppression_defaults();
    config.rate_hz = RATE_HZ;
    RUN(local_suppression, config, local_suppression_push);
}

static void try_matched(int32_t tangent)
{
    fr_matched_high_pass_config config = fr_matched_high_pass_defaults();
    config.rate_hz = RATE_HZ;
    config.tangent = tangent;
    RUN(matched_high_pass, config, matched_high_pass_push);
}

void stage_matched_high_pass(void)
{
    try_matched(FR_TANGENT_EXACT);
}

void stage_matched_high_pass_short(void)
{
    try_matched(FR_TANGENT_SHORT);
}

static fr_status projection_push_timed(void *object, size_t count, size_t *written)
{
    return fr_projection_push_timed((fr_projection *)object, now.counts, now.force, count, out,
                                    beside, POINTS, written);
}

static void try_projection(double rate_hz, push_of push)
{
    fr_projection_config config = fr_projection_defaults();
    config.interval_m = INTERVAL_M;
    config.metres_per_count = COUNT_M;
    config.rate_hz = rate_hz;
    RUN(projection, config, push);
}

void stage_projection(void)
{
    try_projection(0.0, projection_push);
}

void stage_projection_timed(void)
{
    try_projection(RATE_HZ, projection_push_timed);
}

void stage_time_step(void)
{
    fr_time_step_config config = fr_time_step_defaults();
    config.seconds_per_tick = 1e-6;
    RUN(time_step, config, time_step_push);
}

/* Its samples are points. */
void stage_iri(void)
{
    fr_iri_config config = fr_iri_defaults();
    config.interval_m = INTERVAL_M;
    RUN(iri, config, iri_push);
}
