/* Time stamps of a constant rate, as that rate; samples may be missing in between. */
#include <math.h>
#include <stdlib.h>

#include "median.h"
#include "window.h"

static const double JITTER = 0.01;     /* of a constant rate, in steps */
static const double ROUNDING_S = 2e-6; /* time stamps may be rounded to microseconds */
static const double HOLE = 1.5;        /* usual steps with samples missing in between */
enum { MOST_DIGITS = 12, STEPS = WINDOW - 1 };

/* The stretches of time stamps without a hole. */
struct stretches {
    double step_s;         /* the mean one */
    double held_s, span_s; /* their total length, without and with the holes */
    double longest_s;
};

double typical_step(struct window *times)
{
    static double steps[STEPS];
    long count = times->count - 1 < STEPS ? times->count - 1 : STEPS;
    if (count == 0)
        return INFINITY;
    for (long i = 0; i < count; i++)
        steps[i] = window_at(times, i + 1) - window_at(times, i);
    return median(steps, count);
}

/* Measure the stretches between steps longer than `hole_s`. */
static struct stretches measure(struct window *times, double hole_s)
{
    struct stretches found = {0.0, 0.0, 0.0, 0.0};
    double first = window_at(times, 0), begin = first, before = first;
    long steps = 0;
    for (long i = 1; i < times->count; i++) {
        double now = window_at(times, i);
        bool hole = now - before > hole_s;
        if (hole) {
            found.held_s += before - begin;
            begin = now;
        }
        steps += hole ? 0 : 1;
        found.longest_s = fmax(found.longest_s, now - begin);
        before = now;
    }
    found.held_s += before - begin;
    found.span_s = before - first;
    found.step_s = found.held_s / (double)steps;
    return found;
}

/* The first time stamp that is farther than `allowed` off its place since the last hole, or -1. */
static long first_off(struct window *times, double hole_s, double step_s, double allowed)
{
    double begin = window_at(times, 0), before = begin;
    long since = 0;
    for (long i = 0; i < times->count; i++) {
        double now = window_at(times, i);
        if (now - before > hole_s) {
            begin = now;
            since = i;
        }
        if (fabs(now - begin - step_s * (double)(i - since)) > allowed)
            return i;
        before = now;
    }
    return -1;
}

/* The roundest rate at which the last time stamp of `span_s` is off by less than `allowed`. */
static double roundest(double rate, double span_s, double allowed)
{
    char text[40];
    for (int digits = 0; digits < MOST_DIGITS; digits++) {
        snprintf(text, sizeof text, "%.*e", digits, rate);
        double candidate = strtod(text, NULL);
        if (candidate > 0 && fabs(span_s - span_s * rate / candidate) <= allowed)
            return candidate;
    }
    return rate;
}

bool channel_steady(struct channel *channel, struct clock *clock, struct failure *failure)
{
    struct window *times = &channel->times;
    *clock = (struct clock){channel->rate_hz, channel->start_s};
    if (times->file == NULL)
        return true;
    if (times->count < 2)
        return fail(failure, "%s: one sample is no stretch of time", channel->name);
    double hole_s = HOLE * typical_step(times);
    struct stretches found = measure(times, hole_s);
    if (!(found.held_s >= found.span_s / 2))
        return fail(failure, "%s: half of the time is without a sample", channel->name);
    clock->start_s = window_at(times, 0);
    double farthest = fmax(fabs(clock->start_s), fabs(clock->start_s + found.span_s));
    double allowed = fmax(JITTER * found.step_s, ROUNDING_S) + 1e-15 * farthest;
    long off = first_off(times, hole_s, found.step_s, allowed);
    if (off >= 0)
        return fail(failure, "%s: time stamp %ld is off a constant rate", channel->name, off);
    clock->rate_hz = roundest(1.0 / found.step_s, found.longest_s, allowed);
    return true;
}
