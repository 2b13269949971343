#include "replay.h"

#include <math.h>
#include <string.h>

#include "points.h"
#include "track.h"
#include "validity.h"

/* Store one value; a stage in single precision has rounded it already. */
static void put(struct signals *out, int signal, double value)
{
    if (out->count[signal] < MOST_SAMPLES)
        out->samples[signal][out->count[signal]++] = value;
}

/* A filter over x, at settings {step, cutoff} or at the cut-offs of a second signal. */
#define FILTER(name, kind, backward)                                                            \
    static void name(const double *settings, const struct signals *in, struct signals *out)    \
    {                                                                                           \
        struct kind filter = {0};                                                               \
        int count = out->count[0] = in->count[0];                                               \
        for (int j = 0; j < count; j++) {                                                       \
            int k = backward ? count - 1 - j : j;                                               \
            double cutoff = in->count[1] > 0 ? in->samples[1][k] : settings[1];                 \
            real c = cutoff_to_c(cutoff, settings[0]);                                          \
            out->samples[0][k] = kind(&filter, (real)in->samples[0][k], c);                     \
        }                                                                                       \
    }

FILTER(low_1, low_pass_1, false)
FILTER(low_2, low_pass_2, false)
FILTER(high_1, high_pass_1, false)
FILTER(high_2, high_pass_2, false)
FILTER(high_1_back, high_pass_1, true)
FILTER(high_2_back, high_pass_2, true)

static void trapezoids(const double *settings, const struct signals *in, struct signals *out)
{
    struct integral integral = {false, (real)settings[1], 0};
    for (int k = 0; k < in->count[0]; k++)
        put(out, 0, integrate(&integral, (real)in->samples[0][k], (real)(settings[0] / 2.0)));
}

static void speeds(const double *settings, const struct signals *in, struct signals *out)
{
    struct drive drive;
    struct failure failure = {""};
    if (!drive_open(&drive, settings[0], &failure))
        return;
    for (int k = 0; k < in->count[0]; k++)
        put(out, 0, drive_step(&drive, in->samples[0][k]).speed_mps);
    drive_close(&drive);
}

static void cutoffs(const double *settings, const struct signals *in, struct signals *out)
{
    for (int k = 0; k < in->count[0]; k++) {
        put(out, 0, cutoff_hz(in->samples[0][k]));
        put(out, 1, cutoff_per_m(in->samples[0][k], settings[0]));
    }
}

static void project(const double *settings, const struct signals *in, struct signals *out)
{
    struct points points;
    struct failure failure = {""};
    int last = in->count[0] - 1;
    double length = in->samples[0][last] - in->samples[0][0];
    memset(&points, 0, sizeof points);
    if (points_open(&points, 1, settings[0], length, &failure)) {
        for (int k = 0; k <= last; k++) {
            real elevation = (real)in->samples[1][k];
            unsigned flags = 0;
            struct sample sample = {{in->samples[0][k], 0.0, 0, 0}, &elevation, &flags};
            points_step(&points, &sample);
        }
        for (long k = 0; k < points.count; k++)
            put(out, 0, points.elevation[0][k]);
    }
    points_close(&points);
}

/* Force and height through a wheel path, at a rate that needs no anti-alias filter. */
static void pipeline(const double *settings, const struct signals *in, struct signals *out)
{
    struct points points;
    struct drive drive;
    struct track track;
    struct failure failure = {""};
    int last = in->count[2] - 1;
    memset(&points, 0, sizeof points);
    track_open(&track, settings[0]);
    if (!drive_open(&drive, settings[0], &failure))
        return;
    if (points_open(&points, 1, settings[1], in->samples[2][last] - in->samples[2][0], &failure)) {
        for (int k = 0; k <= last; k++) {
            unsigned flags = 0;
            struct motion motion = drive_step(&drive, in->samples[2][k]);
            real elevation = track_step(&track, in->samples[0][k] + 9.80665, in->samples[1][k],
                                        motion.c);
            struct sample sample = {motion, &elevation, &flags};
            points_step(&points, &sample);
        }
        backward_passes(points.elevation[0], points.speed, points.count, settings[1]);
        for (long k = 0; k < points.count; k++)
            put(out, 0, points.elevation[0][k]);
    }
    points_close(&points);
    drive_close(&drive);
}

static void validity(const double *settings, const struct signals *in, struct signals *out)
{
    unsigned char flags[MOST_SAMPLES];
    for (int k = 0; k < in->count[0]; k++)
        flags[k] = (unsigned char)in->samples[0][k];
    struct reach reach = {settings[1], settings[2], settings[3], settings[4], settings[5]};
    trust(flags, in->count[0], settings[0], &reach);
    for (int k = 0; k < in->count[0]; k++)
        put(out, 0, flags[k]);
}

const struct stage STAGES[] = {
    {"lpf-b3s1", {"step", "cutoff"}, {"x"}, {"y"}, low_1},
    {"lpf-b3s2", {"step", "cutoff"}, {"x"}, {"y"}, low_2},
    {"hpf-b3s1", {"step", "cutoff"}, {"x"}, {"y"}, high_1},
    {"hpf-b3s2", {"step", "cutoff"}, {"x"}, {"y"}, high_2},
    {"hpf-b3s1r", {"step", "cutoff"}, {"x"}, {"y"}, high_1_back},
    {"hpf-b3s2r", {"step", "cutoff"}, {"x"}, {"y"}, high_2_back},
    {"hpf-b3s1-varying", {"step"}, {"x", "cutoff"}, {"y"}, high_1},
    {"hpf-b3s2-varying", {"step"}, {"x", "cutoff"}, {"y"}, high_2},
    {"hpf-b3s1r-varying", {"step"}, {"x", "cutoff"}, {"y"}, high_1_back},
    {"hpf-b3s2r-varying", {"step"}, {"x", "cutoff"}, {"y"}, high_2_back},
    {"trapezoidal-rule", {"step", "start"}, {"x"}, {"y"}, trapezoids},
    {"travel-speed", {"rate_hz"}, {"distance"}, {"speed"}, speeds},
    {"adaptive-cut-off", {"interval_m"}, {"speed"}, {"frequency", "wave_number"}, cutoffs},
    {"projection", {"interval_m"}, {"distance", "x"}, {"y"}, project},
    {"validity",
     {"interval_m", "drift_m", "run_in_m", "before_slow_m", "after_slow_m", "after_braking_m"},
     {"flags"},
     {"valid"},
     validity},
    {"adaptive-hpf-spatial-backward",
     {"rate_hz", "interval_m"},
     {"acceleration", "height", "distance"},
     {"elevation"},
     pipeline},
};
const int STAGE_COUNT = sizeof STAGES / sizeof *STAGES;
