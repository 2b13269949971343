/* SPDX-License-Identifier: Apache-2.0
 *
 * Stages of samples, and of points with the time between them, with the settings of the pages.
 */
#include "stages.h"

PUSH(filter, now.force)
PUSH(varying, now.force, now.cutoff)
PUSH(integral, now.force)
PUSH(travel_speed, now.counts)
PUSH(projection, now.counts, now.force)
PUSH(local_suppression, now.force, now.speed)
PUSH(matched_high_pass, now.force, now.height, now.cutoff)
PUSH(iri, now.height)

static void try_filter(int32_t order, int32_t passes)
{
    fr_filter_config config = fr_filter_defaults();
    config.step = 1.0 / RATE_HZ;
    config.cutoff = 0.45;
    config.order = order;
    config.passes = passes;
    RUN(filter, config, push_filter);
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
    RUN(varying, config, push_varying);
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
    try_integral(push_integral);
}

static fr_status push_integral_steps(void *object, size_t count, size_t *written)
{
    return fr_integral_push_steps((fr_integral *)object, now.force, now.step, count, out, POINTS,
                                  written);
}

void stage_integral_steps(void)
{
    try_integral(push_integral_steps);
}

static fr_status push_integral_reflecting(void *object, size_t count, size_t *written)
{
    return fr_integral_push_reflecting((fr_integral *)object, now.force, now.height, now.cutoff,
                                       now.step, count, out, POINTS, written);
}

void stage_integral_reflecting(void)
{
    try_integral(push_integral_reflecting);
}

void stage_travel_speed(void)
{
    fr_travel_speed_config config = fr_travel_speed_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    RUN(travel_speed, config, push_travel_speed);
}

static fr_status push_cut_off(void *object, size_t count, size_t *written)
{
    return fr_cut_off_frequency((fr_cut_off_config *)object, now.speed, count, out, POINTS, written);
}

void stage_cut_off_frequency(void)
{
    fr_cut_off_config config = fr_cut_off_defaults();
    try_pieces(&config, 0u, push_cut_off);
}

static fr_status push_wave_number(void *object, size_t count, size_t *written)
{
    return fr_cut_off_wave_number((fr_cut_off_config *)object, INTERVAL_M, now.speed, count, out,
                                  POINTS, written);
}

void stage_cut_off_wave_number(void)
{
    fr_cut_off_config config = fr_cut_off_defaults();
    try_pieces(&config, 0u, push_wave_number);
}

static fr_status push_distortion(void *object, size_t count, size_t *written)
{
    return fr_timer_distortion_steps((fr_timer_distortion_config *)object, now.step, count, out,
                                     POINTS, written);
}

void stage_timer_distortion_steps(void)
{
    fr_timer_distortion_config config = fr_timer_distortion_defaults();
    config.interval_m = INTERVAL_M;
    try_pieces(&config, 0u, push_distortion);
}

void stage_local_suppression(void)
{
    fr_local_suppression_config config = fr_local_suppression_defaults();
    config.rate_hz = RATE_HZ;
    RUN(local_suppression, config, push_local_suppression);
}

static void try_matched(int32_t tangent)
{
    fr_matched_high_pass_config config = fr_matched_high_pass_defaults();
    config.rate_hz = RATE_HZ;
    config.tangent = tangent;
    RUN(matched_high_pass, config, push_matched_high_pass);
}

void stage_matched_high_pass(void)
{
    try_matched(FR_TANGENT_EXACT);
}

void stage_matched_high_pass_short(void)
{
    try_matched(FR_TANGENT_SHORT);
}

static fr_status push_projection_timed(void *object, size_t count, size_t *written)
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
    try_projection(0.0, push_projection);
}

void stage_projection_timed(void)
{
    try_projection(RATE_HZ, push_projection_timed);
}

static fr_status push_time_step(void *object, size_t count, size_t *written)
{
    return fr_time_step_push((fr_time_step *)object, now.counts, count, out, POINTS, written);
}

void stage_time_step(void)
{
    fr_time_step_config config = fr_time_step_defaults();
    config.seconds_per_tick = 1e-6;
    RUN(time_step, config, push_time_step);
}

/* Its samples are points. */
void stage_iri(void)
{
    fr_iri_config config = fr_iri_defaults();
    config.interval_m = INTERVAL_M;
    RUN(iri, config, push_iri);
}
