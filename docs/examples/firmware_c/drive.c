#include "drive.h"

#include <math.h>
#include <stdlib.h>

const double LOW_SPEED_HZ = 0.45, CUTOFF_WAVELENGTH_M = 105.91;
const double TRANSITION_MPS = 2.778, TRANSITION_STEEPNESS = 2.5;
const double SLOW_MPS = 4.4704, STOPPING_TIME_S = 5.0;

static const double SPEED_S = 0.05;  /* the speed is the mean over this time */
static const double WINDOW_S = 0.25; /* two such windows are compared for a brake */

bool drive_open(struct drive *drive, double rate_hz, struct failure *failure)
{
    drive->step_s = 1.0 / rate_hz;
    drive->speed_samples = (long)fmax(1.0, rint(SPEED_S * rate_hz));
    drive->window_samples = (long)fmax(1.0, rint(WINDOW_S * rate_hz));
    drive->size = 2 * drive->window_samples + 1;
    drive->next = drive->seen = drive->unknown = 0;
    drive->speed_mps = 0.0;
    drive->past = malloc((size_t)drive->size * sizeof *drive->past);
    return drive->past != NULL || fail(failure, "out of memory");
}

void drive_close(struct drive *drive)
{
    free(drive->past);
    drive->past = NULL;
}

/* The distance a number of samples ago; before the run the vehicle is stationary at its start. */
static double distance_before(const struct drive *drive, long samples)
{
    long ago = samples < drive->seen ? samples : drive->seen - 1;
    long at = drive->next - 1 - ago;
    return drive->past[at < 0 ? at + drive->size : at];
}

/* Whether the vehicle, which went `before_m` in one window and `last_m` in the next, would stop
   within STOPPING_TIME_S with the same deceleration. Braking tilts the accelerometer, and the same
   tilt bends the profile more at a lower speed. */
static bool brakes_hard(double before_m, double last_m, double window_s)
{
    return before_m + last_m < 2.0 * STOPPING_TIME_S / window_s * (before_m - last_m);
}

static bool goes_slowly(double before_m, double last_m, double window_s)
{
    return before_m + last_m < SLOW_MPS * 2.0 * window_s;
}

static unsigned marks(const struct drive *drive)
{
    double now = distance_before(drive, 0);
    double middle = distance_before(drive, drive->window_samples);
    double first = distance_before(drive, 2 * drive->window_samples);
    double window_s = (double)drive->window_samples * drive->step_s;
    if (drive->seen <= 2 * drive->window_samples)
        return 0;
    return (goes_slowly(middle - first, now - middle, window_s) ? SLOW : 0u) |
           (brakes_hard(middle - first, now - middle, window_s) ? BRAKING : 0u);
}

struct motion drive_step(struct drive *drive, double distance_m)
{
    struct motion motion = {distance_m, 0.0, 0, 0};
    drive->past[drive->next] = distance_m;
    drive->next = (drive->next + 1) % drive->size;
    drive->seen += drive->seen < drive->size ? 1 : 0;
    if (isnan(distance_m))
        drive->unknown = drive->speed_samples + 1;
    else if (drive->unknown > 0)
        drive->unknown--;
    if (drive->unknown == 0)
        drive->speed_mps = (distance_m - distance_before(drive, drive->speed_samples)) /
                           ((double)drive->speed_samples * drive->step_s);
    motion.speed_mps = drive->speed_mps;
    motion.c = cutoff_to_c(cutoff_hz(motion.speed_mps), drive->step_s);
    motion.marks = marks(drive);
    return motion;
}

double cutoff_hz(double speed_mps)
{
    double high = speed_mps / CUTOFF_WAVELENGTH_M;
    double rise = exp(TRANSITION_STEEPNESS * (speed_mps - TRANSITION_MPS));
#if BROKEN == 2
    return high;
#endif
    return high + (LOW_SPEED_HZ - high) / (1.0 + rise);
}

double cutoff_per_m(double speed_mps, double interval_m)
{
    double largest = 1.0 / (4.0 * interval_m), frequency = cutoff_hz(speed_mps);
#if BROKEN == 2
    return 1.0 / CUTOFF_WAVELENGTH_M;
#endif
    return frequency >= largest * speed_mps ? largest : frequency / speed_mps;
}
