/* SPDX-License-Identifier: Apache-2.0
 *
 * What samples are to be trusted: searches of the screening, what is usual, and causes of points.
 */
#include "stages.h"

static uint8_t causes_of_points[POINTS];

static fr_span many[POINTS];

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

static fr_status push_saturation(void *object, size_t count, size_t *written)
{
    return fr_saturation_push((fr_saturation *)object, now.force, count, many, POINTS, written);
}

/* A start of 0.3 s has filled what is looked ahead. */
void stage_saturation(void)
{
    fr_saturation_config config = fr_saturation_defaults();
    config.range_least = -20.0;
    config.range_greatest = 40.0;
    RUN(saturation, config, push_saturation);
}

static fr_status push_encoder_screening(void *object, size_t count, size_t *written)
{
    return fr_encoder_screening_push((fr_encoder_screening *)object, now.counts, count, many,
                                     POINTS, written);
}

void stage_encoder_screening(void)
{
    fr_encoder_screening_config config = fr_encoder_screening_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    RUN(encoder_screening, config, push_encoder_screening);
}

static fr_status push_usual(void *object, size_t count, size_t *written)
{
    *written = 0u;
    return fr_usual_push((fr_usual *)object, now.height, count);
}

static fr_status push_usual_counts(void *object, size_t count, size_t *written)
{
    *written = 0u;
    return fr_usual_push_counts((fr_usual *)object, now.counts, count);
}

/* The values are asked for at the end, which is not timed. */
static void try_usual(push_of push)
{
    fr_usual_config config = fr_usual_defaults();
    fr_usual *usual = NULL;
    fr_usual_values values;
    (void)fr_usual_init(memory, sizeof memory, &config, &usual);
    (void)run_pieces(usual, fr_usual_size(&config), push);
    if (fr_usual_value(usual, &values) != FR_OK)
        board_put("refused\n");
    out[0] = (fr_real)values.off_neighbours;
    out[1] = (fr_real)values.rise;
    put_bits(2u, out);
}

void stage_usual(void)
{
    try_usual(push_usual);
}

void stage_usual_counts(void)
{
    try_usual(push_usual_counts);
}

static fr_status push_causes(void *object, size_t count, size_t *written)
{
    fr_status status = fr_causes_push((fr_causes *)object, now.counts, NULL, count,
                                      causes_of_points, POINTS, written);
    for (size_t i = 0; i < *written; i++)
        out[i] = (fr_real)causes_of_points[i];
    return status;
}

static void try_causes(int32_t every)
{
    fr_causes_config config = fr_causes_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    config.interval_m = INTERVAL_M;
    config.every = every;
    RUN(causes, config, push_causes);
}

void stage_causes(void)
{
    try_causes(1);
}

/* A thousand looks at the counts in a second. */
void stage_causes_every_ms(void)
{
    try_causes((int32_t)(now.rate / 1000u));
}
