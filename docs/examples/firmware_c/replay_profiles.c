#include "replay.h"

#define COUNT_M 1e-6 /* the distances of the vectors are written to this */
#define TICK_S 0.01  /* and their times */

static fr_real z[MOST_SAMPLES], v[MOST_SAMPLES], h[MOST_SAMPLES], steps[MOST_SAMPLES];

static fr_status speeds(const double *s, const struct signals *in, struct signals *out)
{
    fr_travel_speed_config config = {s[0], COUNT_M, s[1], FR_BACK_REFUSED};
    fr_travel_speed *travel;
    size_t n = load(in);
    load_counts(in->samples[0], n, COUNT_M);
    TRY(MAKE(0, travel_speed, &config, &travel));
    TRY(fr_travel_speed_push(travel, counts, n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status projected(const double *s, const struct signals *in, struct signals *out)
{
    fr_projection_config config = {s[0], COUNT_M, 0.0};
    fr_projection *projection;
    size_t n = load(in);
    load_counts(in->samples[0], n, COUNT_M);
    TRY(MAKE(0, projection, &config, &projection));
    TRY(fr_projection_push(projection, counts, x[1], n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status time_steps(const double *s, const struct signals *in, struct signals *out)
{
    fr_time_step_config config = {TICK_S};
    fr_time_step *timer;
    size_t n = load(in);
    (void)s;
    load_counts(in->samples[0], n, TICK_S);
    TRY(MAKE(0, time_step, &config, &timer));
    TRY(fr_time_step_push(timer, counts, n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status temporal(const double *s, const struct signals *in, struct signals *out)
{
    fr_adaptive_config config = fr_adaptive_defaults();
    fr_adaptive *adaptive;
    size_t n = load(in);
    config.travel.rate_hz = s[0];
    config.travel.metres_per_count = COUNT_M;
    config.interval_m = s[1];
    load_counts(in->samples[2], n, COUNT_M);
    TRY(MAKE(0, adaptive, &config, &adaptive));
    TRY(fr_adaptive_push(adaptive, x[0], x[1], counts, n, y, z, MOST_SAMPLES, &made));
    TRY(fr_adaptive_finish(adaptive, y, z, made, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

/* 5.10: force and height at the points, timer distortion, the set, reflection, backward. */
static fr_status spatial(const double *s, const struct signals *in, struct signals *out)
{
    fr_projection_config points = {s[1], COUNT_M, s[0]};
    fr_timer_distortion_config timer = fr_timer_distortion_defaults();
    fr_high_pass_set_config filters = {s[1], 1.0 / 105.91, FR_MISSING_REFUSED};
    fr_integral_config sum = fr_integral_defaults();
    fr_projection *projection;
    fr_high_pass_set *set;
    fr_integral *first, *second;
    size_t n = load(in);
    load_counts(in->samples[2], n, COUNT_M);
    timer.interval_m = s[1];
    TRY(MAKE(0, projection, &points, &projection));
    TRY(fr_projection_push_timed(projection, counts, x[0], n, v, steps, MOST_SAMPLES, &made));
    TRY(MAKE(0, projection, &points, &projection));
    TRY(fr_projection_push_timed(projection, counts, x[1], n, h, steps, MOST_SAMPLES, &made));
    n = made;
    TRY(fr_timer_distortion_steps(&timer, steps, n, z, MOST_SAMPLES, &made));
    TRY(MAKE(1, high_pass_set, &filters, &set));
    TRY(MAKE(2, integral, &sum, &first));
    TRY(MAKE(3, integral, &sum, &second));
    TRY(fr_high_pass_set_acceleration(set, v, n, v, MOST_SAMPLES, &made));
    TRY(fr_integral_push_steps(first, v, z, n, v, MOST_SAMPLES, &made));
    TRY(fr_high_pass_set_velocity(set, v, n, v, MOST_SAMPLES, &made));
    TRY(fr_high_pass_set_height(set, h, n, h, MOST_SAMPLES, &made));
    TRY(fr_integral_push_reflecting(second, v, h, z, steps, n, y, MOST_SAMPLES, &made));
    for (size_t k = 0; k < n; k++)
        y[k] -= h[k];
    TRY(fr_high_pass_set_reverse(set, y, n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status roughness(const double *s, const struct signals *in, struct signals *out)
{
    fr_iri_config config = fr_iri_defaults();
    fr_iri *iri;
    fr_real m_per_km;
    size_t n = load(in), first;
    config.interval_m = s[0];
    TRY(MAKE(0, iri, &config, &iri));
    TRY(fr_iri_push(iri, x[0], n, y, MOST_SAMPLES, &first));
    TRY(fr_iri_finish(iri, y + first, MOST_SAMPLES - first, &made));
    TRY(fr_iri_value(iri, &m_per_km));
    (void)store(out, 1, &m_per_km, 1);
    return store(out, 0, y, first + made);
}

static fr_status agreement(const double *s, const struct signals *in, struct signals *out)
{
    fr_cross_correlation_config config = {s[0], s[1]};
    fr_agreement found;
    size_t n = load(in);
    TRY(fr_cross_correlation(&config, x[0], x[1], n, &found));
    out->samples[0][0] = found.cross_correlation;
    out->samples[1][0] = found.correlation;
    out->samples[2][0] = found.amplitude_factor;
    out->samples[3][0] = found.offset_m;
    for (int i = 0; i < 4; i++)
        out->count[i] = 1;
    return FR_OK;
}

static fr_status for_display(const double *s, const struct signals *in, struct signals *out)
{
    fr_high_pass_profile_config config = {s[0], s[1]};
    size_t n = load(in);
    TRY(fr_high_pass_profile(&config, x[0], n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status validity(const double *s, const struct signals *in, struct signals *out)
{
    fr_validity_config config = {s[0], s[1], s[2], s[3], s[4], s[5]};
    uint8_t causes[MOST_SAMPLES] = {0};
    size_t n = load(in);
    for (size_t k = 0; k < n; k++)
        causes[k] = (uint8_t)in->samples[0][k];
    TRY(fr_validity(&config, causes, n, causes, MOST_SAMPLES, &made));
    for (size_t k = 0; k < n; k++)
        y[k] = (fr_real)causes[k];
    return store(out, 0, y, made);
}

const struct stage PROFILE_STAGES[] = {
    {"travel-speed", {"rate_hz", "window_s"}, {"distance"}, {"speed"}, speeds},
    {"projection", {"interval_m"}, {"distance", "x"}, {"y"}, projected},
    {"time-step", {0}, {"time"}, {"time_step"}, time_steps},
    {"adaptive-hpf-spatial-backward",
     {"rate_hz", "interval_m"},
     {"acceleration", "height", "distance"},
     {"elevation"},
     temporal},
    {"timer-distortion-reflection",
     {"rate_hz", "interval_m"},
     {"acceleration", "height", "distance"},
     {"elevation"},
     spatial},
    {"iri", {"interval_m"}, {"elevation"}, {"trace", "iri"}, roughness},
    {"cross-correlation",
     {"interval_m", "max_offset_m"},
     {"p", "q"},
     {"cross_correlation", "correlation", "amplitude_factor", "offset_m"},
     agreement},
    {"high-pass", {"interval_m", "wavelength_m"}, {"elevation"}, {"filtered"}, for_display},
    {"validity",
     {"interval_m", "drift_m", "run_in_m", "before_slow_m", "after_slow_m", "after_braking_m"},
     {"flags"},
     {"valid"},
     validity},
    {NULL, {0}, {0}, {0}, NULL},
};
