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
 * the number written; 0 on a refusal, but for FR_OUTPUT_FULL the room that is needed.
 *
 * Samples. fr_real is double, or float if FR_FLOAT is defined, for the library and for its callers;
 * fr_real_size() tells one from the other at run time. Settings are double in both. Distances are
 * counts of the encoder, which are exact at any length. Infinite samples are refused; so are
 * missing ones (NaN), unless `missing` is FR_MISSING_BRIDGED: then the sample before is repeated.
 *
 * Equations (5.3) and so on are those of Karamihas (2021), as in the SDK.
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
    FR_WRONG_ORDER = 5,    /* the run has ended, or a call comes before one that it needs */
    FR_BAD_CONFIG = 6,     /* a setting is out of its range, zero, infinite or NaN */
    FR_BAD_SAMPLE = 7,     /* a sample is infinite, missing (NaN), or out of its range */
    FR_BAD_CUTOFF = 8,     /* a cut-off, or that of a speed, is not within 0 to half the rate */
    FR_GOES_BACK = 9,      /* the encoder counts go back */
    FR_OUTPUT_FULL = 10,   /* the output has no room; *written is the room that is needed */
    FR_TOO_MANY = 11,      /* more samples in one push than memory can hold */
    FR_INCOMPLETE_SET = 12, /* not all signals of the set have passed with equally many samples */
    FR_OTHER_SPEED = 13    /* signals of one set were given different speeds */
};

/* What happens to a missing (NaN) sample. */
enum { FR_MISSING_REFUSED = 0, FR_MISSING_BRIDGED = 1 };

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
    double cutoff;     /* of the third-order filter, in Hz or in cycles/m; no default */
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
    double step_s;   /* between samples; no default, not used by the two calls over points */
    double start;    /* value of the integral at the first sample; 0 */
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

#ifdef __cplusplus
}
#endif

#endif
