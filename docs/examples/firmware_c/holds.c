#include "holds.h"

#include <math.h>
#include <string.h>

static const double BEYOND = 1e300;
enum { LONGEST = 4096 }; /* longer holds are counted together */

struct holds holds_of(struct window *window)
{
    struct holds holds = {window, 0, {0, 0, 0.0, 0.0, 0.0}};
    return holds;
}

bool holds_next(struct holds *holds, struct hold *hold)
{
    struct hold *open = &holds->open;
    while (holds->next <= holds->window->count) {
        long index = holds->next++;
        double value = index < holds->window->count ? window_at(holds->window, index) : NAN;
        bool held = open->length > 0;
        if (held && value == open->value) {
            open->length++;
            continue;
        }
        double step = held && !isnan(value) ? fabs(value - open->value) : BEYOND;
        *hold = *open;
        hold->step_out = step;
        *open = (struct hold){index, isnan(value) ? 0 : 1, value, step, 0.0};
        if (held)
            return true;
    }
    return false;
}

/* The length up to which holds make up half of all samples. */
static double middle(const long *held, long samples)
{
    long length = 0, sum = 0;
    while (length < LONGEST - 1 && 2 * sum < samples)
        sum += held[++length];
    return length < LONGEST - 1 ? (double)length : INFINITY;
}

struct usual usual_of(struct window *window)
{
    static long held[LONGEST];
    struct usual usual = {INFINITY, INFINITY, INFINITY, -INFINITY};
    struct holds holds = holds_of(window);
    struct hold hold;
    long samples = 0;
    memset(held, 0, sizeof held);
    while (holds_next(&holds, &hold)) {
        held[hold.length < LONGEST ? hold.length : LONGEST - 1] += hold.length;
        samples += hold.length;
        usual.quantum = fmin(usual.quantum, hold.step_out);
        usual.least = fmin(usual.least, hold.value);
        usual.greatest = fmax(usual.greatest, hold.value);
    }
    usual.hold = middle(held, samples);
    return usual;
}
