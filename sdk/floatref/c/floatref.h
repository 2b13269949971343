/* SPDX-License-Identifier: Apache-2.0
 *
 * libfloatref: the stages of floatref for inertial road profilers, in C99.
 *
 * Memory. The caller gives it: fr_X_size() says how many bytes a configuration needs, and
 * fr_X_init() places an object in them, aligned to FR_ALIGNMENT. Nothing is allocated, there is no
 * global state, and an object holds no pointer: memcpy() of its memory saves it, and a copy at any
 * other aligned address goes on alike. Different objects may be used in different threads.
 *
 * Calls. Each returns a status, FR_OK if the call did its work. Any other status leaves the object
 * and the arrays as they were. A push takes any number of samples, 0 too, and gives the same bits
 * for any division into pushes. `capacity` is the room of the output in samples and `*written` gets
 * the number written; 0 on a refusal, but for FR_OUTPUT_FULL the room that is needed. An array that
 * would get or give no sample may be NULL; with NULL in place of an output that has samples the
 * status is FR_NULL_POINTER, and *written stays 0. A saved object is one of the same version.
 *
 * Settings. One out of its range is FR_BAD_CONFIG, and fr_X_size() is 0. A setting is finite and
 * above zero unless its comment gives another range, with its ends; where values have names it is
 * one of those of the comment; `reserved` is 0. Two settings may be impossible together: 1 / rate_hz
 * and the like have to be finite, and interval_m is 1e-3 to 1e9 times metres_per_count.
 *
 * Samples. fr_real is double, or float if FR_FLOAT is defined, for the library and for its callers;
 * fr_real_size() tells one from the other at run time. Settings are double in both. Distances are
 * counts of the encoder, which are exact at any length. Infinite samples are refused; so are
 * missing ones (NaN), unless `missing` is FR_MISSING_BRIDGED: then the sample before is repeated.
 * fr_projection has no such setting: a missing sample there is a missing point.
 *
 * Numbers in parentheses, as (5.3), are equations and, where a method is named, sections of
 * Karamihas (2021), as in the SDK: travel speed is section 5.6 and 5.7, local suppression 5.6 with
 * the equations (5.1) and (5.2).
 */
#ifndef FLOATREF_H
#define FLOATREF_H

#include <stddef.h>
#include <stdint.h>

#define FR_VERSION_MAJOR 0
#define FR_VERSION_MINOR 1
#define FR_VERSION_PATCH 0

/* Memory of an object starts at a multiple of this, in bytes. */
#define FR_ALIGNMENT 8

#ifndef FR_API
#if defined(FR_SHARED) && defined(_WIN32) && defined(FR_BUILD)
#define FR_API __declspec(dllexport)
#elif defined(FR_SHARED) && defined(_WIN32)
#define FR_API __declspec(dllimport)
#elif defined(FR_SHARED) && defined(__GNUC__)
#define FR_API __attribute__((visibility("default")))
#else
#define FR_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

#ifdef FR_FLOAT
typedef float fr_real;
#else
typedef double fr_real;
#endif

typedef int32_t fr_status;

enum {
    FR_OK = 0,
    FR_NULL_POINTER = 1,   /* an argument that is needed is NULL */
    FR_TOO_SMALL = 2,      /* the memory is smaller than fr_X_size() */
    FR_MISALIGNED = 3,     /* the memory is not aligned to FR_ALIGNMENT */
    FR_BAD_OBJECT = 4,     /* the memory holds no object of this kind and of this build */
    FR_WRONG_ORDER = 5,    /* the run has ended, a call comes before one that it needs, or there is
                            * no value yet */
    FR_BAD_CONFIG = 6,     /* a setting is out of its range, infinite or NaN */
    FR_BAD_SAMPLE = 7,     /* a sample is infinite, missing (NaN), or out of its range */
    FR_BAD_CUTOFF = 8,     /* a cut-off, or that of a speed, is not within 0 to half the rate */
    FR_GOES_BACK = 9,      /* the encoder counts go back */
    FR_OUTPUT_FULL = 10,   /* the output has no room; *written is the room that is needed */
    FR_TOO_MANY = 11,      /* more samples in one push than it may have, or than memory can hold */
    FR_INCOMPLETE_SET = 12, /* not all signals of the set have passed with equally many samples */
    FR_OTHER_SPEED = 13,   /* signals of one set were given different speeds */
    FR_TOO_LATE = 14,      /* the sample of a GNSS reading has been filtered, or has a reading */
    FR_QUEUE_FULL = 15     /* more GNSS readings wait than the setting allows */
};

/* What happens to a missing (NaN) sample. */
enum { FR_MISSING_REFUSED = 0, FR_MISSING_BRIDGED = 1 };

/* A count that is missing; never the first of a run. Travel speed, fr_adaptive and
 * fr_road_prior take it where a setting bridges missing samples, fr_causes, fr_usual and
 * fr_encoder_screening always; fr_level, fr_pitch and the Kalman calls never. */
#define FR_NO_COUNT INT64_MIN

/* One line in English; also for a number that is no status. Never NULL. */
FR_API const char *fr_status_text(fr_status status);

/* The version of the library that is linked, as "0.1.0". */
FR_API const char *fr_version(void);

/* sizeof(fr_real) of the library that is linked: compare it with your own. */
FR_API size_t fr_real_size(void);

/* ---------------------------------------------------------------------------------------------
 * Filters of appendix A: one section of a third-order Butterworth cascade at a fixed cut-off, in
 * state-variable form. HPF_B3 is order 1, then order 2. A backward filter is pushed the last block
 * first and runs from the last sample of each block to its first; an array that is complete is one
 * push. `y` may be `x`.
 */
enum { FR_HIGH_PASS = 1, FR_LOW_PASS = 2 };
enum { FR_FORWARD = 1, FR_BACKWARD = 2 };

typedef struct fr_filter_config {
    double step;       /* between samples, in s or in m; no default */
    double cutoff;     /* of the third-order filter, in Hz or in cycles/m, below half a cycle per
                        * step; no default */
    int32_t order;     /* 1 or 2; 1 */
    int32_t passes;    /* FR_HIGH_PASS or FR_LOW_PASS; FR_HIGH_PASS */
    int32_t direction; /* FR_FORWARD or FR_BACKWARD; FR_FORWARD */
    int32_t missing;   /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
} fr_filter_config;

typedef struct fr_filter fr_filter;

FR_API fr_filter_config fr_filter_defaults(void);
FR_API size_t fr_filter_size(const fr_filter_config *config);
FR_API fr_status fr_filter_init(void *memory, size_t size, const fr_filter_config *config,
                                fr_filter **out);
FR_API fr_status fr_filter_push(fr_filter *filter, const fr_real *x, size_t count, fr_real *y,
                                size_t capacity, size_t *written);

/* Cut-off of each third-order pass for -3 dB of both together: (A.20) for a frequency of
 * HPF_B3x2, (A.21) of LPF_B3x2, (A.22) for a wavelength of HPF_B3x2. */
FR_API double fr_high_pass_setting(double frequency);
FR_API double fr_low_pass_setting(double frequency);
FR_API double fr_high_pass_wavelength_setting(double wavelength);

/* ---------------------------------------------------------------------------------------------
 * The same high-pass sections at a cut-off of its own for every sample.
 */
enum { FR_TANGENT_EXACT = 0, FR_TANGENT_SHORT = 1 };
/* c = tan(pi f_c dt) (A.11). Exact: a series below 0.1 rad, accurate to rounding, tan() above.
 * Short: a polynomial of two terms less at any angle below 0.1 rad, with a relative error of at
 * most 6e-8 there, which is below the rounding of float; tan() above. */

enum {
    FR_SECTION_1 = 1,  /* HPF_B3S1 */
    FR_SECTION_2 = 2,  /* HPF_B3S2 */
    FR_SECTION_12 = 3, /* HPF_B3S1, then HPF_B3S2 */
    FR_SECTION_21 = 4  /* HPF_B3S2, then HPF_B3S1: backward, HPF_B3R */
};
enum {
    FR_RECURSION = 0, /* (A.9) with the coefficients of each sample, as 5.7 has it */
    FR_STATES = 1     /* the cut-off inside the integrals, valid backward from a stop too */
};

typedef struct fr_varying_config {
    double step;       /* between samples, in s or in m; no default */
    int32_t sections;  /* FR_SECTION_1 to FR_SECTION_21; FR_SECTION_12 */
    int32_t form;      /* FR_RECURSION or FR_STATES, the latter for one section; FR_RECURSION */
    int32_t direction; /* FR_FORWARD or FR_BACKWARD; FR_FORWARD */
    int32_t missing;   /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
    int32_t tangent;   /* FR_TANGENT_EXACT or FR_TANGENT_SHORT; FR_TANGENT_EXACT */
} fr_varying_config;

typedef struct fr_varying fr_varying;

FR_API fr_varying_config fr_varying_defaults(void);
FR_API size_t fr_varying_size(const fr_varying_config *config);
FR_API fr_status fr_varying_init(void *memory, size_t size, const fr_varying_config *config,
                                 fr_varying **out);
/* `cutoff` is in cycles per unit of the step, within 0 to half a cycle per step. */
FR_API fr_status fr_varying_push(fr_varying *filter, const fr_real *x, const fr_real *cutoff,
                                 size_t count, fr_real *y, size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * Integration by the trapezoidal rule: in time at a constant step; over points with the time from
 * the point before, (5.5) and (5.6); and over points with the height reflected (5.9). Use one of
 * the three for an object. `y` may be `x`.
 */
typedef struct fr_integral_config {
    double step_s;   /* between samples, 0 or above; no default, not used over points */
    double start;    /* value of the integral at the first sample, any; 0 */
    int32_t missing; /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
} fr_integral_config;

typedef struct fr_integral fr_integral;

FR_API fr_integral_config fr_integral_defaults(void);
FR_API size_t fr_integral_size(const fr_integral_config *config);
FR_API fr_status fr_integral_init(void *memory, size_t size, const fr_integral_config *config,
                                  fr_integral **out);
FR_API fr_status fr_integral_push(fr_integral *integral, const fr_real *x, size_t count,
                                  fr_real *y, size_t capacity, size_t *written);
FR_API fr_status fr_integral_push_steps(fr_integral *integral, const fr_real *x,
                                        const fr_real *time_step, size_t count, fr_real *y,
                                        size_t capacity, size_t *written);
/* Floating reference height in m of a velocity in m/s, with the adjusted and the true time step
 * in s and the height in m as it will be subtracted. */
FR_API fr_status fr_integral_push_reflecting(fr_integral *integral, const fr_real *velocity,
                                             const fr_real *height, const fr_real *adjusted,
                                             const fr_real *time_step, size_t count, fr_real *y,
                                             size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * The cut-off that follows the travel speed (5.3): a frequency at low speed, a wavelength at high
 * speed. No object: each sample is alone. A missing speed gives a missing cut-off.
 */
typedef struct fr_cut_off_config {
    double low_speed_hz;         /* f_ls; 0.45 */
    double wavelength_m;         /* lambda_c; 105.91 */
    double transition_speed_mps; /* v_0; 2.778 */
    double steepness_s_per_m;    /* alpha; 2.5 */
} fr_cut_off_config;

FR_API fr_cut_off_config fr_cut_off_defaults(void);
/* f_c in Hz of a speed in m/s. */
FR_API fr_status fr_cut_off_frequency(const fr_cut_off_config *config, const fr_real *speed,
                                      size_t count, fr_real *frequency, size_t capacity,
                                      size_t *written);
/* f_c / v in cycles/m, at most one cycle in four intervals, as at a standstill. FR_BAD_CONFIG for an
 * interval of 0. */
FR_API fr_status fr_cut_off_wave_number(const fr_cut_off_config *config, double interval_m,
                                        const fr_real *speed, size_t count, fr_real *wave_number,
                                        size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * Travel speed in m/s: the encoder's progress over the preceding window (5.6, 5.7). Before the
 * first sample the vehicle is taken to be stationary. Memory: 8 bytes per sample of the window.
 */
enum { FR_BACK_REFUSED = 0, FR_BACK_TAKEN = 1 };
/* What happens to counts that go back. Refused: FR_GOES_BACK, as for a chunk that is given twice.
 * Taken: the speed is below zero, and no point is found again, as in the pipelines of the SDK. */

typedef struct fr_travel_speed_config {
    double rate_hz;          /* samples per second, at most 1e7; no default */
    double metres_per_count; /* of the encoder; no default */
    double window_s;         /* at most 60; 0.05 */
    int32_t back;            /* FR_BACK_REFUSED or FR_BACK_TAKEN; FR_BACK_REFUSED */
} fr_travel_speed_config;

typedef struct fr_travel_speed fr_travel_speed;

FR_API fr_travel_speed_config fr_travel_speed_defaults(void);
FR_API size_t fr_travel_speed_size(const fr_travel_speed_config *config);
FR_API fr_status fr_travel_speed_init(void *memory, size_t size, const fr_travel_speed_config *config,
                                      fr_travel_speed **out);
/* `counts` are within 2^50 of zero (FR_BAD_SAMPLE). */
FR_API fr_status fr_travel_speed_push(fr_travel_speed *travel, const int64_t *counts, size_t count,
                                      fr_real *speed, size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * Projection from time to distance (5.3): a sample for every interval of encoder distance. Point k
 * lies k intervals behind the first count and takes the first sample that has reached it, so a stop
 * gives no points; between samples more than an interval apart it is linear in distance.
 */
typedef struct fr_projection_config {
    double interval_m;       /* between points; no default */
    double metres_per_count; /* of the encoder; no default */
    double rate_hz;          /* samples per second, for time steps, 0 or above; 0, without them */
} fr_projection_config;

typedef struct fr_projection fr_projection;

FR_API fr_projection_config fr_projection_defaults(void);
FR_API size_t fr_projection_size(const fr_projection_config *config);
FR_API fr_status fr_projection_init(void *memory, size_t size, const fr_projection_config *config,
                                    fr_projection **out);
/* The number of points written differs from that of samples; FR_OUTPUT_FULL says how many.
 * FR_BAD_SAMPLE where the counts leap by ten million points. */
FR_API fr_status fr_projection_push(fr_projection *projection, const int64_t *counts,
                                    const fr_real *x, size_t count, fr_real *y, size_t capacity,
                                    size_t *written);
/* The same, and the time in s from the point before to each, 0 for the first (5.4): a difference
 * of sample numbers, so it is exact at any time. FR_BAD_CONFIG without a rate. */
FR_API fr_status fr_projection_push_timed(fr_projection *projection, const int64_t *counts,
                                          const fr_real *x, size_t count, fr_real *y,
                                          fr_real *time_step, size_t capacity, size_t *written);

/* The time from the trigger before in s (5.4), where the encoder triggers and a timer counts. */
typedef struct fr_time_step_config {
    double seconds_per_tick; /* of the timer; no default */
} fr_time_step_config;

typedef struct fr_time_step fr_time_step;

FR_API fr_time_step_config fr_time_step_defaults(void);
FR_API size_t fr_time_step_size(const fr_time_step_config *config);
FR_API fr_status fr_time_step_init(void *memory, size_t size, const fr_time_step_config *config,
                                   fr_time_step **out);
/* `ticks` are within 2^50 of zero (FR_BAD_SAMPLE) and do not go back (FR_GOES_BACK). The first
 * trigger has a step of 0. */
FR_API fr_status fr_time_step_push(fr_time_step *timer, const int64_t *ticks, size_t count,
                                   fr_real *time_step, size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * The recommended temporal algorithm (5.7) whole, for one wheel path: conditioning, both
 * integrations with the high-pass at the cut-off of the speed (5.3) before each, the same on the
 * height, the difference, projection to distance; at the end the backward pass over the points.
 */
typedef struct fr_adaptive_config {
    fr_travel_speed_config travel;   /* rate, encoder and window; no default of the first two */
    fr_cut_off_config cut_off; /* (5.3) */
    double interval_m;         /* between points of the profile; no default */
    double gravity_mps2;       /* taken from every acceleration: 9.80665 for a specific force; any; 0 */
    int32_t missing;           /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
    int32_t tangent;           /* FR_TANGENT_EXACT or FR_TANGENT_SHORT; FR_TANGENT_EXACT */
    int32_t cut_off_every;     /* samples between updates of the cut-off, 1 to 65536; 1, exact.
                                  The error grows with the time between updates: where it is 4 ms,
                                  it is 0.02 m/km of IRI while the speed rises by 3 m/s^2. */
} fr_adaptive_config;

typedef struct fr_adaptive fr_adaptive;

FR_API fr_adaptive_config fr_adaptive_defaults(void);
FR_API size_t fr_adaptive_size(const fr_adaptive_config *config);
FR_API fr_status fr_adaptive_init(void *memory, size_t size, const fr_adaptive_config *config,
                                  fr_adaptive **out);
/* `acceleration` in m/s^2 and `height` in m, down to the road, of `count` samples; elevation in m
 * and speed in m/s of every point that they reach. Keep both for the end of the run. */
FR_API fr_status fr_adaptive_push(fr_adaptive *adaptive, const fr_real *acceleration,
                                  const fr_real *height, const int64_t *counts, size_t count,
                                  fr_real *elevation, fr_real *speed, size_t capacity,
                                  size_t *written);
/* End the run: the backward pass over distance of all points so far. FR_INCOMPLETE_SET unless
 * `count` is their number. `profile` may be `elevation`. */
FR_API fr_status fr_adaptive_finish(fr_adaptive *adaptive, const fr_real *elevation,
                                    const fr_real *speed, size_t count, fr_real *profile,
                                    size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * The high-pass sets alone, for an engine with integrals of its own. The same filter on both sides
 * of the difference cancels the vehicle's motion, so a run ends only if all three signals have
 * passed with equally many samples; otherwise FR_INCOMPLETE_SET. At a fixed cut-off, in time (5.5)
 * or over distance (5.9): HPF_B3S1 of the acceleration, HPF_B3S2 of the velocity, HPF_B3 of the
 * height from its first sample; at the end HPF_B3S2R and HPF_B3S1R of the elevation.
 */
typedef struct fr_high_pass_set_config {
    double step;     /* between samples, in s or in m; no default */
    double cutoff;   /* of each third-order pass, in Hz or in cycles/m, below half a cycle per step; no
                      * default */
    int32_t missing; /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
} fr_high_pass_set_config;

typedef struct fr_high_pass_set fr_high_pass_set;

FR_API fr_high_pass_set_config fr_high_pass_set_defaults(void);
FR_API size_t fr_high_pass_set_size(const fr_high_pass_set_config *config);
FR_API fr_status fr_high_pass_set_init(void *memory, size_t size,
                                       const fr_high_pass_set_config *config,
                                       fr_high_pass_set **out);
FR_API fr_status fr_high_pass_set_acceleration(fr_high_pass_set *set, const fr_real *x,
                                               size_t count, fr_real *y, size_t capacity,
                                               size_t *written);
FR_API fr_status fr_high_pass_set_velocity(fr_high_pass_set *set, const fr_real *x, size_t count,
                                           fr_real *y, size_t capacity, size_t *written);
FR_API fr_status fr_high_pass_set_height(fr_high_pass_set *set, const fr_real *x, size_t count,
                                         fr_real *y, size_t capacity, size_t *written);
/* End the run with the backward pass over all samples of the elevation, or without one. */
FR_API fr_status fr_high_pass_set_reverse(fr_high_pass_set *set, const fr_real *elevation,
                                          size_t count, fr_real *profile, size_t capacity,
                                          size_t *written);
FR_API fr_status fr_high_pass_set_finish(fr_high_pass_set *set);

/* The same at the cut-off of the travel speed (5.7), which is given with every signal and has to be
 * the same for all: FR_OTHER_SPEED. */
typedef struct fr_adaptive_set_config {
    double rate_hz;            /* samples per second; no default */
    fr_cut_off_config cut_off; /* (5.3) */
    int32_t missing;           /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
    int32_t tangent;           /* FR_TANGENT_EXACT or FR_TANGENT_SHORT; FR_TANGENT_EXACT */
} fr_adaptive_set_config;

typedef struct fr_adaptive_set fr_adaptive_set;

FR_API fr_adaptive_set_config fr_adaptive_set_defaults(void);
FR_API size_t fr_adaptive_set_size(const fr_adaptive_set_config *config);
FR_API fr_status fr_adaptive_set_init(void *memory, size_t size,
                                      const fr_adaptive_set_config *config, fr_adaptive_set **out);
FR_API fr_status fr_adaptive_set_acceleration(fr_adaptive_set *set, const fr_real *x,
                                              const fr_real *speed, size_t count, fr_real *y,
                                              size_t capacity, size_t *written);
FR_API fr_status fr_adaptive_set_velocity(fr_adaptive_set *set, const fr_real *x,
                                          const fr_real *speed, size_t count, fr_real *y,
                                          size_t capacity, size_t *written);
FR_API fr_status fr_adaptive_set_height(fr_adaptive_set *set, const fr_real *x,
                                        const fr_real *speed, size_t count, fr_real *y,
                                        size_t capacity, size_t *written);
/* End the run with the backward pass in time over all samples, with that over distance of points
 * `interval_m` apart at the speed stored with each (FR_BAD_CONFIG for 0), or without one. */
FR_API fr_status fr_adaptive_set_reverse(fr_adaptive_set *set, const fr_real *elevation,
                                         const fr_real *speed, size_t count, fr_real *profile,
                                         size_t capacity, size_t *written);
FR_API fr_status fr_adaptive_set_reverse_over_distance(fr_adaptive_set *set, double interval_m,
                                                       const fr_real *elevation,
                                                       const fr_real *speed, size_t count,
                                                       fr_real *profile, size_t capacity,
                                                       size_t *written);
FR_API fr_status fr_adaptive_set_finish(fr_adaptive_set *set);

/* ---------------------------------------------------------------------------------------------
 * Local suppression (5.6): a PI controller that holds the vertical velocity at zero below a speed.
 */
typedef struct fr_local_suppression_config {
    double rate_hz;        /* samples per second; no default */
    double below_mps;      /* it acts below this speed; 4.4704 */
    double proportional;   /* K_P; 0.001 */
    double integral_per_s; /* K_I; 0.834 */
    int32_t missing;       /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
} fr_local_suppression_config;

typedef struct fr_local_suppression fr_local_suppression;

FR_API fr_local_suppression_config fr_local_suppression_defaults(void);
FR_API size_t fr_local_suppression_size(const fr_local_suppression_config *config);
FR_API fr_status fr_local_suppression_init(void *memory, size_t size,
                                           const fr_local_suppression_config *config,
                                           fr_local_suppression **out);
FR_API fr_status fr_local_suppression_push(fr_local_suppression *control, const fr_real *velocity,
                                           const fr_real *speed, size_t count, fr_real *y,
                                           size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * Timer distortion (5.7, 5.8): a limit on the time step of an integration over distance. No object.
 * The height is reflected (5.9) by fr_integral_push_reflecting().
 */
typedef struct fr_timer_distortion_config {
    double interval_m;     /* between points; no default */
    double slow_speed_mps; /* the longest step is that of this speed; 3.576 */
    double sharpness;      /* beta, at least 2; 25 */
} fr_timer_distortion_config;

FR_API fr_timer_distortion_config fr_timer_distortion_defaults(void);
/* Adjusted time steps in s of measured ones; these may be 0 and of any length. */
FR_API fr_status fr_timer_distortion_steps(const fr_timer_distortion_config *config,
                                           const fr_real *time_step, size_t count,
                                           fr_real *adjusted, size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * The matched high-pass: an observer in place of both integrations. Its floating reference height
 * follows the height below the cut-off; minus the height it is the filtered profile.
 */
typedef struct fr_matched_high_pass_config {
    double rate_hz;  /* samples per second; no default */
    int32_t missing; /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED */
    int32_t tangent; /* FR_TANGENT_EXACT or FR_TANGENT_SHORT; FR_TANGENT_EXACT */
} fr_matched_high_pass_config;

typedef struct fr_matched_high_pass fr_matched_high_pass;

FR_API fr_matched_high_pass_config fr_matched_high_pass_defaults(void);
FR_API size_t fr_matched_high_pass_size(const fr_matched_high_pass_config *config);
FR_API fr_status fr_matched_high_pass_init(void *memory, size_t size,
                                           const fr_matched_high_pass_config *config,
                                           fr_matched_high_pass **out);
/* Acceleration in m/s^2 with 1 g removed, height in m, and the cut-off in Hz of every sample, as
 * fr_cut_off_frequency() gives it. */
FR_API fr_status fr_matched_high_pass_push(fr_matched_high_pass *matched,
                                           const fr_real *acceleration, const fr_real *height,
                                           const fr_real *cutoff, size_t count,
                                           fr_real *reference_height, size_t capacity,
                                           size_t *written);

/* ---------------------------------------------------------------------------------------------
 * Flags of a point of a smoother, bit by bit; 0 is a valid point.
 */
enum {
    FR_POINT_MISSING = 1,   /* samples are missing since the point before, or its height is */
    FR_POINT_LEAP = 2,      /* behind or before a leap of the height sensor at a standstill */
    FR_POINT_UNCERTAIN = 4, /* the 1-sigma is too large for the road */
    FR_POINT_UNSETTLED = 8  /* the lag was too short: readings behind it may still change the point */
};

/* ---------------------------------------------------------------------------------------------
 * The road-prior smoother of one wheel path, with a fixed lag: in place of both integrations and
 * all high-pass filters. The road is a process in distance, which does not change at a stop. Points
 * come out in sections of half a lag, with at least the lag behind them, in bounded memory. A
 * standstill of any length takes no more; what a lag is too short for is flagged.
 *
 * All of it is computed in double, in the float build too. Of memory, a node takes 480 bytes, a
 * point 48 and a second of the lag 3720 and 248 for each m/s of `fastest_mps`; so the lag decides,
 * see docs/c-library.md. A call that gives points out takes far longer than others.
 */
typedef struct fr_road_prior_config {
    double rate_hz;          /* samples per second, 10 to 1e7; no default */
    double metres_per_count; /* of the encoder; no default */
    double interval_m;       /* between points, at most 1e6 m; at most 4e8 points and 1e9 m in a lag at
                                fastest_mps; no default */
    double gravity_mps2;     /* taken from every acceleration: 9.80665 for a specific force, within
                                1e6 of 0; 0 */
    double node_rate_hz;     /* nodes per second, 10 to 1000, of the filter; 500 */
    double lag_s;            /* least time from a point to its output, at most 3600; 60 */
    double fastest_mps;      /* speed above which the lag is shorter; 40 */
    double tolerance_m;      /* a point that readings to come may change by more, as 1-sigma behind
                                the high-pass, is FR_POINT_UNSETTLED; 0 or above; 1e-4 */
    double wavelength_m;     /* cut-off of each pass of HPF_B3x2, for the 1-sigma, 1e-3 to 1e6;
                                105.91 */
    /* What sensors, vehicle and road are taken for, as in the SDK. Densities per sqrt(Hz). Ranges: 0 to
     * 1e9 for what disturbs the acceleration, `edge_sigmas`, `height_m` and `most_sigma_share`; 1e-15
     * to 1e6 for `acceleration_bias`, `reading_m`, `road_m`, `long_waves_per_m`, `road_reach_m`,
     * `lean_sigma_rad`, `tilt_sigma` and `pitch_hz`; within 1e9 of 0 for what is expected. */
    double acceleration;         /* white noise of the accelerometer in m/s^2; 1.5e-4 */
    double acceleration_bias;    /* 1-sigma of its bias at the start in m/s^2; 0.03 */
    double acceleration_walk;    /* random walk of the bias in m/s^2 per sqrt(s); 1e-4 */
    double walk_along;           /* what acceleration along the road adds, in 1/sqrt(s); 1.6e-3 */
    double missing_acceleration; /* in place of `acceleration` for missing samples; 0.3 */
    double reading_m;            /* least 1-sigma of a height as one of the road; 1e-4 */
    double road_m;               /* q = G_s/2 of (2.2); 4e-6 */
    double long_waves_per_m;     /* G_a/2 of (2.4); 2e-7 */
    double road_reach_m;         /* distance after which the road is forgotten; 150 */
    double road_memory_m;        /* travel over which the run's own road takes over, 32 to 1e18; 300 */
    double edge_sigmas;          /* a height at a standstill so far off is an edge; 6 */
    double lean_expected_rad, lean_sigma_rad; /* of the accelerometer's axis forward; 0, 0.03 */
    double tilt_expected, tilt_sigma; /* pitch per acceleration, rad per m/s^2; 0, 0.01 */
    double pitch_hz, pitch_damping;   /* of the pitch response, damping 0 to below 1; 1.6, 0.3 */
    double height_m;                  /* 1-sigma of a height, for the 1-sigma of the result; 4e-5 */
    double most_sigma_share; /* a 1-sigma that is a larger share of the road's bend is uncertain; 0.3 */
    int32_t missing; /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; FR_MISSING_REFUSED. Bridged: a
                        missing height is no reading, a missing acceleration is one of 0 that is
                        taken for as uncertain as `missing_acceleration`, and counts may be missing
                        but for the first; such points are flagged. */
    int32_t back;    /* FR_BACK_REFUSED or FR_BACK_TAKEN; FR_BACK_REFUSED */
} fr_road_prior_config;

typedef struct fr_road_prior fr_road_prior;

FR_API fr_road_prior_config fr_road_prior_defaults(void);
FR_API size_t fr_road_prior_size(const fr_road_prior_config *config);
FR_API fr_status fr_road_prior_init(void *memory, size_t size, const fr_road_prior_config *config,
                                    fr_road_prior **out);
/* Acceleration in m/s^2 and height in m, both within a million of 0, of `count` samples; the first
 * height and the first count of the run are never missing (FR_BAD_SAMPLE). Of each point
 * that comes out: elevation in m before any high-pass, 1-sigma of it in m behind HPF_B3x2, and
 * flags. FR_BAD_SAMPLE too where the encoder leaps by more than half a lag at `fastest_mps`. The way
 * across missing counts (FR_NO_COUNT) is no travel of the vehicle, which goes on at its last speed;
 * points on it come with the next count. */
FR_API fr_status fr_road_prior_push(fr_road_prior *road, const fr_real *acceleration,
                                    const fr_real *height, const int64_t *counts, size_t count,
                                    fr_real *elevation, fr_real *sigma, uint8_t *flags,
                                    size_t capacity, size_t *written);
/* The same behind a stage that levels the acceleration: the share of each sample, 0 to 1, that is
 * levelled, and the share that is missing; either may be NULL, for 0. Others are FR_BAD_SAMPLE. */
FR_API fr_status fr_road_prior_push_levelled(fr_road_prior *road, const fr_real *acceleration,
                                             const fr_real *height, const int64_t *counts,
                                             const fr_real *levelled, const fr_real *missing,
                                             size_t count, fr_real *elevation, fr_real *sigma,
                                             uint8_t *flags, size_t capacity, size_t *written);
/* End the run: all points that are left, smoothed with what there is behind them. */
FR_API fr_status fr_road_prior_finish(fr_road_prior *road, fr_real *elevation, fr_real *sigma,
                                      uint8_t *flags, size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * The International Roughness Index, running over distance (2.1.1). The car starts at the mean
 * slope of the start length, so the first output comes behind that length; the others come one
 * moving average behind their point. Memory: 8 bytes or less per point of the longer of both.
 */
typedef struct fr_iri_config {
    double interval_m;       /* between points, at most 2; no default */
    double moving_average_m; /* base length of the tyre envelope, 0 for no envelope; 0.25. Both this
                                and the next have fewer than 2^24 intervals */
    double start_length_m;   /* the car starts at the mean slope of this length; 11 */
    double speed_kmh;        /* simulated speed; 80 */
} fr_iri_config;

typedef struct fr_iri fr_iri;

FR_API fr_iri_config fr_iri_defaults(void);
FR_API size_t fr_iri_size(const fr_iri_config *config);
FR_API fr_status fr_iri_init(void *memory, size_t size, const fr_iri_config *config, fr_iri **out);
/* The signed output in m/km at the end of every interval that is ready, from points that are all
 * there: bridge missing ones before. FR_OUTPUT_FULL says how many intervals are ready. */
FR_API fr_status fr_iri_push(fr_iri *iri, const fr_real *elevation, size_t count, fr_real *trace,
                             size_t capacity, size_t *written);
/* End the profile: the output of the intervals that are left. FR_WRONG_ORDER if it is not longer
 * than the start length. */
FR_API fr_status fr_iri_finish(fr_iri *iri, fr_real *trace, size_t capacity, size_t *written);
/* The IRI in m/km of all output so far, after the end too; FR_WRONG_ORDER before the first. */
FR_API fr_status fr_iri_value(const fr_iri *iri, fr_real *m_per_km);

/* ---------------------------------------------------------------------------------------------
 * Measures of a finished profile. No object. HPF_B3x2 of appendix A takes out long waves for a
 * display, from the first elevation on; the cross correlation (2.12) to (2.16) says how well one
 * filtered profile agrees with another on the same points.
 */
typedef struct fr_high_pass_profile_config {
    double interval_m;   /* between points; no default */
    double wavelength_m; /* of -3 dB of both passes together (A.22); 91.44 */
} fr_high_pass_profile_config;

FR_API fr_high_pass_profile_config fr_high_pass_profile_defaults(void);
/* `filtered` may be `elevation`. FR_BAD_CONFIG for a wavelength of less than about two intervals. */
FR_API fr_status fr_high_pass_profile(const fr_high_pass_profile_config *config,
                                      const fr_real *elevation, size_t count, fr_real *filtered,
                                      size_t capacity, size_t *written);

/* A seam: between point `last` and point `next` the encoder has counted what was not travelled, or
 * has lost what was. A road does not step there, and its grade goes on for the travel that a
 * high-pass over distance sees; so points between are on a line at the grade before, and all behind
 * are moved to its end. Take the seams of a run in order, before any high-pass. */
typedef struct fr_seam_config {
    double interval_m; /* between points; no default */
    double grade_m;    /* travel over which the grade is measured; 20 */
    double point_m;    /* one point in each of these is part of it; 0.25 */
} fr_seam_config;

FR_API fr_seam_config fr_seam_defaults(void);
/* FR_BAD_CONFIG too unless last < next < count. */
FR_API fr_status fr_seam(const fr_seam_config *config, size_t last, size_t next, fr_real *elevation,
                         size_t count);

typedef struct fr_cross_correlation_config {
    double interval_m;   /* between points; no default */
    double max_offset_m; /* farthest offset to either side, 0 or above; 1 */
} fr_cross_correlation_config;

typedef struct fr_agreement {
    double cross_correlation; /* score (2.16): the product of both factors */
    double correlation;       /* (2.14), the highest of all offsets, the nearest to zero of equals */
    double amplitude_factor;  /* (2.15) there */
    double offset_m;          /* above zero where q lies farther along */
} fr_agreement;

FR_API fr_cross_correlation_config fr_cross_correlation_defaults(void);
/* Of `count` points of each. FR_BAD_CONFIG for less than four times the farthest offset. The time
 * grows with the number of points times that of offsets. */
FR_API fr_status fr_cross_correlation(const fr_cross_correlation_config *config, const fr_real *p,
                                      const fr_real *q, size_t count, fr_agreement *agreement);

/* ---------------------------------------------------------------------------------------------
 * What to trust. Causes are bits of a sample or a point; 0 is a sound one. fr_causes adds the marks
 * of the drive to the causes of the sensors and carries both to the points of the profile, and
 * fr_validity() extends them over distance. Slow is a mean speed over two windows below `slow_mps`;
 * braking is a deceleration between them that would stop the vehicle within `stopping_time_s`.
 * Memory: 16 bytes for each look within a window.
 */
enum {
    FR_CAUSE_MISSING = 1, /* not measured; bridged */
    FR_CAUSE_DRIFT = 2,   /* the integrals are disturbed; a gap of the accelerometer */
    FR_CAUSE_SLOW = 4,    /* slow travel, or travel that is not known */
    FR_CAUSE_BRAKING = 8  /* the accelerometer tilts */
};

typedef struct fr_causes_config {
    double rate_hz;          /* samples per second; no default */
    double metres_per_count; /* of the encoder; no default */
    double interval_m;       /* between points of the profile; no default */
    double slow_mps;         /* 4.4704 */
    double stopping_time_s;  /* 5 */
    double window_s;         /* at most 1e7 looks; 0.25 */
    int32_t every;           /* samples between looks at the counts, 1 or more; 1, as in the SDK */
    int32_t reserved;        /* 0 */
} fr_causes_config;

typedef struct fr_causes fr_causes;

FR_API fr_causes_config fr_causes_defaults(void);
FR_API size_t fr_causes_size(const fr_causes_config *config);
FR_API fr_status fr_causes_init(void *memory, size_t size, const fr_causes_config *config,
                                fr_causes **out);
/* Causes of every point that the samples reach. Those of each sample may be NULL, for sound ones.
 * Counts may be missing (FR_NO_COUNT), but for the first one of the run. */
FR_API fr_status fr_causes_push(fr_causes *causes, const int64_t *counts,
                                const uint8_t *of_samples, size_t count, uint8_t *of_points,
                                size_t capacity, size_t *written);
/* End the run: the last of all `count` points gets the causes behind it. */
FR_API fr_status fr_causes_finish(fr_causes *causes, uint8_t *of_points, size_t count);

typedef struct fr_validity_config {
    double interval_m;      /* between points; no default. The lengths below are 0 or above */
    double drift_m;         /* to either side of a disturbed integral; 105.91, a cut-off wavelength */
    double run_in_m;        /* from either end of the run; 52.955 */
    double before_slow_m;   /* 15, as for 5.7 */
    double after_slow_m;    /* 30 */
    double after_braking_m; /* 30 */
} fr_validity_config;

FR_API fr_validity_config fr_validity_defaults(void);
/* 1 for a valid point and 0 for another, of all points of a run. `valid` may be `causes`, of which
 * FR_BAD_SAMPLE refuses bits that are no cause. */
FR_API fr_status fr_validity(const fr_validity_config *config, const uint8_t *causes, size_t count,
                             uint8_t *valid, size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * Screening: samples that are there but measure nothing, as spans of their indices. A span is known
 * when it has ended: in fr_screening with the sample behind it, in fr_encoder_screening with the
 * knot behind it, in fr_saturation with the samples of `farthest` or 262 holds behind it. The kind
 * says what becomes of it:
 *
 *   a line between its neighbours, FR_CAUSE_MISSING    FR_GAP, FR_STUCK, FR_OUT_OF_RANGE, FR_SPIKE,
 *                                                      FR_BACK, FR_SILENT
 *   and FR_CAUSE_DRIFT at any length, accelerometer    FR_STUCK, FR_SATURATED
 *   FR_NO_COUNT, FR_CAUSE_SLOW, of an encoder          FR_LEAPT, FR_TOO_MANY_COUNTS, FR_LOST
 */
enum {
    FR_GAP = 1,
    FR_STUCK = 2,
    FR_OUT_OF_RANGE = 3,
    FR_SPIKE = 4,
    FR_SATURATED = 5,
    FR_BACK = 6,            /* behind where the encoder has been, or a count that returns at once */
    FR_SILENT = 7,          /* constant, and made up for at once */
    FR_LEAPT = 8,           /* farther at once than a vehicle goes */
    FR_TOO_MANY_COUNTS = 9, /* the same, count by count */
    FR_LOST = 10            /* less than the shortest way to a stop, braking with 2 g */
};

typedef struct fr_span {
    int64_t first;    /* index of its first sample in the run */
    int64_t behind;   /* index of the sample behind its last one */
    int32_t kind;     /* FR_GAP to FR_LOST */
    int32_t reserved; /* 0 */
} fr_span;

/* A height or an accelerometer: gaps that a line does not bridge well (decision 0004); identical
 * samples while the vehicle goes on and the accelerometer beside it moves; a height out of its
 * range; spikes of one sample. Constant memory. Times and holds have fewer than 1e15 samples. */
typedef struct fr_screening_config {
    double rate_hz;          /* samples per second; no default */
    double metres_per_count; /* of the encoder; no default */
    double longest_gap_s;    /* that a line bridges well; 0.01 */
    double stuck_s;          /* shortest run of a stuck sensor; 0.05, an accelerometer: 0.02. With
                                `holds` it makes two samples or more */
    double holds;            /* the same in usual holds; 20 */
    double hold;             /* usual hold: samples for which a working sensor repeats itself; 1 */
    double travel_m;         /* shortest distance that the vehicle goes meanwhile; 0.5 */
    double spread_mps2;      /* least spread of the accelerometer meanwhile; 0.1, 0 without one */
    double range_least;      /* ends of the range of a height, in order; 0 and 0, not known */
    double range_greatest;
    double stay_s;     /* shortest stay at an end; 0.002 */
    double stay_holds; /* the same in usual holds; 5 */
    double leap;       /* smallest step to the end or back, in m; 0.005 */
    double spike;      /* smallest spike, from 1 kHz on: of a height 0.05 m, of an accelerometer on
                          the body 0.5 g, and 15 times fr_usual_values.off_neighbours; 0, no spikes. Has to
                          be 0 below 1 kHz */
} fr_screening_config;

typedef struct fr_screening fr_screening;

FR_API fr_screening_config fr_screening_defaults(void);
FR_API size_t fr_screening_size(const fr_screening_config *config);
FR_API fr_status fr_screening_init(void *memory, size_t size, const fr_screening_config *config,
                                   fr_screening **out);
/* `x` of the sensor, NaN where it is missing, and `force` of the accelerometer beside it in m/s^2,
 * which may be NULL if the spread is 0. FR_OUTPUT_FULL says how many spans end. */
FR_API fr_status fr_screening_push(fr_screening *screening, const fr_real *x, const fr_real *force,
                                   const int64_t *counts, size_t count, fr_span *spans,
                                   size_t capacity, size_t *written);
/* End the run, and with it what is open: two spans at most. */
FR_API fr_status fr_screening_finish(fr_screening *screening, fr_span *spans, size_t capacity,
                                     size_t *written);

/* An accelerometer at the end of its range: three or more identical samples there that cut off a
 * swing (decision 0012). Memory: a ring of three times `farthest`, or 530 holds, in samples. */
typedef struct fr_saturation_config {
    double hold;           /* usual hold in samples, 1 to 4096; 1 */
    double quantum;        /* smallest step of the sensor in m/s^2, 0 or above; 0 */
    double range_least;    /* ends of the range in m/s^2, the first below the other; no default */
    double range_greatest;
    double rest_mps2;      /* reading at rest, any; 9.80665 */
    double outermost_mps2; /* an end is this far from rest at least; 7.3549875 */
    int32_t farthest;      /* samples beside a run that are looked at, at most, 1 to 2^22; 1000 */
    int32_t reserved;      /* 0 */
} fr_saturation_config;

typedef struct fr_saturation fr_saturation;

FR_API fr_saturation_config fr_saturation_defaults(void);
FR_API size_t fr_saturation_size(const fr_saturation_config *config);
FR_API fr_status fr_saturation_init(void *memory, size_t size, const fr_saturation_config *config,
                                    fr_saturation **out);
/* NaN where a sample is missing. There has to be room for a span of three holds, three samples at
 * least, each, and one more. */
FR_API fr_status fr_saturation_push(fr_saturation *saturation, const fr_real *x, size_t count,
                                    fr_span *spans, size_t capacity, size_t *written);
/* End the run: FR_OUTPUT_FULL says how much room is needed. */
FR_API fr_status fr_saturation_finish(fr_saturation *saturation, fr_span *spans, size_t capacity,
                                      size_t *written);

/* An encoder: the way between counts 25 ms or more apart is judged by the last two sound ways.
 * Constant memory. */
typedef struct fr_encoder_screening_config {
    double rate_hz;          /* samples per second, or ticks of push_timed(); no default */
    double metres_per_count; /* no default */
    double usual_m;          /* usual step from sample to sample that has one; 0, a count */
    double off_m;            /* largest error of a way, 0 or above as usual_m; 0, a usual step */
    double knot_s;           /* shortest time of a way, less than 1e9 samples; 0.025 */
} fr_encoder_screening_config;

typedef struct fr_encoder_screening fr_encoder_screening;

FR_API fr_encoder_screening_config fr_encoder_screening_defaults(void);
FR_API size_t fr_encoder_screening_size(const fr_encoder_screening_config *config);
FR_API fr_status fr_encoder_screening_init(void *memory, size_t size,
                                           const fr_encoder_screening_config *config,
                                           fr_encoder_screening **out);
/* FR_NO_COUNT where a count is missing. There has to be room for two spans of each count. */
FR_API fr_status fr_encoder_screening_push(fr_encoder_screening *screening, const int64_t *counts,
                                           size_t count, fr_span *spans, size_t capacity,
                                           size_t *written);
/* The same with the time of each count in ticks, as of an encoder that triggers: FR_GOES_BACK if they
 * do. */
FR_API fr_status fr_encoder_screening_push_timed(fr_encoder_screening *screening,
                                                 const int64_t *counts, const int64_t *ticks,
                                                 size_t count, fr_span *spans, size_t capacity,
                                                 size_t *written);
/* End the run: four spans at most, for which there has to be room. */
FR_API fr_status fr_encoder_screening_finish(fr_encoder_screening *screening, fr_span *spans,
                                             size_t capacity, size_t *written);

/* What is usual of a sensor, where no data sheet says it: learned from a drive, and stored. Memory:
 * 4 bytes for each length of hold. */
typedef struct fr_usual_config {
    int32_t longest;  /* holds of this number of samples and more are counted together, 2 to 2^20;
                       * 4096 */
    int32_t reserved; /* 0 */
} fr_usual_config;

typedef struct fr_usual_values {
    double least, greatest; /* samples */
    double quantum;         /* smallest step between different ones; 0 without a step */
    double hold_of_holds;   /* the median of the holds, in samples; infinite among the longest */
    double hold_of_samples; /* half of the samples are in holds up to this */
    double off_neighbours;  /* median distance of a reading from the mean of both beside it, within
                               4.5 %: 0.826 times the 1-sigma of white noise */
    double rise;            /* the median of the rises of an encoder, in counts, within 4.5 % */
    int64_t samples;        /* that are not missing */
} fr_usual_values;

typedef struct fr_usual fr_usual;

FR_API fr_usual_config fr_usual_defaults(void);
FR_API size_t fr_usual_size(const fr_usual_config *config);
FR_API fr_status fr_usual_init(void *memory, size_t size, const fr_usual_config *config,
                               fr_usual **out);
/* NaN where a sample is missing. */
FR_API fr_status fr_usual_push(fr_usual *usual, const fr_real *x, size_t count);
/* The same of an encoder, for its usual step alone; FR_NO_COUNT where a count is missing. */
FR_API fr_status fr_usual_push_counts(fr_usual *usual, const int64_t *counts, size_t count);
/* Of all samples so far and the holds that have ended; FR_WRONG_ORDER before the first. */
FR_API fr_status fr_usual_value(const fr_usual *usual, fr_usual_values *values);

/* The settings of a search for a sensor of which this is usual; without values, impossible ones. */
FR_API fr_screening_config fr_screening_of_height(double rate_hz, double metres_per_count,
                                                  const fr_usual_values *usual);
FR_API fr_screening_config fr_screening_of_force(double rate_hz, double metres_per_count,
                                                 const fr_usual_values *usual);
FR_API fr_saturation_config fr_saturation_of(const fr_usual_values *usual);

/* ---------------------------------------------------------------------------------------------
 * The extended Kalman filter of chapter 6 for one wheel path: inertial unit, height sensor, encoder
 * and GNSS in place of both integrations. Inputs, states and heights are double in the build for
 * float too: with states in float, a smoother without GNSS is off by 0.6 to 110 mm.
 *
 * Inputs: specific force forward, to the side and up in m/s^2, rates about the same axes in rad/s,
 * the height in m. With `missing` FR_MISSING_BRIDGED a missing sample of the inertial unit is taken
 * as zero, and the noise of a missing acceleration holds up to the end of its sub-block of 10 ms;
 * a missing height is one that is not observed.
 *
 * Readings of GNSS name the sample next to them in time, and may come in any order: before that
 * sample, or up to `late_s` behind it, which the output waits for. Without readings for half a
 * second constants take their place.
 */
/* Process noise and `height_m` are 0 to 1e9, that of readings, of constants and of the reflection 1e-9
 * to 1e9. */
typedef struct fr_kalman_noise {
    double acceleration;         /* vertical acceleration, in m/s^2/sqrt(Hz); 4.65e-5 */
    double acceleration_walk;    /* of its bias, in m/s^2/sqrt(s); 1e-4 */
    double roll_rate;            /* in rad/s/sqrt(Hz); 1.34e-5, as the two below */
    double pitch_rate;
    double yaw_rate;
    double roll_rate_walk;       /* of its bias, in rad/s/sqrt(s); 9.27e-6 */
    double pitch_rate_walk;      /* 4.86e-4 */
    double missing_acceleration; /* in place of `acceleration` where that is missing; 0.3 */
    double lean_rad;             /* 1-sigma of the lean of the accelerometer's axis; 0.01 */
    double gnss_height_m;        /* 1-sigma of a reading at 20 Hz or less; 0.012 */
    double gnss_velocity_mps;    /* 0.03 */
    double gnss_pitch_rad;       /* 2.09e-3 */
    double gnss_roll_rad;        /* 3.49e-3 */
    double gnss_height_walk;     /* slow error of the GNSS height, in m/sqrt(s); 1.5e-3 */
    double constant_height;      /* what stays the same without a reading, in m/sqrt(Hz); 0.04 */
    double constant_velocity;    /* in m/s/sqrt(Hz); 0.08 */
    double constant_pitch;       /* in rad/sqrt(Hz); 0.0195 */
    double constant_roll;        /* in rad/sqrt(Hz); 0.0078 */
    double reflection;           /* the height sensor at a stop, in m/sqrt(Hz); 2.64e-5 */
    double height_m;             /* 1-sigma of a reading of the height sensor; 4e-5 */
} fr_kalman_noise;

typedef struct fr_kalman_filter_config {
    fr_travel_speed_config travel; /* rate, 2 Hz or more, and encoder; no default but for the window */
    fr_kalman_noise noise;
    double gravity_mps2;           /* within 1e9 of 0; 9.80665 */
    double antenna_m[3];           /* from the reference point: forward, to the side, up, within 1e9 of
                                      0; 0 */
    double reflection_speed_mps;   /* the vehicle is stationary below this speed, 0 to 10; 0.16 / 3.6 */
    double late_s;                 /* how late a reading may come, 0 to 60; 0 */
    int32_t gnss;                  /* 1: height and velocity of GNSS, 0: constants; 1 */
    int32_t attitude;              /* 1: pitch and roll of GNSS, 0: constants; 1 */
    int32_t reflects;              /* 1: the height sensor in place of GNSS heights at a stop; 1 */
    int32_t readings;              /* GNSS readings that may wait at a time, 1 to 100000; 64 */
    int32_t missing;               /* FR_MISSING_REFUSED or FR_MISSING_BRIDGED; ..._REFUSED */
    int32_t reserved;              /* 0 */
} fr_kalman_filter_config;

/* The samples of a push; all of them have as many. */
typedef struct fr_imu {
    const double *longitudinal, *lateral, *vertical; /* specific force in m/s^2 */
    const double *roll_rate, *pitch_rate, *yaw_rate; /* in rad/s */
} fr_imu;

typedef struct fr_kalman_filter fr_kalman_filter;

/* Defaults of the variant with GNSS, attitude and reflection (6.6.3), and of that without GNSS
 * (6.6.5), whose noise differs. */
FR_API fr_kalman_filter_config fr_kalman_filter_defaults(void);
FR_API fr_kalman_filter_config fr_kalman_filter_inertial_defaults(void);
FR_API size_t fr_kalman_filter_size(const fr_kalman_filter_config *config);
FR_API fr_status fr_kalman_filter_init(void *memory, size_t size,
                                       const fr_kalman_filter_config *config,
                                       fr_kalman_filter **out);
/* A reading of height in m, vertical velocity in m/s, pitch and roll in rad; all but the height may
 * be NaN. `variances` are those of the four, NaN or the whole NULL for those of the settings; those
 * of readings that come faster than 22 Hz count for less. Give readings with fixed ambiguities
 * alone. FR_BAD_SAMPLE for values beyond 1e9 and variances beyond 1e-18 to 1e9, FR_TOO_LATE if its
 * sample has been filtered or has a reading, FR_QUEUE_FULL if too many wait, FR_WRONG_ORDER if the
 * settings are without GNSS. */
FR_API fr_status fr_kalman_filter_push_gnss(fr_kalman_filter *filter, int64_t sample,
                                            const double values[4], const double variances[4]);
/* The floating reference height in m of every sample, `late_s` behind the input. FR_BAD_SAMPLE for
 * samples beyond 1e9. */
FR_API fr_status fr_kalman_filter_push(fr_kalman_filter *filter, const fr_imu *imu,
                                       const double *height, const int64_t *counts, size_t count,
                                       double *reference_height, size_t capacity, size_t *written);
/* End the run: the samples that still wait. */
FR_API fr_status fr_kalman_filter_finish(fr_kalman_filter *filter, double *reference_height,
                                         size_t capacity, size_t *written);
/* Readings left out so far, because they were ten times their expected 1-sigma off, by kind. */
FR_API fr_status fr_kalman_filter_left_out(const fr_kalman_filter *filter, int64_t count[4]);

/* ---------------------------------------------------------------------------------------------
 * The Kalman smoother with a fixed lag (6.6.2 to 6.6.5): that filter, smoothed back. Points of the
 * profile over distance come out in sections of half a lag, with at least the lag behind them, in
 * bounded memory. A standstill of any length takes no more; what a lag is too short for is flagged.
 *
 * Memory in bytes, near enough, with hz = 101 + gnss_hz nodes per second, at 100 Hz or more:
 * lag_s (1656 hz + 48 fastest_mps / interval_m + 468 fastest_mps + 70 hz).
 */
typedef struct fr_kalman_config {
    fr_kalman_filter_config filter;
    double interval_m;   /* between points; no default */
    double lag_s;        /* a point has so much time behind it, 1 to 3600; 60, without GNSS 180 */
    double fastest_mps;  /* at a higher speed the lag is shorter, 0.1 to 200; 40 */
    double gnss_hz;      /* at more readings per second the lag is shorter, 0 to 1000; 20 */
    double wavelength_m; /* cut-off of each pass of HPF_B3x2, for the 1-sigma, interval_m to 1e9;
                            105.91 */
    double tolerance_m;  /* 1-sigma of what may change, above which a point is flagged, 0 to
                            1e9; 1e-4 */
} fr_kalman_config;

typedef struct fr_kalman fr_kalman;

FR_API fr_kalman_config fr_kalman_defaults(void);
FR_API fr_kalman_config fr_kalman_inertial_defaults(void);
FR_API size_t fr_kalman_size(const fr_kalman_config *config);
FR_API fr_status fr_kalman_init(void *memory, size_t size, const fr_kalman_config *config,
                                fr_kalman **out);
/* As fr_kalman_filter_push_gnss(). */
FR_API fr_status fr_kalman_push_gnss(fr_kalman *kalman, int64_t sample, const double values[4],
                                     const double variances[4]);
/* Elevation in m of the points that are ready, before any high-pass filter, its 1-sigma in m behind
 * HPF_B3x2, and flags FR_POINT_... of each. FR_OUTPUT_FULL says how many points are ready. A point
 * whose height is missing is NaN. */
FR_API fr_status fr_kalman_push(fr_kalman *kalman, const fr_imu *imu, const double *height,
                                const int64_t *counts, size_t count, fr_real *elevation,
                                fr_real *sigma, uint8_t *flags, size_t capacity, size_t *written);
/* End the run: all points that are left. */
FR_API fr_status fr_kalman_finish(fr_kalman *kalman, fr_real *elevation, fr_real *sigma,
                                  uint8_t *flags, size_t capacity, size_t *written);
/* As fr_kalman_filter_left_out(). */
FR_API fr_status fr_kalman_left_out(const fr_kalman *kalman, int64_t count[4]);
/* ---------------------------------------------------------------------------------------------
 * Levelling by the road: the pitch of the body through a stretch in which the vehicle brakes, stands
 * or sets off, from the slope that its sensors measure themselves (docs/road-prior-slope.md). One
 * fit of bins, each the mean of all wheel paths, by least squares over pitch, lean, bias, springs
 * and road. Double in both builds. No object: the memory is used during the call alone, and its size
 * follows from the longest stretch. A fit is made once for each stop; it takes some 0.1 s on a PC.
 */
typedef struct fr_level_fit_config {
    double step_s;        /* from bin to bin, 0.002 to 0.06; 0.01 */
    double front_m;       /* front axle ahead of the laser, within 100 of 0; no default */
    double rear_m;        /* rear axle ahead of the laser, 0.1 to 100 less than that, and within 100 of
                           * 0; no default */
    double lever_m;       /* laser ahead of its accelerometer, within 100 of 0; 0 */
    double wavelength_m;  /* cut-off of the high-pass that the profile passes, 1 to 1000; 105.91 */
    /* Densities and 1-sigmas are 1e-12 to 1e6. */
    double road_m;        /* intensity of the road's elevation; 4e-6 */
    double bends_per_m;   /* intensity of a plain road's slope, in 1/m; 2e-7 */
    double acceleration;  /* density of the accelerometer, in m/s^2/sqrt(Hz); 1.5e-4 */
    double missing_acceleration; /* the same where samples are missing; 0.3 */
    double bias;          /* 1-sigma of its bias in m/s^2; 0.03 */
    double walk;          /* and of its walk in m/s^2/sqrt(s); 1e-4 */
    double gain;          /* expected pitch per force along the road, in rad per m/s^2, 0.0005 to 0.02;
                           * 0.00431 */
    double gain_sigma;    /* and its 1-sigma; 0.00371 */
    double lean_rad;      /* expected lean of the accelerometer's axis backward, within 1 of 0; 0 */
    double lean_sigma_rad; /* and its 1-sigma, 0.03 over the root of wheel paths; 0.0212 for two */
    double pitch_hz;      /* natural frequency of the body in pitch, 0.01 to 100; 1.6 */
    double pitch_damping; /* and its damping ratio, 1e-3 to 1; 0.3 */
    double longest_s;     /* longest stretch in bins that are given, 2 to 600; 120 */
    double most_travel_m; /* longest stretch of road, 1 to 10000; 1500 */
    int32_t most_width;   /* unknowns that may be together at a time, 16 to 512; 96 */
    int32_t reserved;     /* 0 */
} fr_level_fit_config;

/* Bins in order, `count` in each array. `number` rises (FR_WRONG_ORDER) and is within 2^50 of zero;
 * where it leaps, bins were left out, as in the middle of a standstill. Pieces shorter than 0.5 s are
 * not used. Values are within 1e9 of 0 (FR_BAD_SAMPLE). */
typedef struct fr_level_bins {
    const int64_t *number;  /* of a bin in the run */
    const double *force;    /* vertical specific force less 1 g, in m/s^2 */
    const double *missing;  /* share of it that was missing and is bridged, 0 to 1 */
    const double *height;   /* of the laser over the road, in m; NaN where it is missing */
    const double *distance; /* of the encoder, in m; does not fall (FR_GOES_BACK) */
    const double *speed;    /* in m/s */
    const double *along;    /* acceleration along the road, in m/s^2 */
    size_t count;
} fr_level_bins;

/* What became of a stretch. Only the first is levelled. */
enum {
    FR_LEVEL_FOUND = 0,
    FR_LEVEL_TOO_SHORT = 1, /* no three nodes follow each other */
    FR_LEVEL_TOO_LONG = 2,  /* more bins, road or unknowns at a time than the memory is for */
    FR_LEVEL_UNSETTLED = 3, /* the fit has not settled */
    FR_LEVEL_UNLIKELY = 4   /* it has settled on a vehicle that there hardly is */
};

typedef struct fr_level_result {
    double vehicle[8];   /* gain in rad per m/s^2, lean in rad, place of the centre of gravity, ln of
                            front and rear stiffness and damping, and of the gyration */
    double grade;        /* mean slope of the road, which a high-pass removes */
    double changed_rad;  /* largest change of a pitch by the last step */
    double prior_misfit; /* squares by which constants are off what is expected, over their 1-sigma */
    int32_t passes;      /* of the fit */
    int32_t outcome;     /* FR_LEVEL_FOUND to FR_LEVEL_UNLIKELY */
} fr_level_result;

FR_API fr_level_fit_config fr_level_fit_defaults(void);
/* Bytes of memory, 0 for a setting that is not possible. */
FR_API size_t fr_level_fit_size(const fr_level_fit_config *config);
/* Pitch in rad, nose up, and 1-sigma in m of the high-passed elevation that it leaves, of every bin.
 * They are 0 and 0.05 unless the outcome is FR_LEVEL_FOUND. A force is level by adding
 * a (P - grade) + g (P^2 - lean^2) / 2 with P = pitch + lean and `along` for a; a height is carried
 * to the accelerometer by taking lever sin(pitch) from it. */
FR_API fr_status fr_level_fit(const fr_level_fit_config *config, void *memory, size_t size,
                              const fr_level_bins *bins, fr_level_result *result, double *pitch,
                              double *sigma_m, size_t capacity, size_t *written);

/* ---------------------------------------------------------------------------------------------
 * The same as samples come: bins of about 10 ms, the stretches in which the vehicle brakes, stands
 * or sets off with the road before and behind, and a fit of each. What comes out is for bins: what
 * has to be added to every force, and the pitch by which heights are carried to the accelerometer.
 *
 * Away from brakes a bin is ready when the vehicle has gone on for 60 m, or has moved for 30 s. At a
 * brake it waits until the stretch ends, 90 m behind it, and has gone on for as much. The middle of
 * a standstill is left out, so one of any length takes constant memory. A stretch of more than
 * fit.longest_s or fit.most_travel_m is fitted in windows that share 20 s. Where a fit is not found
 * the outcome says why, the share is 0 and the 1-sigma is 0.05 m.
 *
 * A push makes the fits of the stretches that end in it, each of some 0.1 s on a PC. Between brakes the
 * pitch stays as the last brake has left it; fr_pitch models it there.
 */
typedef struct fr_level_config {
    double rate_hz;          /* samples per second, 20 to 1e6; no default */
    double metres_per_count; /* of the encoder, at most 10; no default */
    fr_level_fit_config fit; /* its step follows from the rate; here longest_s is 40 or more and
                                most_travel_m 200 or more */
    int32_t paths;           /* wheel paths, 1 to 4; 2 */
    int32_t back;            /* FR_BACK_REFUSED or FR_BACK_TAKEN; FR_BACK_REFUSED */
    int32_t missing;         /* FR_MISSING_REFUSED, or FR_MISSING_BRIDGED: it does not count in its
                                bin, and a bin of which more than half is missing is not known */
    int32_t reserved;        /* 0 */
} fr_level_config;

/* No brake: the bin is in no stretch. Beside FR_LEVEL_FOUND and so on. */
enum { FR_LEVEL_NO_BRAKE = -1 };

/* Its middle is at sample `first` + (every - 1) / 2 of the run. Between bins all are linear in time,
 * also across those that are left out in a standstill. */
typedef struct fr_level_bin {
    int64_t first;    /* its first sample */
    double added;     /* to every force, in m/s^2 */
    double sin_pitch; /* a height is less by this times the lever of its laser */
    double share;     /* to which it is levelled, 0 to 1 */
    double sigma_m;   /* 1-sigma of the high-passed elevation that this leaves */
    int32_t outcome;  /* FR_LEVEL_NO_BRAKE to FR_LEVEL_UNLIKELY: the worst of its fits */
    int32_t reserved; /* 0 */
} fr_level_bin;

typedef struct fr_level fr_level;

FR_API fr_level_config fr_level_defaults(void);
FR_API size_t fr_level_size(const fr_level_config *config);
FR_API fr_status fr_level_init(void *memory, size_t size, const fr_level_config *config,
                               fr_level **out);
/* Samples of a bin. */
FR_API fr_status fr_level_every(const fr_level *level, int64_t *every);
/* `force` with 1 g in it, in m/s^2, and `height` in m, down to the road, of all wheel paths of a
 * sample, then of the next: count * paths values, within 1e9 of 0 (FR_BAD_SAMPLE). FR_TOO_MANY for more
 * than 20 s at a time. FR_OUTPUT_FULL unless the bins that are ready are taken before: *ready is their
 * number. */
FR_API fr_status fr_level_push(fr_level *level, const fr_real *force, const fr_real *height,
                               const int64_t *counts, size_t count, size_t *ready);
/* End the run: all bins become ready. */
FR_API fr_status fr_level_finish(fr_level *level, size_t *ready);
/* The bins that are ready, the first `capacity` of them, after the end too. */
FR_API fr_status fr_level_take(fr_level *level, fr_level_bin *bins, size_t capacity,
                               size_t *written);

/* ---------------------------------------------------------------------------------------------
 * The pitch of the body from force, height and encoder, for a laser ahead of its accelerometer or
 * behind it: that of a usual half car over the road that is measured, which the accelerometer
 * corrects. Double in both builds. What comes out is the sine of the pitch in bins of about 10 ms,
 * those of fr_level; a height is less by it times the lever of its laser. It has frequencies of
 * 0.3 to 20 Hz, and what slower braking adds.
 *
 * A run is modelled in windows of window_s and the shared_s behind them, in which one passes into
 * the next. A bin is ready when its window is complete, or the run has ended. Where road and brakes
 * explain less than a quarter of how the accelerometer moves, as in a bounce test, and without a
 * force or a height anywhere in a window, it is 0.
 */
typedef struct fr_pitch_config {
    double rate_hz;          /* samples per second, 20 to 1e6; no default */
    double metres_per_count; /* of the encoder, at most 10; no default */
    double front_m;          /* front axle ahead of the middle of the lasers; the three places are
                                within 100 of 0; no default */
    double rear_m;           /* rear axle ahead of it, at least 0.1 less than that; no default */
    double lever_m;          /* middle of the lasers ahead of that of their accelerometers; 0 */
    double window_s;         /* shared_s to 3600; 600 */
    double shared_s;         /* at least 5; 30 */
    int32_t paths;           /* wheel paths, 1 to 4; 2 */
    int32_t back;            /* FR_BACK_REFUSED or FR_BACK_TAKEN; FR_BACK_REFUSED */
    int32_t missing;         /* FR_MISSING_REFUSED, or FR_MISSING_BRIDGED: it does not count in its
                                bin, and a bin of which more than half is missing is on a line */
    int32_t reserved;        /* 0 */
} fr_pitch_config;

typedef struct fr_pitch fr_pitch;

FR_API fr_pitch_config fr_pitch_defaults(void);
FR_API size_t fr_pitch_size(const fr_pitch_config *config);
FR_API fr_status fr_pitch_init(void *memory, size_t size, const fr_pitch_config *config,
                               fr_pitch **out);
/* Samples of a bin: the middle of bin k is at sample k every + (every - 1) / 2 of the run. */
FR_API fr_status fr_pitch_every(const fr_pitch *pitch, int64_t *every);
/* The samples of fr_level_push(). FR_TOO_MANY for more than window_s at a time, FR_OUTPUT_FULL if they
 * complete a window and bins of the one before are ready and not taken: *ready is their number. */
FR_API fr_status fr_pitch_push(fr_pitch *pitch, const fr_real *force, const fr_real *height,
                               const int64_t *counts, size_t count, size_t *ready);
/* End the run: all bins become ready. What is ready has to be taken before. */
FR_API fr_status fr_pitch_finish(fr_pitch *pitch, size_t *ready);
/* The sine of the pitch, nose up, of the bins that are ready, the first `capacity` of them, after the
 * end too. They are those behind the ones taken before, without a gap. */
FR_API fr_status fr_pitch_take(fr_pitch *pitch, double *sin_pitch, size_t capacity, size_t *written);

#ifdef __cplusplus
}
#endif

#endif
