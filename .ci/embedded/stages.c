/* SPDX-License-Identifier: Apache-2.0
 *
 * Each stage of the library with the settings of the pages, pushed in pieces of 10 ms. STAGE names
 * the one that an image has; the linker leaves out the others. A line says the bytes of the object,
 * the samples that were timed and the ticks that they took, and a line the bits of some outputs.
 */
#include <string.h>

#include "board.h"
#include "signals.h"

#ifndef STAGE
#error "STAGE is the name of a function below"
#endif

#define RATE_HZ ((double)now.rate)
#define COUNT_M 0.001
#define INTERVAL_M 0.025
#define MEMORY 65536
/* Pieces before the clock, which are longer than any start, and with it. */
#ifndef WARM
#define WARM 30
#define TIMED 100
#endif
enum { POINTS = 1024, SHOWN = 16 };

static signals now;
static uint64_t memory[MEMORY / 8];
static fr_real out[POINTS], beside[POINTS];
static fr_span spans[8];

/* One push of `count` samples; the status. */
typedef fr_status (*push_of)(void *object, size_t count, size_t *written);

void board_put_number(uint64_t number)
{
    char text[24], *at = text + sizeof text - 1;
    *at = '\0';
    do
        *--at = (char)('0' + (int)(number % 10u));
    while ((number /= 10u) != 0u);
    board_put(at);
}

static void put_bits(fr_real x)
{
    uint64_t bits = 0;
    char text[18] = " ";
    (void)memcpy(&bits, &x, sizeof x);
    for (size_t i = 0; i < 2u * sizeof x; i++) {
        text[2u * sizeof x - i] = "0123456789abcdef"[bits & 15u];
        bits >>= 4;
    }
    text[2u * sizeof x + 1u] = '\0';
    board_put(text);
}

static void put_outputs(size_t written)
{
    board_put("bits");
    for (size_t i = 0; i < SHOWN && i < written; i++)
        put_bits(out[written - 1u - i]);
    board_put("\n");
}

static uint32_t since(uint32_t begin)
{
    return (begin - board_ticks()) & 0x00FFFFFFu;
}

static void put_costs(size_t bytes, uint64_t samples, uint64_t ticks)
{
    board_put("rate ");
    board_put_number(now.rate);
    board_put(" bytes ");
    board_put_number(bytes);
    board_put(" samples ");
    board_put_number(samples);
    board_put(" ticks ");
    board_put_number(ticks);
    board_put("\n");
}

/* Push pieces, untimed until the start is over, and report. */
static void try_pieces(void *object, size_t bytes, push_of push)
{
    size_t piece = now.rate / 100u, written = 0;
    uint64_t ticks = 0;
    for (int k = 0; k < WARM + TIMED; k++) {
        uint32_t begin, taken;
        fr_status status;
        signals_next(&now, piece);
        begin = board_ticks();
        status = push(object, piece, &written);
        taken = since(begin);
        if (status != FR_OK)
            board_put("refused\n");
        ticks += k < WARM ? 0u : taken;
    }
    put_costs(bytes, (uint64_t)TIMED * piece, ticks);
    put_outputs(written);
}

/* Place an object of `kind` in the memory and run it; `config` is set before. */
#define RUN(kind, config, push)                                                            \
    do {                                                                                   \
        fr_##kind *object = NULL;                                                          \
        if (fr_##kind##_init(memory, sizeof memory, &(config), &object) != FR_OK)          \
            board_put("not possible\n");                                                   \
        else                                                                               \
            try_pieces(object, fr_##kind##_size(&(config)), push);                                \
    } while (0)

/* A push of one input and one output as a push_of. */
#define PUSH(kind, ...)                                                                    \
    static fr_status push_##kind(void *object, size_t count, size_t *written)              \
    {                                                                                      \
        return fr_##kind##_push((fr_##kind *)object, __VA_ARGS__, count, out, POINTS, written); \
    }

PUSH(filter, now.force)
PUSH(varying, now.force, now.cutoff)
PUSH(integral, now.force)
PUSH(travel_speed, now.counts)
PUSH(projection, now.counts, now.force)
PUSH(local_suppression, now.force, now.speed)
PUSH(matched_high_pass, now.force, now.height, now.cutoff)
PUSH(iri, now.height)

/* The harness itself, an empty push. */
static fr_status push_nothing(void *object, size_t count, size_t *written)
{
    (void)object;
    *written = 0u * count;
    return FR_OK;
}

void stage_nothing(void)
{
    try_pieces(NULL, 0u, push_nothing);
}

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

void stage_integral(void)
{
    fr_integral_config config = fr_integral_defaults();
    config.step_s = 1.0 / RATE_HZ;
    RUN(integral, config, push_integral);
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

static fr_status push_distortion(void *object, size_t count, size_t *written)
{
    return fr_timer_distortion_steps((fr_timer_distortion_config *)object, now.step, count, out,
                                     POINTS, written);
}

void stage_timer_distortion(void)
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

void stage_projection(void)
{
    fr_projection_config config = fr_projection_defaults();
    config.interval_m = INTERVAL_M;
    config.metres_per_count = COUNT_M;
    RUN(projection, config, push_projection);
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

static fr_status push_screening(void *object, size_t count, size_t *written)
{
    return fr_screening_push((fr_screening *)object, now.height, now.force, now.counts, count,
                             spans, sizeof spans / sizeof spans[0], written);
}

void stage_screening(void)
{
    fr_screening_config config = fr_screening_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    RUN(screening, config, push_screening);
}

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
    for (int k = 0; k < WARM + TIMED && points < POINTS - MOST; k++) {
        signals_next(&now, piece);
        (void)fr_adaptive_push(object, now.force, now.height, now.counts, piece, out + points,
                               beside + points, POINTS - points, &written);
        points += written;
    }
    begin = board_ticks();
    if (fr_adaptive_finish(object, out, beside, points, out, POINTS, &written) != FR_OK)
        board_put("refused\n");
    ticks = since(begin);
    put_costs(fr_adaptive_size(&config), points, ticks);
    put_outputs(written);
}

void measure(void)
{
    static const uint32_t rates[] = {4000u, 16000u};
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        (void)memset(&now, 0, sizeof now);
        now.rate = rates[i];
        STAGE();
    }
}
