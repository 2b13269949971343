/* SPDX-License-Identifier: Apache-2.0
 *
 * Calls drawn at random, possible and impossible ones: fuzz SEED SECONDS
 *
 * Built with the address and the undefined behaviour sanitizer. Memory and arrays have exactly the
 * sizes that the library was given, and a refused call may change neither the object nor an output.
 */
#include <stdio.h>
#include <time.h>

#include "c_draws.h"

enum { STALE = 77777, LARGEST = 1 << 23, CALLS = 67, KINDS = 22, LEVEL = 20, PITCH = 21 };

typedef union any_config {
    fr_filter_config filter;
    fr_varying_config varying;
    fr_integral_config integral;
    fr_travel_speed_config travel_speed;
    fr_projection_config projection;
    fr_time_step_config time_step;
    fr_adaptive_config adaptive;
    fr_high_pass_set_config high_pass_set;
    fr_adaptive_set_config adaptive_set;
    fr_local_suppression_config local_suppression;
    fr_matched_high_pass_config matched_high_pass;
    fr_iri_config iri;
    fr_screening_config screening;
    fr_road_prior_config road_prior;
    fr_kalman_filter_config kalman_filter;
    fr_kalman_config kalman;
    fr_causes_config causes;
    fr_saturation_config saturation;
    fr_encoder_screening_config encoder_screening;
    fr_usual_config usual;
    fr_level_config level;
    fr_pitch_config pitch;
} any_config;

static void set_kalman(fr_kalman_filter_config *c, double count_m)
{
    c->travel.rate_hz = 50;
    c->travel.metres_per_count = count_m;
    c->late_s = draw(2) * 0.5;
    c->gnss = (int)draw(4) > 0;
    c->reflects = (int)draw(2);
    c->missing = (int)draw(2);
    c->readings = 1 + (int)draw(20);
}

#define KIND(number, name, line)                                                                \
    case number:                                                                                \
        if (what == 0) {                                                                        \
            fr_##name##_config c = fr_##name##_defaults();                                      \
            line;                                                                               \
            config->name = c;                                                                   \
        } else if (what == 1)                                                                   \
            *size = fr_##name##_size(&config->name);                                            \
        else                                                                                    \
            return fr_##name##_init(memory, *size, &config->name, (fr_##name **)out);           \
        return FR_OK;

/* Fill a configuration (0), say its size (1), or initialize an object (2). */
static fr_status of_kind(int kind, int what, any_config *config, size_t *size, void *memory,
                         void **out)
{
    double step = 0.004, count_m = draw(2) ? 0.001 : 0.01, interval = 0.05 + 0.01 * draw(40);
    switch (kind) {
        KIND(0, filter, c.step = step; c.cutoff = 0.45; c.order = 1 + (int)draw(2);
             c.passes = 1 + (int)draw(2); c.direction = 1 + (int)draw(2))
        KIND(1, varying, c.step = step; c.sections = 1 + (int)draw(4); c.form = (int)draw(2);
             c.direction = 1 + (int)draw(2); c.missing = (int)draw(2))
        KIND(2, integral, c.step_s = step; c.missing = (int)draw(2))
        KIND(3, travel_speed, c.rate_hz = 250; c.metres_per_count = count_m; c.back = (int)draw(2))
        KIND(4, projection, c.interval_m = interval; c.metres_per_count = count_m; c.rate_hz = 250)
        KIND(5, time_step, c.seconds_per_tick = step)
        KIND(6, adaptive, c.travel.rate_hz = 250; c.travel.metres_per_count = count_m;
             c.interval_m = interval; c.missing = (int)draw(2); c.cut_off_every = 1 + (int)draw(9))
        KIND(7, high_pass_set, c.step = step; c.cutoff = 0.45; c.missing = (int)draw(2))
        KIND(8, adaptive_set, c.rate_hz = 250; c.missing = (int)draw(2))
        KIND(9, local_suppression, c.rate_hz = 250; c.missing = (int)draw(2))
        KIND(10, matched_high_pass, c.rate_hz = 250; c.missing = (int)draw(2))
        KIND(11, iri, c.interval_m = interval)
        KIND(12, screening, c.rate_hz = 250; c.metres_per_count = count_m;
             c.spread_mps2 = draw(2) * 0.1; c.range_greatest = 5.0 * draw(2))
        KIND(13, road_prior, c.rate_hz = 250; c.metres_per_count = count_m;
             c.interval_m = interval; c.node_rate_hz = 10.0 + draw(300); c.lag_s = 0.1 + 0.1 * draw(9);
             c.missing = (int)draw(2); c.back = (int)draw(2); c.fastest_mps = 20.0 + draw(99))
        KIND(14, kalman_filter, set_kalman(&c, count_m))
        KIND(15, kalman, set_kalman(&c.filter, count_m); c.interval_m = 10 * interval; c.lag_s = 2;
             c.gnss_hz = 5; c.fastest_mps = 10)
        KIND(16, causes, c.rate_hz = 250; c.metres_per_count = count_m; c.interval_m = interval;
             c.every = 1 + (int)draw(3))
        KIND(17, saturation, c.range_least = 5 - (int)draw(9); c.range_greatest = 15;
             c.farthest = 1 + (int)draw(99); c.outermost_mps2 = 1; c.quantum = 0.01 * draw(9))
        KIND(18, encoder_screening, c.rate_hz = 250; c.metres_per_count = count_m)
        KIND(19, usual, c.longest = 2 + (int)draw(99))
        KIND(20, level, c.rate_hz = 20.0 + 20.0 * draw(2); c.metres_per_count = count_m;
             c.fit.front_m = 1.5; c.fit.rear_m = -1.5; c.fit.longest_s = 40.0;
             c.fit.most_travel_m = 200.0; c.fit.most_width = 16 + 8 * (int)draw(8);
             c.paths = 1 + (int)draw(2); c.back = (int)draw(2); c.missing = (int)draw(2))
        KIND(21, pitch, c.rate_hz = 20.0 + 20.0 * draw(2); c.metres_per_count = count_m;
             c.front_m = 0.1 + draw(20); c.rear_m = -1.5 * draw(2); c.lever_m = 0.3;
             c.window_s = 5.0; c.shared_s = 5.0; c.paths = 1 + (int)draw(4); c.back = (int)draw(2);
             c.missing = (int)draw(2))
    default:
        return FR_BAD_CONFIG;
    }
}

/* A reading of GNSS at a sample near those that come next. */
static fr_status read_gnss(int smoother, void *o)
{
    double values[4], variances[4];
    int64_t sample = draw(9) ? (int64_t)draw(2500) : -(int64_t)draw(3);
    double *given = draw(3) ? NULL : variances;
    for (int i = 0; i < 4; i++) {
        values[i] = number();
        variances[i] = draw(3) ? NAN : number();
    }
    return smoother ? fr_kalman_push_gnss(o, sample, draw(99) ? values : NULL, given)
                    : fr_kalman_filter_push_gnss(o, sample, draw(99) ? values : NULL, given);
}

static double *as_double(const fr_real *x, size_t count, double least, double most)
{
    double *y = malloc(count * sizeof *y + (count == 0));
    for (size_t i = 0; i < count; i++)
        y[i] = draw(2000) == 0 ? odd_number() : fmin(fmax((double)x[i], least), most);
    return y;
}

/* A brake on a flat road, so that a fit is found. */
static void calm(double *const *columns, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double step = 0.05 * (double)i;
        columns[0][i] = 1e-4 * fmin(fmax(columns[0][i], -20.0), 20.0);
        columns[1][i] = 0.0;
        columns[2][i] = 0.3 + 1e-6 * fmin(fmax(columns[2][i], -20.0), 20.0);
        columns[4][i] = fmax(8.0 - step, 0.0);
        columns[5][i] = step < 8.0 ? -1.0 : 0.0;
    }
}

/* A fit of drawn bins in memory of exactly its size; a refused one may not change it. */
static fr_status fit_bins(arrays *a)
{
    fr_level_fit_config c = fr_level_fit_defaults();
    double *columns[6], *pitch = malloc((a->capacity + 1) * 2 * sizeof *pitch), at = 0.0;
    fr_level_bins bins = {a->n, NULL, NULL, NULL, NULL, NULL, NULL, a->count};
    fr_level_result result;
    size_t size;
    fr_status status;
    void *memory;
    c.step_s = draw(2) ? 0.05 : 0.02;
    c.front_m = draw(2) ? 1.5 : 20.0;
    c.rear_m = c.front_m - 3.0;
    c.longest_s = draw(9) ? 12.0 : 2.0;
    c.most_travel_m = draw(9) ? 100.0 : 1.0;
    c.most_width = 16 + 8 * (int)draw(12);
    size = fr_level_fit_size(&c);
    memory = calloc(1, size);
    for (int i = 0; i < 6; i++)
        columns[i] = as_double(i % 2 ? a->h : a->x, a->count, i == 1 ? 0.0 : -1e9, i == 1 ? 1.0 : 1e9);
    if (draw(2) == 0)
        calm(columns, a->count);
    for (size_t i = 0; i < a->count; i++) {
        columns[3][i] = at += columns[4][i] * 0.02;
        a->n[i] = i == 0 ? 0 : a->n[i - 1] + (draw(40) ? 1 : 1 + (int64_t)draw(1000));
    }
    bins.force = columns[0];
    bins.missing = columns[1];
    bins.height = columns[2];
    bins.distance = columns[3];
    bins.speed = columns[4];
    bins.along = columns[5];
    status = fr_level_fit(&c, memory, size, &bins, &result, pitch, pitch + a->capacity, a->capacity,
                          &a->written);
    for (int i = 0; i < 6; i++)
        free(columns[i]);
    free(pitch);
    free(memory);
    return status;
}

/* Levelling: four wheel paths are four times as many values, so a push has a quarter of its arrays. */
static fr_status call_level(int which, void *o, arrays *a)
{
    fr_level_bin *bins = malloc((a->capacity + 1) * sizeof *bins);
    int64_t every;
    fr_status status = FR_OK;
    switch (which) {
    case 20: status = fr_level_push(o, a->x, a->h, a->n, a->count / 4, &a->written); break;
    case 60: status = fr_level_take(o, bins, a->capacity, &a->written); break;
    case 61: status = fr_level_finish(o, &a->written); break;
    case 62: status = fr_level_every(o, &every); break;
    default: status = fit_bins(a); break;
    }
    free(bins);
    return status;
}

static fr_status call_pitch(int which, void *o, arrays *a)
{
    int64_t every;
    switch (which) {
    case 21: return fr_pitch_push(o, a->x, a->h, a->n, a->count / 4, &a->written);
    case 56: return fr_pitch_take(o, a->heights, a->capacity, &a->written);
    case 57: return fr_pitch_finish(o, &a->written);
    default: return fr_pitch_every(o, &every);
    }
}

/* One of the calls that take a finished profile, without an object. */
static fr_status call_profile(int which, arrays *a)
{
    fr_validity_config validity = fr_validity_defaults();
    fr_cross_correlation_config lags = {0.1, 0.5};
    fr_high_pass_profile_config display = {0.1, number()};
    fr_agreement agreement;
    fr_seam_config seam = {0.1, number(), number()};
    validity.interval_m = number();
    validity.drift_m = number();
    switch (which) {
    case 51: return fr_validity(&validity, a->flags, a->count, a->b, a->capacity, &a->written);
    case 52: return fr_cross_correlation(&lags, a->x, a->h, a->count, &agreement);
    case 64: return fr_seam(&seam, draw(1000), draw(2000), a->x, a->count);
    default: return fr_high_pass_profile(&display, a->x, a->count, a->y, a->capacity, &a->written);
    }
}

/* One of the calls; it may be of another kind of object. */
static fr_status call(int which, void *o, arrays *a)
{
    size_t n = a->count, room = a->capacity, *w = &a->written;
    fr_cut_off_config cut_off = fr_cut_off_defaults();
    fr_timer_distortion_config timer = {0.05, 3.576, 25.0};
    fr_imu imu = {a->imu[0], a->imu[1], a->imu[2], a->imu[3], a->imu[4], a->imu[5]};
    int64_t left_out[4];
    fr_usual_values usual;
    switch (which) {
    case 16: return fr_causes_push(o, a->n, draw(9) ? a->flags : NULL, n, a->b, room, w);
    case 17: return fr_saturation_push(o, a->x, n, a->spans, room, w);
    case 18: return fr_encoder_screening_push(o, a->n, n, a->spans, room, w);
    case 19: return draw(4) ? fr_usual_push(o, a->x, n) : fr_usual_push_counts(o, a->n, n);
    case 65: return fr_usual_push_counts(o, a->n, n);
    case 66: return fr_encoder_screening_push_timed(o, a->n, a->n, n, a->spans, room, w);
    case 47: return fr_causes_finish(o, a->b, n < room ? n : room);
    case 48: return fr_saturation_finish(o, a->spans, room, w);
    case 49: return fr_encoder_screening_finish(o, a->spans, room, w);
    case 50: return fr_usual_value(o, draw(9) ? &usual : NULL);
    case 51:
    case 52:
    case 53:
    case 64: return call_profile(which, a);
    case 12: return fr_screening_push(o, a->x, draw(9) ? a->h : NULL, a->n, n, a->spans, room, w);
    case 30: return fr_screening_finish(o, a->spans, room, w);
    case 31: return fr_high_pass_set_velocity(o, a->x, n, a->y, room, w);
    case 0: return fr_filter_push(o, a->x, n, a->y, room, w);
    case 1: return fr_varying_push(o, a->x, a->f, n, a->y, room, w);
    case 2: return fr_integral_push(o, a->x, n, a->y, room, w);
    case 3: return fr_travel_speed_push(o, a->n, n, a->y, room, w);
    case 4: return fr_projection_push(o, a->n, a->x, n, a->y, room, w);
    case 5: return fr_time_step_push(o, a->n, n, a->y, room, w);
    case 6: return fr_adaptive_push(o, a->x, a->h, a->n, n, a->y, a->z, room, w);
    case 7: return fr_high_pass_set_acceleration(o, a->x, n, a->y, room, w);
    case 8: return fr_adaptive_set_acceleration(o, a->x, a->f, n, a->y, room, w);
    case 9: return fr_local_suppression_push(o, a->x, a->f, n, a->y, room, w);
    case 10: return fr_matched_high_pass_push(o, a->x, a->h, a->f, n, a->y, room, w);
    case 11: return fr_iri_push(o, a->x, n, a->y, room, w);
    case 13: return fr_road_prior_push(o, a->x, a->h, a->n, n, a->y, a->z, a->b, room, w);
    case 38:
        return fr_road_prior_push_levelled(o, a->x, a->h, a->n, draw(2) ? a->p : NULL,
                                           draw(2) ? a->p : NULL, n, a->y, a->z, a->b, room, w);
    case 39: return fr_road_prior_finish(o, a->y, a->z, a->b, room, w);
    case 40: return fr_high_pass_set_height(o, a->h, n, a->y, room, w);
    case 32: return fr_high_pass_set_reverse(o, a->x, n, a->y, room, w);
    case 33: return fr_high_pass_set_finish(o);
    case 14:
        if (draw(2))
            return read_gnss(0, o);
        return fr_kalman_filter_push(o, &imu, a->imu[6], a->n, n, a->heights, room, w);
    case 15:
        if (draw(2))
            return read_gnss(1, o);
        return fr_kalman_push(o, &imu, a->imu[6], a->n, n, a->y, a->z, a->b, room, w);
    case 34: return fr_kalman_filter_finish(o, a->heights, room, w);
    case 35: return fr_kalman_finish(o, a->y, a->z, a->b, room, w);
    case 36: return fr_kalman_filter_left_out(o, left_out);
    case 37: return fr_kalman_left_out(o, draw(9) ? left_out : NULL);
    case 43: return fr_adaptive_set_velocity(o, a->x, a->f, n, a->y, room, w);
    case 44: return fr_adaptive_set_height(o, a->h, a->f, n, a->y, room, w);
    case 45: return fr_adaptive_set_reverse(o, a->x, a->f, n, a->y, room, w);
    case 46:
        return fr_adaptive_set_reverse_over_distance(o, number(), a->x, a->f, n, a->y, room, w);
    case 59: return fr_adaptive_set_finish(o);
    case 20:
    case 60:
    case 61:
    case 62:
    case 63: return call_level(which, o, a);
    case 21:
    case 56:
    case 57:
    case 58: return call_pitch(which, o, a);
    case 29: return fr_adaptive_finish(o, a->x, a->f, n, a->y, room, w);
    case 22: return fr_iri_finish(o, a->y, room, w);
    case 23: return fr_iri_value(o, a->capacity > 0 ? a->y : NULL);
    case 24: return fr_integral_push_steps(o, a->x, a->f, n, a->y, room, w);
    case 25: return fr_integral_push_reflecting(o, a->x, a->h, a->f, a->s, n, a->y, room, w);
    case 26: return fr_projection_push_timed(o, a->n, a->x, n, a->y, a->z, room, w);
    case 27: return fr_cut_off_frequency(&cut_off, a->x, n, a->y, room, w);
    case 28: return fr_cut_off_wave_number(&cut_off, number(), a->x, n, a->y, room, w);
    default: return fr_timer_distortion_steps(&timer, a->f, n, a->y, room, w);
    }
}

static int fail(const char *what, int kind, int which)
{
    printf("%s: kind %d, call %d\n", what, kind, which);
    return 1;
}

/* The same with NULL in place of arrays that have no sample: they need no memory. */
static arrays without_empty(const arrays *a)
{
    arrays given = *a;
    if (a->count == 0) {
        given.x = given.h = given.f = given.s = given.p = NULL;
        given.n = NULL;
    }
    if (a->capacity == 0) {
        given.y = given.z = NULL;
        given.b = NULL;
        given.spans = NULL;
        given.heights = NULL;
    }
    return given;
}

/* Whether a refused call has left a number written; a call without one leaves it as it was. */
static int is_stale(fr_status status, size_t written)
{
    return status != FR_OUTPUT_FULL && written != 0 && written != STALE;
}

/* One push into an object of `size` bytes, which may be moved; 1 if a refusal changed something. */
static int push_once(int kind, void **object, size_t size, int64_t *counts, long *done)
{
    int which = draw(8) ? kind : (int)draw(CALLS), wrong = 0;
    if (kind == LEVEL && draw(4) == 0)
        which = draw(9) ? 60 : 61;
    if (kind == PITCH && draw(4) == 0)
        which = draw(9) ? 56 : 57;
    arrays a = drawn_arrays(counts);
    unsigned char *before = malloc(size);
    fr_real *y = malloc(2 * a.capacity * sizeof *y + (a.capacity == 0)), *z = y + a.capacity;
    memcpy(before, *object, size);
    memcpy(y, a.y, a.capacity * sizeof *y);
    memcpy(z, a.z, a.capacity * sizeof *z);
    arrays given = draw(2) ? without_empty(&a) : a;
    given.written = STALE;
    fr_status status = call(which, *object, &given);
    if (status != FR_OK)
        wrong = memcmp(before, *object, size) != 0 ||
                memcmp(y, a.y, a.capacity * sizeof *y) != 0 ||
                memcmp(z, a.z, a.capacity * sizeof *z) != 0 || is_stale(status, given.written);
    else
        ++*done;
    if (draw(9) == 0) {
        void *moved = malloc(size);
        memcpy(moved, *object, size);
        free(*object);
        *object = moved;
    }
    free(before);
    free(y);
    release(&a);
    return wrong ? fail("a refused call changed something", kind, which) : 0;
}

static void change_setting(any_config *config)
{
    size_t at = 4 * draw(sizeof *config / 4);
    double odd = odd_number();
    int32_t whole = draw(2) ? (int32_t)draw(5) : -(int32_t)draw(99999);
    if (at % 8 == 0 && draw(2))
        memcpy((unsigned char *)config + at, &odd, sizeof odd);
    else
        memcpy((unsigned char *)config + at, &whole, sizeof whole);
}

static int one_object(long *done, long *objects)
{
    any_config config;
    size_t size = 0, needed;
    int rare = draw(100) == 0, kind = rare ? LEVEL : (int)draw(KINDS - 1), wrong = 0;
    void *object, *out = NULL;
    int64_t counts = draw(1000);
    kind = kind == LEVEL && !rare ? PITCH : kind; /* levelling has 8 MB */
    memset(&config, 0, sizeof config);
    of_kind(kind, 0, &config, NULL, NULL, NULL);
    if (draw(3) == 0)
        change_setting(&config);
    of_kind(kind, 1, &config, &size, NULL, NULL);
    if (size > LARGEST)
        return 0;
    needed = size;
    object = malloc(size > 0 ? size : 1);
    if (of_kind(kind, 2, &config, &needed, object, &out) != (size > 0 ? FR_OK : FR_BAD_CONFIG))
        wrong = fail("size and init disagree", kind, 0);
    *objects += size > 0;
    for (int i = 0; size > 0 && !wrong && i < (kind >= LEVEL ? 60 : 12); i++)
        wrong = push_once(kind, &object, size, &counts, done);
    free(object);
    return wrong;
}

int main(int argc, char **argv)
{
    time_t end;
    long done = 0, objects = 0;
    if (argc != 3)
        return 2;
    state = strtoull(argv[1], NULL, 10);
    end = time(NULL) + strtol(argv[2], NULL, 10);
    while (time(NULL) < end)
        for (int i = 0; i < 200; i++)
            if (one_object(&done, &objects))
                return 1;
    printf("%ld objects, %ld calls that did their work\n", objects, done);
    return done > 1000 ? 0 : 1;
}
