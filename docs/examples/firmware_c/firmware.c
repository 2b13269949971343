/* A profiler's firmware on libfloatref: from samples to a profile, and what of it is valid. */
#include "firmware.h"

#include <math.h>

static const double ANTI_ALIAS_HZ = 1000.0, ANTI_ALIAS_FROM_HZ = 4000.0;

/* Before a run: what a data sheet would say of range, step, hold and noise of a sensor. */
fr_status learn(struct sensor *sensor, const struct samples *s)
{
    const fr_real missing = (fr_real)NAN;
    const fr_usual_config config = fr_usual_defaults();
    fr_status status = sensor->usual == NULL ? MAKE(usual, &config, &sensor->usual) : FR_OK;
    if (status != FR_OK)
        return status;
    if (sensor->quantity == DISTANCE && s->count > 0)
        return fr_usual_push_counts(sensor->usual, s->counts, s->count);
    status = fr_usual_push(sensor->usual, s->count > 0 ? s->x : &missing, s->count > 0 ? s->count : 1);
    return status != FR_OK || s->count > 0 ? status : fr_usual_value(sensor->usual, &sensor->values);
}

static fr_status begin_screening(struct sensor *sensor)
{
    double rate_hz = sensor->rate_hz, count_m = sensor->metres_per_count;
    fr_encoder_screening_config encoder = fr_encoder_screening_defaults();
    fr_saturation_config range = fr_saturation_of(&sensor->values);
    fr_screening_config stays = sensor->quantity == HEIGHT
                                    ? fr_screening_of_height(rate_hz, count_m, &sensor->values)
                                    : fr_screening_of_force(rate_hz, count_m, &sensor->values);
    encoder.rate_hz = 1e9;
    encoder.metres_per_count = count_m;
    encoder.usual_m = sensor->values.rise * count_m;
    if (sensor->quantity == DISTANCE)
        return MAKE(encoder_screening, &encoder, &sensor->encoder);
    fr_status status = MAKE(screening, &stays, &sensor->screening);
    if (status != FR_OK || sensor->quantity != VERTICAL_SPECIFIC_FORCE)
        return status;
    return MAKE(saturation, &range, &sensor->saturation);
}

/* Screening: stretches of samples that measure nothing. */
fr_status screen(struct sensor *sensor, const struct samples *s, fr_span *spans, size_t *found)
{
    size_t n = s->count, more = 0;
    const fr_real *force = sensor->quantity == HEIGHT ? s->force : NULL;
    bool begun = sensor->encoder != NULL || sensor->screening != NULL;
    fr_status status = begun ? FR_OK : begin_screening(sensor);
    if (status == FR_OK && sensor->encoder != NULL)
        return n > 0 ? fr_encoder_screening_push_timed(sensor->encoder, s->counts, s->nanoseconds, n,
                                                       spans, MOST_SPANS, found)
                     : fr_encoder_screening_finish(sensor->encoder, spans, MOST_SPANS, found);
    if (status == FR_OK)
        status = n > 0 ? fr_screening_push(sensor->screening, s->x, force, s->counts, n, spans,
                                           MOST_SPANS, found)
                       : fr_screening_finish(sensor->screening, spans, MOST_SPANS, found);
    if (status != FR_OK || sensor->saturation == NULL)
        return status;
    size_t room = MOST_SPANS - *found;
    status = n > 0 ? fr_saturation_push(sensor->saturation, s->x, n, spans + *found, room, &more)
                   : fr_saturation_finish(sensor->saturation, spans + *found, room, &more);
    *found += more;
    return status;
}

#ifndef STAGE_road_prior /* that is in firmware_road_prior.c */
/* The stage. STAGE=basic is a conventional engine, whose cut-off follows the speed down to zero. */
fr_status stage_begin(struct path *path)
{
    fr_adaptive_config config = fr_adaptive_defaults();
    config.travel.rate_hz = path->rate_hz;
    config.travel.metres_per_count = path->metres_per_count;
    config.travel.back = FR_BACK_TAKEN;
    config.interval_m = path->interval_m;
    config.gravity_mps2 = 9.80665;
    config.missing = FR_MISSING_BRIDGED;
#ifdef STAGE_basic
    config.cut_off = (fr_cut_off_config){1e-6, config.cut_off.wavelength_m, 1e-3, 1e3};
#endif
    return MAKE(adaptive, &config, &path->stage);
}

fr_status stage_take(struct path *path, fr_real *force, fr_real *height, const int64_t *counts, size_t n)
{
    size_t made, k = path->count;
    return fr_adaptive_push(path->stage, force, height, counts, n, path->elevation + k,
                            path->speed + k, path->room - k, &made);
}

fr_status stage_end(struct path *path)
{
    return fr_adaptive_finish(path->stage, path->elevation, path->speed, path->count,
                              path->elevation, path->room, &path->count);
}
#endif

static fr_status low_passes(struct path *path)
{
    fr_filter_config config = fr_filter_defaults();
    config.step = 1.0 / path->rate_hz;
    config.cutoff = ANTI_ALIAS_HZ;
    config.passes = FR_LOW_PASS;
    for (int i = 0; path->rate_hz > ANTI_ALIAS_FROM_HZ && i < 4; i++) {
        config.order = 1 + i % 2;
        TRY(MAKE(filter, &config, &path->low_pass[i]));
    }
    return FR_OK;
}

fr_status begin(struct path *path)
{
    fr_causes_config config = fr_causes_defaults();
    path->validity = fr_validity_defaults();
    path->validity.interval_m = config.interval_m = path->interval_m;
    TRY(low_passes(path));
    TRY(stage_begin(path));
    config.rate_hz = path->rate_hz;
    config.metres_per_count = path->metres_per_count;
    config.every = path->through_stops ? INT32_MAX : 1; /* else slow travel and brakes are causes */
    return MAKE(causes, &config, &path->causes);
}

/* A chunk of samples: both sensors lose the same above 1000 Hz, then the causes and the stage. */
fr_status take(struct path *path, fr_real *force, fr_real *height, const int64_t *counts,
               const uint8_t *causes, size_t n)
{
    size_t made, room = path->room - path->count;
    for (size_t i = 0; BROKEN == 1 && i < n; i++)
        height[i] = -height[i];
    for (int i = 0; path->low_pass[0] != NULL && i < 4; i++) {
        fr_real *x = i < 2 ? force : height;
        TRY(fr_filter_push(path->low_pass[i], x, n, x, n, &made));
    }
    path->of_samples = causes;
    TRY(stage_take(path, force, height, counts, n));
    TRY(fr_causes_push(path->causes, counts, causes, n, path->valid + path->count, room, &made));
    path->count += made;
    return FR_OK;
}

/* The end of a run: the backward passes, and what is valid. */
fr_status end(struct path *path)
{
    size_t made;
    TRY(fr_causes_finish(path->causes, path->valid, path->count));
    TRY(stage_end(path));
    TRY(fr_validity(&path->validity, path->valid, path->count, path->valid, path->room, &made));
    for (size_t i = 0; BROKEN == 2 && i < path->count; i++)
        path->valid[i] = 1;
    return FR_OK;
}
