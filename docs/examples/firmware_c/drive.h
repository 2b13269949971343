/* Results of the encoder, shared by all wheel paths: speed, cut-off, and what is not valid. */
#ifndef DRIVE_H
#define DRIVE_H

#include "failure.h"
#include "filters.h"

/* Why a sample is not valid; bits combine. */
enum { MISSING = 1, DRIFT = 2, SLOW = 4, BRAKING = 8, LASTING = DRIFT | SLOW | BRAKING };

/* The schedule (5.3) and the limits of a valid profile. */
extern const double LOW_SPEED_HZ, CUTOFF_WAVELENGTH_M, TRANSITION_MPS, TRANSITION_STEEPNESS;
extern const double SLOW_MPS, STOPPING_TIME_S;

struct drive {
    double step_s;
    double *past; /* distances of the last half second, in a ring */
    long size, next, seen;
    long speed_samples, window_samples;
    long unknown; /* samples until the speed is known again */
    double speed_mps;
};

/* The motion of the vehicle at one sample. */
struct motion {
    double distance_m, speed_mps;
    real c;         /* of the high-pass stages, (A.11) */
    unsigned marks; /* SLOW, BRAKING */
};

/* Make the ring for a sampling rate; this is the only memory that a drive allocates. */
bool drive_open(struct drive *drive, double rate_hz, struct failure *failure);
void drive_close(struct drive *drive);

/* Take the next distance, NaN if it is not known, and return the motion. The last speed is
   used until 0.05 s of distance are known again. */
struct motion drive_step(struct drive *drive, double distance_m);

/* Cut-off frequency in Hz at a speed: (5.3). */
double cutoff_hz(double speed_mps);

/* The same in cycles/m, at least four intervals long, which holds at a stop, too. */
double cutoff_per_m(double speed_mps, double interval_m);

#endif
