/* Which points of a profile are valid. */
#ifndef VALIDITY_H
#define VALIDITY_H

/* Reach of an error around a flagged point, in m. */
struct reach {
    double drift_m;  /* to either side of a gap of the accelerometer */
    double run_in_m; /* from either end of the run */
    double before_slow_m, after_slow_m, after_braking_m;
};

/* A cut-off wavelength, half of it, and measured lengths. */
extern const struct reach REACH;

/* Turn the flags of `count` points into 1, valid, or 0, in place. */
void trust(unsigned char *flags, long count, double interval_m, const struct reach *reach);

#endif
