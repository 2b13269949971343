#include "replay.h"

/* Settings {step, cutoff}. */
#define FIXED(name, order_, passes_, direction_)                                                   \
    static fr_status name(const double *s, const struct signals *in, struct signals *out)          \
    {                                                                                              \
        fr_filter_config config = {s[0], s[1], order_, passes_, direction_, FR_MISSING_REFUSED};   \
        fr_filter *filter;                                                                         \
        size_t n = load(in);                                                                       \
        TRY(MAKE(0, filter, &config, &filter));                                                    \
        TRY(fr_filter_push(filter, x[0], n, y, MOST_SAMPLES, &made));                                      \
        return store(out, 0, y, made);                                                             \
    }

/* Settings {step}, and the cut-off of every sample. */
#define VARYING(name, sections_, form_, direction_)                                                \
    static fr_status name(const double *s, const struct signals *in, struct signals *out)          \
    {                                                                                              \
        fr_varying_config config = fr_varying_defaults();                                          \
        fr_varying *filter;                                                                        \
        size_t n = load(in);                                                                       \
        config.step = s[0];                                                                        \
        config.sections = sections_;                                                               \
        config.form = form_;                                                                       \
        config.direction = direction_;                                                             \
        TRY(MAKE(0, varying, &config, &filter));                                                   \
        TRY(fr_varying_push(filter, x[0], x[1], n, y, MOST_SAMPLES, &made));                               \
        return store(out, 0, y, made);                                                             \
    }

FIXED(low_1, 1, FR_LOW_PASS, FR_FORWARD)
FIXED(low_2, 2, FR_LOW_PASS, FR_FORWARD)
FIXED(low_1_back, 1, FR_LOW_PASS, FR_BACKWARD)
FIXED(low_2_back, 2, FR_LOW_PASS, FR_BACKWARD)
FIXED(high_1, 1, FR_HIGH_PASS, FR_FORWARD)
FIXED(high_2, 2, FR_HIGH_PASS, FR_FORWARD)
FIXED(high_1_back, 1, FR_HIGH_PASS, FR_BACKWARD)
FIXED(high_2_back, 2, FR_HIGH_PASS, FR_BACKWARD)
VARYING(varying_1, FR_SECTION_1, FR_RECURSION, FR_FORWARD)
VARYING(varying_2, FR_SECTION_2, FR_RECURSION, FR_FORWARD)
VARYING(varying_1_back, FR_SECTION_1, FR_RECURSION, FR_BACKWARD)
VARYING(varying_2_back, FR_SECTION_2, FR_RECURSION, FR_BACKWARD)
VARYING(state_1_back, FR_SECTION_1, FR_STATES, FR_BACKWARD)
VARYING(state_2_back, FR_SECTION_2, FR_STATES, FR_BACKWARD)

static fr_status trapezoids(const double *s, const struct signals *in, struct signals *out)
{
    fr_integral_config config = {s[0], s[1], FR_MISSING_REFUSED};
    fr_integral *integral;
    size_t n = load(in);
    TRY(MAKE(0, integral, &config, &integral));
    TRY(fr_integral_push(integral, x[0], n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status over_points(const double *s, const struct signals *in, struct signals *out)
{
    fr_integral_config config = fr_integral_defaults();
    fr_integral *integral;
    size_t n = load(in);
    (void)s;
    TRY(MAKE(0, integral, &config, &integral));
    TRY(fr_integral_push_steps(integral, x[0], x[1], n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status reflected(const double *s, const struct signals *in, struct signals *out)
{
    fr_integral_config config = fr_integral_defaults();
    fr_integral *integral;
    size_t n = load(in);
    (void)s;
    TRY(MAKE(0, integral, &config, &integral));
    TRY(fr_integral_push_reflecting(integral, x[0], x[1], x[2], x[3], n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status cutoffs(const double *s, const struct signals *in, struct signals *out)
{
    static fr_real z[MOST_SAMPLES];
    fr_cut_off_config config = {s[0], s[1], s[2], s[3]};
    size_t n = load(in);
    TRY(fr_cut_off_frequency(&config, x[0], n, y, MOST_SAMPLES, &made));
    TRY(fr_cut_off_wave_number(&config, s[4], x[0], n, z, MOST_SAMPLES, &made));
    (void)store(out, 0, y, n);
    return store(out, 1, z, n);
}

static fr_status suppressed(const double *s, const struct signals *in, struct signals *out)
{
    fr_local_suppression_config config = {s[0], s[1], s[2], s[3], FR_MISSING_REFUSED};
    fr_local_suppression *control;
    size_t n = load(in);
    TRY(MAKE(0, local_suppression, &config, &control));
    TRY(fr_local_suppression_push(control, x[0], x[1], n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status distorted(const double *s, const struct signals *in, struct signals *out)
{
    fr_timer_distortion_config config = {s[0], s[1], s[2]};
    size_t n = load(in);
    TRY(fr_timer_distortion_steps(&config, x[0], n, y, MOST_SAMPLES, &made));
    return store(out, 0, y, made);
}

static fr_status observed(const double *s, const struct signals *in, struct signals *out)
{
    fr_matched_high_pass_config config = fr_matched_high_pass_defaults();
    fr_matched_high_pass *matched;
    size_t n = load(in);
    config.rate_hz = s[0];
    TRY(MAKE(0, matched_high_pass, &config, &matched));
    TRY(fr_matched_high_pass_push(matched, x[0], x[1], x[2], n, y, MOST_SAMPLES, &made));
    for (size_t k = 0; k < n; k++)
        y[k] -= x[1][k];
    return store(out, 0, y, made);
}

const struct stage SIGNAL_STAGES[] = {
    {"lpf-b3s1", {"step", "cutoff"}, {"x"}, {"y"}, low_1},
    {"lpf-b3s2", {"step", "cutoff"}, {"x"}, {"y"}, low_2},
    {"lpf-b3s1r", {"step", "cutoff"}, {"x"}, {"y"}, low_1_back},
    {"lpf-b3s2r", {"step", "cutoff"}, {"x"}, {"y"}, low_2_back},
    {"hpf-b3s1", {"step", "cutoff"}, {"x"}, {"y"}, high_1},
    {"hpf-b3s2", {"step", "cutoff"}, {"x"}, {"y"}, high_2},
    {"hpf-b3s1r", {"step", "cutoff"}, {"x"}, {"y"}, high_1_back},
    {"hpf-b3s2r", {"step", "cutoff"}, {"x"}, {"y"}, high_2_back},
    {"hpf-b3s1-varying", {"step"}, {"x", "cutoff"}, {"y"}, varying_1},
    {"hpf-b3s2-varying", {"step"}, {"x", "cutoff"}, {"y"}, varying_2},
    {"hpf-b3s1r-varying", {"step"}, {"x", "cutoff"}, {"y"}, varying_1_back},
    {"hpf-b3s2r-varying", {"step"}, {"x", "cutoff"}, {"y"}, varying_2_back},
    {"hpf-b3s1r-state", {"step"}, {"x", "cutoff"}, {"y"}, state_1_back},
    {"hpf-b3s2r-state", {"step"}, {"x", "cutoff"}, {"y"}, state_2_back},
    {"trapezoidal-rule", {"step", "start"}, {"x"}, {"y"}, trapezoids},
    {"spatial-integration", {0}, {"x", "time_step"}, {"y"}, over_points},
    {"reflection",
     {0},
     {"velocity", "height", "adjusted", "time_step"},
     {"reference_height"},
     reflected},
    {"adaptive-cut-off",
     {"low_speed_hz", "wavelength_m", "transition_speed_mps", "steepness", "interval_m"},
     {"speed"},
     {"frequency", "wave_number"},
     cutoffs},
    {"local-suppression",
     {"rate_hz", "below_mps", "proportional", "integral_per_s"},
     {"x", "speed"},
     {"y"},
     suppressed},
    {"timer-distortion",
     {"interval_m", "slow_speed_mps", "sharpness"},
     {"time_step"},
     {"adjusted"},
     distorted},
    {"matched-high-pass", {"rate_hz"}, {"acceleration", "height", "cutoff"}, {"elevation"}, observed},
    {NULL, {0}, {0}, {0}, NULL},
};
