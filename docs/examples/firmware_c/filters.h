/* The filter stages and the integral, one sample at a time.

   Each has a few numbers of state. Their form avoids cancellation: a cut-off of 0.45 Hz
   at 16 kHz is c = tan(pi f dt) = 9e-5, and the recursion (A.9) as it is printed takes differences
   of numbers that agree to c squared, which single precision cannot represent. */
#ifndef FILTERS_H
#define FILTERS_H

#include <stdbool.h>

#ifndef REAL
#define REAL double
#endif
typedef REAL real;

/* LPF_B3S1 and LPF_B3S2 at a constant cut-off: (A.4) and (A.5), started by (A.12) and (A.13). */
struct low_pass_1 {
    bool started;
    real state;
};
struct low_pass_2 {
    bool started;
    real band, low;
};

/* HPF_B3S1 and HPF_B3S2: (A.2) and (A.3), started by (A.14) and (A.15). The cut-off may change
   from sample to sample. The state is the part removed so far, which is slow and small. */
struct high_pass_1 {
    bool started;
    real removed, output, c;
};
struct high_pass_2 {
    bool started;
    real removed, step, output, output_before, a;
};

/* The trapezoidal rule, from zero. */
struct integral {
    bool started;
    real sum, input;
};

/* c of (A.11) for a cut-off in cycles per unit of `step`. */
real cutoff_to_c(double cutoff, double step);

real low_pass_1(struct low_pass_1 *filter, real x, real c);
real low_pass_2(struct low_pass_2 *filter, real x, real c);
real high_pass_1(struct high_pass_1 *filter, real x, real c);
real high_pass_2(struct high_pass_2 *filter, real x, real c);
real integrate(struct integral *integral, real x, real half_step);

#endif
