/* SPDX-License-Identifier: Apache-2.0
 *
 * The exactly matched high-pass as an observer of the road.
 *
 * r' = v + 2w (h - r), v' = a + b + 2w^2 (h - r), b' = w^3 (h - r) by the trapezoidal rule with
 * w dt/2 = c_k of (A.11) inside the integrals, so that r - h is the filter (A.1) of the profile. v
 * and b are kept in metres, as v dt/2 and b dt^2/4; the share of each sample is solved for
 * e = r - h in closed form.
 */
#include "schedule.h"

#define MATCHED_MAGIC FR_MAGIC(10)

typedef struct observer {
    int32_t started;
    fr_real pushed, held, c, e, v, b, r;
} observer;

struct fr_matched_high_pass {
    fr_head head;
    int32_t missing;
    fr_real scale;
    fr_tangent tangent;
    observer observer;
};

fr_matched_high_pass_config fr_matched_high_pass_defaults(void)
{
    fr_matched_high_pass_config config = {0.0, FR_MISSING_REFUSED, FR_TANGENT_EXACT};
    return config;
}

size_t fr_matched_high_pass_size(const fr_matched_high_pass_config *config)
{
    int possible = config != NULL && fr_above_zero(config->rate_hz) &&
                   fr_above_zero(1.0 / config->rate_hz) &&
                   fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) &&
                   fr_one_of(config->tangent, FR_TANGENT_EXACT, FR_TANGENT_SHORT);
    return possible ? sizeof(fr_matched_high_pass) : 0u;
}

fr_status fr_matched_high_pass_init(void *memory, size_t size,
                                    const fr_matched_high_pass_config *config,
                                    fr_matched_high_pass **out)
{
    fr_status status = fr_place(memory, size, config, (const void *)out,
                                fr_matched_high_pass_size(config), MATCHED_MAGIC);
    if (status != FR_OK)
        return status;
    double step = 1.0 / config->rate_hz;
    *out = (fr_matched_high_pass *)memory;
    (*out)->missing = config->missing;
    (*out)->scale = FR_R(0.25 * step * step);
    (*out)->tangent = fr_tangent_of(step, config->tangent);
    return FR_OK;
}

/* Before the first height the reference is 0, and the acceleration is remembered alone. */
static fr_real observe_first(observer *o, fr_real height)
{
    if (!fr_missing(height)) {
        o->started = 1;
        o->r = height;
    }
    return o->r;
}

static fr_real observe(observer *o, fr_real push, fr_real height, fr_real c)
{
    fr_real before = o->c, pushed = o->pushed, square, square_1, b, v, r;
    o->pushed = fr_missing(push) ? pushed : push;
    o->c = fr_missing(c) ? before : c;
    o->held = fr_missing(height) ? o->held : height;
    if (o->started == 0)
        return observe_first(o, height);
    square = o->c * o->c;
    square_1 = before * before;
    b = o->b - square_1 * before * o->e;
    v = o->v + (o->pushed + pushed) + (o->b + b) - 2 * square_1 * o->e;
    r = o->r + (o->v + v) - 2 * before * o->e;
    o->e = (r - o->held) / ((1 + o->c) * (1 + o->c + square));
    o->b = b - square * o->c * o->e;
    o->v = v - (square * o->c + 2 * square) * o->e;
    o->r = o->held + o->e;
    return o->r;
}

fr_status fr_matched_high_pass_push(fr_matched_high_pass *matched, const fr_real *acceleration,
                                    const fr_real *height, const fr_real *cutoff, size_t count,
                                    fr_real *reference_height, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(matched, MATCHED_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, reference_height, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(acceleration, count, matched->missing);
    if (status == FR_OK)
        status = fr_check_samples(height, count, matched->missing);
    if (status == FR_OK)
        status = fr_check_cutoffs(&matched->tangent, cutoff, count, matched->missing);
    if (status != FR_OK)
        return status;
    observer o = matched->observer;
    for (size_t done = 0; done < count; done += FR_BLOCK) {
        size_t size = count - done < FR_BLOCK ? count - done : FR_BLOCK;
        fr_real c[FR_BLOCK];
        fr_tangents(&matched->tangent, cutoff + done, size, c);
        for (size_t k = done; k < done + size; k++)
            reference_height[k] =
                observe(&o, matched->scale * acceleration[k], height[k], c[k - done]);
    }
    matched->observer = o;
    *written = count;
    return FR_OK;
}
