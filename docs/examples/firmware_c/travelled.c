/* The way of the vehicle by an encoder that leaps or loses counts: there the vehicle drives on. */
#include <math.h>

#include "waiting.h"

static const double BESIDE_S = 0.25; /* whose mean is the speed beside a gap */
static const double SHORT_S = 1.0;   /* a longer gap may hide a stop, and is left as it is */

void begin_travelled(struct waiting *w, double rate_hz)
{
    w->beside = (size_t)fmax(1.0, rint(BESIDE_S * rate_hz));
    w->longest = (size_t)rint(SHORT_S * rate_hz);
}

/* The speed in counts per sample over the samples that end with number `last`. */
static double speed_of(const int64_t *counts, size_t first, size_t last)
{
    double way = (double)(counts[last] - counts[first]);
    return last > first ? fmax(way / (double)(last - first), 0.0) : NAN;
}

/* The gap from `known` to before `resumed` is bridged by a speed that is linear between those on
 * both sides, up to sample `last`. What the encoder counted across it is not travelled. */
static void bridge_gap(struct waiting *w, size_t last)
{
    size_t first = w->known, behind = w->resumed, from = first - 1;
    double steps = (double)(behind - from), way = 0.0;
    double counted = (double)(w->counts[behind] - w->miscounted - w->travelled[from]);
    double before = speed_of(w->travelled, from > w->beside ? from - w->beside : 0, from);
    double after = speed_of(w->counts, behind, last);
    bool whole = behind - first > w->longest || (isnan(before) && isnan(after));
    before = isnan(before) ? after : before;
    after = isnan(after) ? before : after;
    if (whole)
        before = after = counted / steps;
    for (size_t k = first; k <= behind; k++) {
        way += before + (after - before) * ((double)(k - first) + 0.5) / steps;
        w->travelled[k] = w->travelled[from] + (int64_t)rint(way);
    }
    w->miscounted = w->counts[behind] - w->travelled[behind];
    for (size_t k = behind + 1; k <= last; k++)
        w->travelled[k] = w->counts[k] - w->miscounted;
    w->known = last + 1;
    w->resumed = 0;
}

/* A sample behind those before it. */
static void travel(struct waiting *w, size_t i)
{
    bool counted = w->counts[i] != FR_NO_COUNT;
    if (!counted && w->resumed > 0)
        bridge_gap(w, i - 1);
    if (counted && w->known < i && w->resumed == 0)
        w->resumed = i;
    if (counted && w->resumed > 0 && i == w->resumed + w->beside)
        bridge_gap(w, i);
    else if (counted && w->known == i) {
        w->travelled[i] = w->counts[i] - w->miscounted;
        w->known = i + 1;
    }
}

void store_counts(struct waiting *w, const int64_t *counts, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        w->counts[w->taken + k] = counts[k];
        travel(w, w->taken + k);
    }
    w->taken += count;
}

void end_counts(struct waiting *w)
{
    if (w->resumed > 0)
        bridge_gap(w, w->taken - 1);
    for (; w->known > 0 && w->known < w->taken; w->known++)
        w->travelled[w->known] = w->travelled[w->known - 1];
}
