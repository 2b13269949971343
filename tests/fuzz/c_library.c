/* SPDX-License-Identifier: Apache-2.0
 *
 * Calls drawn at random, possible and impossible ones: fuzz SEED SECONDS
 *
 * Built with the address and the undefined behaviour sanitizer. Memory and arrays have exactly the
 * sizes that the library was given, and a refused call may change neither the object nor an output.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "floatref.h"

enum { MOST = 200, POINTS = 4000, LARGEST = 1 << 20, CALLS = 43, KINDS = 17 };

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
    fr_causes_config causes;
    fr_saturation_config saturation;
    fr_encoder_screening_config encoder_screening;
    fr_usual_config usual;
} any_config;

typedef struct arrays {
    fr_real *x, *h, *f, *s, *y, *z;
    int64_t *n;
    uint8_t *flags, *made;
    fr_span *spans;
    size_t count, capacity, written;
} arrays;

static uint64_t state;

static uint32_t draw(uint32_t below)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(state >> 33) % below;
}

static double odd_number(void)
{
    static const double odd[] = {0.0,   -0.0,  1e-300, -1.0, 1e300,     INFINITY, -INFINITY,
                                 1e-30, 1e-12, 0.5,    2.0,  3.4e38,    1e12,     0.25};
    uint32_t k = draw(sizeof odd / sizeof *odd + 1);
    return k == sizeof odd / sizeof *odd ? NAN : odd[k];
}

static double number(void)
{
    return draw(400) == 0 ? odd_number() : (double)draw(2000) / 100.0;
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
        KIND(13, causes, c.rate_hz = 250; c.metres_per_count = count_m; c.interval_m = interval;
             c.every = 1 + (int)draw(3))
        KIND(14, saturation, c.range_least = 5 - (int)draw(9); c.range_greatest = 15;
             c.farthest = 1 + (int)draw(99); c.outermost_mps2 = 1; c.quantum = 0.01 * draw(9))
        KIND(15, encoder_screening, c.rate_hz = 250; c.metres_per_count = count_m)
        KIND(16, usual, c.longest = 2 + (int)draw(99))
    default:
        return FR_BAD_CONFIG;
    }
}

/* One of the calls; it may be of another kind of object. */
static fr_status call(int which, void *o, arrays *a)
{
    size_t n = a->count, room = a->capacity, *w = &a->written;
    fr_cut_off_config cut_off = fr_cut_off_defaults();
    fr_timer_distortion_config timer = {0.05, 3.576, 25.0};
    fr_validity_config validity = fr_validity_defaults();
    fr_cross_correlation_config lags = {0.1, 0.5};
    fr_high_pass_profile_config display = {0.1, number()};
    fr_agreement agreement;
    fr_usual_values usual;
    switch (which) {
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
    case 13:
        return fr_causes_push(o, a->n, draw(9) ? a->flags : NULL, n, a->made, room, w);
    case 14: return fr_saturation_push(o, a->x, n, a->spans, room, w);
    case 15: return fr_encoder_screening_push(o, a->n, n, a->spans, room, w);
    case 16: return fr_usual_push(o, a->x, n);
    case 32: return fr_causes_finish(o, a->made, n < room ? n : room);
    case 33: return fr_saturation_finish(o, a->spans, room, w);
    case 34: return fr_encoder_screening_finish(o, a->spans, room, w);
    case 35: return fr_usual_value(o, draw(9) ? &usual : NULL);
    case 36:
        validity.interval_m = number();
        validity.drift_m = number();
        return fr_validity(&validity, a->flags, n, a->made, room, w);
    case 37: return fr_cross_correlation(&lags, a->x, a->h, n, &agreement);
    case 38: return fr_high_pass_profile(&display, a->x, n, a->y, room, w);
    case 39: return fr_high_pass_set_height(o, a->h, n, a->y, room, w);
    case 40: return fr_high_pass_set_reverse(o, a->x, n, a->y, room, w);
    case 41: return fr_high_pass_set_finish(o);
    case 42: return fr_adaptive_set_velocity(o, a->x, a->f, n, a->y, room, w);
    case 17: return fr_adaptive_set_height(o, a->h, a->f, n, a->y, room, w);
    case 18: return fr_adaptive_set_reverse(o, a->x, a->f, n, a->y, room, w);
    case 19:
        return fr_adaptive_set_reverse_over_distance(o, number(), a->x, a->f, n, a->y, room, w);
    case 20: return fr_adaptive_set_finish(o);
    case 21: return fr_adaptive_finish(o, a->x, a->f, n, a->y, room, w);
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

static fr_real *drawn_reals(size_t count)
{
    fr_real *x = malloc(count * sizeof *x + (count == 0));
    for (size_t i = 0; i < count; i++)
        x[i] = (fr_real)number();
    return x;
}

static uint8_t *drawn_bytes(size_t count)
{
    uint8_t *flags = malloc(count + (count == 0));
    for (size_t i = 0; i < count; i++)
        flags[i] = draw(9) == 0 ? (uint8_t)draw(draw(999) ? 16 : 256) : 0;
    return flags;
}

static arrays drawn_arrays(int64_t *counts)
{
    arrays a;
    memset(&a, 0, sizeof a);
    a.count = draw(4) ? draw(MOST) : draw(3);
    a.capacity = draw(6) ? POINTS : draw(MOST);
    a.x = drawn_reals(a.count);
    a.h = drawn_reals(a.count);
    a.f = drawn_reals(a.count);
    a.s = drawn_reals(a.count);
    a.y = drawn_reals(a.capacity);
    a.z = drawn_reals(a.capacity);
    a.flags = drawn_bytes(a.count);
    a.made = drawn_bytes(a.capacity);
    a.spans = malloc(a.capacity * sizeof *a.spans + (a.capacity == 0));
    a.n = malloc(a.count * sizeof *a.n + (a.count == 0));
    for (size_t i = 0; i < a.count; i++)
        a.n[i] = *counts += draw(5000) == 0 ? (draw(2) ? -300000 : 1) * ((int64_t)1 << draw(33))
                                            : (int64_t)draw(60);
    if (a.count > 1 && draw(9) == 0)
        a.n[draw((uint32_t)a.count)] = FR_NO_COUNT;
    *counts = *counts > ((int64_t)1 << 52) || *counts < -((int64_t)1 << 52) ? 0 : *counts;
    return a;
}

static void release(arrays *a)
{
    free(a->x);
    free(a->h);
    free(a->f);
    free(a->s);
    free(a->y);
    free(a->z);
    free(a->n);
    free(a->flags);
    free(a->made);
    free(a->spans);
}

static int fail(const char *what, int kind, int which)
{
    printf("%s: kind %d, call %d\n", what, kind, which);
    return 1;
}

/* One push into an object of `size` bytes, which may be moved; 1 if a refusal changed something. */
static int push_once(int kind, void **object, size_t size, int64_t *counts, long *done)
{
    int which = draw(8) ? kind : (int)draw(CALLS), wrong = 0;
    arrays a = drawn_arrays(counts);
    unsigned char *before = malloc(size);
    fr_real *y = malloc(a.capacity * sizeof *y + (a.capacity == 0));
    memcpy(before, *object, size);
    memcpy(y, a.y, a.capacity * sizeof *y);
    if (call(which, *object, &a) != FR_OK)
        wrong = memcmp(before, *object, size) != 0 || memcmp(y, a.y, a.capacity * sizeof *y) != 0;
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
    int kind = (int)draw(KINDS), wrong = 0;
    void *object, *out = NULL;
    int64_t counts = draw(1000);
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
    for (int i = 0; size > 0 && !wrong && i < 12; i++)
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
