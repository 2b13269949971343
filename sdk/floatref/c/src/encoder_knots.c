/* SPDX-License-Identifier: Apache-2.0
 *
 * Follow an encoder: a knot is a sample farther than all before it, some time after the last knot.
 */
#include "encoder_knots.h"

/* A spike is higher than so many usual rises, and returns by at least half. */
#define SPIKE_RISES 5.0

static int is_peak_of_counts(const fr_progress *p, int64_t count, int64_t after)
{
    return (double)(count - p->far) > SPIKE_RISES * p->usual && 2 * (count - after) > count - p->value;
}

static void begin_progress(fr_progress *p, int64_t index, int64_t count)
{
    p->started = 1;
    p->far = count;
    p->far_at = index;
    p->value = count;
    p->known = index;
    p->last.at = index;
    p->last.far = count;
}

/* Take a rise into account: the largest one, and the one that took longest. */
static void rise(fr_progress *p, int64_t index, int64_t count)
{
    fr_way *coming = &p->coming;
    int64_t height = count - p->far;
    coming->rises++;
    if (height > coming->height) {
        coming->height = height;
        coming->step = index;
        coming->before_step = p->known;
        coming->front = p->far_at;
    }
    if (index - p->far_at > p->longest) {
        p->longest = index - p->far_at;
        coming->gap = p->far_at;
        coming->behind_gap = index;
        coming->gap_height = height;
    }
    p->far = count;
    p->far_at = index;
}

static void tie(fr_progress *p, int64_t index, fr_way *before)
{
    static const fr_way nothing = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    *before = p->last;
    p->coming.at = index;
    p->coming.far = p->far;
    p->last = p->coming;
    p->coming = nothing;
    p->longest = 0;
}

int fr_progress_take(fr_progress *p, int64_t index, int64_t count, int64_t after, fr_way *before)
{
    int knot = 0;
    if (p->started == 0) {
        begin_progress(p, index, count);
        return 0;
    }
    if (count < p->far || (after < count && is_peak_of_counts(p, count, after))) {
        p->back = p->back < 0 ? index : p->back;
        p->behind = index + 1;
        p->value = count < p->far ? count : p->value;
        p->known = count < p->far ? index : p->known;
        return 0;
    }
    if (count > p->far) {
        rise(p, index, count);
        knot = (double)(index - p->last.at) >= p->apart;
    }
    p->value = count;
    p->known = index;
    if (knot) {
        tie(p, index, before);
        p->usual = (double)(p->last.far - before->far) / (double)p->last.rises;
    }
    return knot;
}

int fr_progress_end(fr_progress *p, fr_way *before)
{
    fr_way *coming = &p->coming;
    if (p->started == 0 || p->last.at >= p->known)
        return 0;
    if (coming->rises == 0) {
        coming->step = p->far_at;
        coming->before_step = p->far_at;
        coming->front = p->far_at;
    }
    if (coming->rises == 0 || p->known - p->far_at > p->longest) {
        coming->gap = p->far_at;
        coming->behind_gap = p->known;
        coming->gap_height = 0;
    }
    tie(p, p->known, before);
    return 1;
}
