#include "filters.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

real cutoff_to_c(double cutoff, double step)
{
    return (real)tan(PI * cutoff * step);
}

real low_pass_1(struct low_pass_1 *filter, real x, real c)
{
    if (!filter->started)
        filter->state = x;
    filter->started = true;
    real high = (x - filter->state) / (1 + c);
    filter->state += 2 * c * high;
    return x - high;
}

real low_pass_2(struct low_pass_2 *filter, real x, real c)
{
    if (!filter->started)
        filter->low = x;
    filter->started = true;
    real high = (x - filter->low - (1 + c) * filter->band) / (1 + c + c * c);
    real band = filter->band + c * high;
    real low = filter->low + c * band;
    filter->band += 2 * c * high;
    filter->low += 2 * c * band;
    return low;
}

/* With e = x - y the stage is e_k - e_{k-1} = c_k (y_k + y_{k-1}); the share of y_k in e_k is
   taken to the other side. */
real high_pass_1(struct high_pass_1 *filter, real x, real c)
{
    if (!filter->started) {
        filter->started = true;
        filter->removed = c * x;
    } else {
        filter->removed += (filter->c + c) * filter->output;
    }
    filter->c = c;
    filter->output = (x - filter->removed) / (1 + c);
    return filter->output;
}

/* The same with the second difference of e: c_k (y_k - y_{k-2}) + c_k^2 (y_k + 2 y_{k-1} + y_{k-2}).
   `step` is the one that e, without the share of y_k, is about to take. */
real high_pass_2(struct high_pass_2 *filter, real x, real c)
{
    real square = c * c;
    if (!filter->started) {
        filter->started = true;
        filter->a = c + square;
        filter->output = x * (1 + c - 3 * square) / (1 + filter->a);
        filter->output_before = filter->output;
        filter->removed = x * (3 * square - c);
        filter->step = -filter->a * filter->output;
        return filter->output;
    }
    real b = filter->a + square;
    filter->step += (square - c) * filter->output_before;
    filter->removed += filter->step + 2 * b * filter->output;
    filter->step += (b + square) * filter->output;
    filter->a = c + square;
    filter->output_before = filter->output;
    filter->output = (x - filter->removed) / (1 + filter->a);
    return filter->output;
}

real integrate(struct integral *integral, real x, real half_step)
{
    if (integral->started)
        integral->sum += half_step * (x + integral->input);
    integral->started = true;
    integral->input = x;
    return integral->sum;
}
