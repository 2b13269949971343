/* SPDX-License-Identifier: Apache-2.0
 *
 * Follow an encoder: a knot is a sample farther than all before it, some time after the last knot.
 */
#include <string.h>

#include "encoder_knots.h"

/* A spike is higher than so many usual rises, and returns by at least half. */
#define SPIKE_RISES 5.0

static int is_peak_of_counts(const fr_progress *p, int64_t count, int64_t after)
{
    return (double)(count - p->far) > SPIKE_RISES * p->usual && 2 * (count - after) > count - p->value;
}

static void begin_progress(fr_progress *p, fr_moment now, int64_t count)
{
    p->started = 1;
    p->far = count;
    p->far_at = now;
    p->value = count;
    p->known = now;
    p->last.at = now;
    p->last.far = count;
}

/* Take a rise into account: the largest one, and the one that took longest. */
static void rise(fr_progress *p, fr_moment now, int64_t count)
{
    fr_way *coming = &p->coming;
    int64_t height = count - p->far;
    coming->rises++;
    if (height > coming->height) {
        coming->height = height;
        coming->step = now;
        coming->before_step = p->known;
        coming->front = p->far_at;
    }
    if (now.tick - p->far_at.tick > p->longest) {
        p->longest = now.tick - p->far_at.tick;
        coming->gap = p->far_at;
        coming->behind_gap = now;
        coming->gap_height = height;
    }
    p->far = count;
    p->far_at = now;
}

static void tie(fr_progress *p, fr_moment now, fr_way *before)
{
    *before = p->last;
    p->coming.at = now;
    p->coming.far = p->far;
    p->last = p->coming;
    (void)memset(&p->coming, 0, sizeof p->coming);
    p->longest = 0;
}

int fr_progress_take(fr_progress *p, fr_moment now, int64_t count, int64_t after, fr_way *before)
{
    int knot = 0;
    if (p->started == 0) {
        begin_progress(p, now, count);
        return 0;
    }
    if (count < p->far || (after < count && is_peak_of_counts(p, count, after))) {
        p->back = p->back < 0 ? now.index : p->back;
        p->behind = now.index + 1;
        p->value = count < p->far ? count : p->value;
        p->known = count < p->far ? now : p->known;
        return 0;
    }
    if (count > p->far) {
        rise(p, now, count);
        knot = (double)(now.tick - p->last.at.tick) >= p->apart;
    }
    p->value = count;
    p->known = now;
    if (knot) {
        tie(p, now, before);
        p->usual = (double)(p->last.far - before->far) / (double)p->last.rises;
    }
    return knot;
}

int fr_progress_end(fr_progress *p, fr_way *before)
{
    fr_way *coming = &p->coming;
    if (p->started == 0 || p->last.at.index >= p->known.index)
        return 0;
    if (coming->rises == 0) {
        coming->step = p->far_at;
        coming->before_step = p->far_at;
        coming->front = p->far_at;
    }
    if (coming->rises == 0 || p->known.tick - p->far_at.tick > p->longest) {
        coming->gap = p->far_at;
        coming->behind_gap = p->known;
        coming->gap_height = 0;
    }
    tie(p, p->known, before);
    return 1;
}
