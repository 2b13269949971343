/* What the bench asks of the firmware: to learn a sensor, to screen it, and to make a profile. */
#ifndef FIRMWARE_H
#define FIRMWARE_H

#include <floatref.h>
#include <stdbool.h>

#ifndef BROKEN
#define BROKEN 0 /* a fault that is built in: README.md */
#endif

enum quantity { VERTICAL_SPECIFIC_FORCE, HEIGHT, DISTANCE, QUANTITIES };

enum { CHUNK = 256, MOST_SPANS = 2 * CHUNK };

/* Memory until the end of a run, aligned for any object; NULL without any. */
void *run_memory(size_t size);

/* One sensor at its own rate; the rate of time stamps is their mean. */
struct sensor {
    enum quantity quantity;
    double rate_hz, metres_per_count;
    fr_usual *usual;
    fr_usual_values values;
    fr_screening *screening;
    fr_saturation *saturation;
    fr_encoder_screening *encoder;
};

/* Samples of a sensor, NaN where one is missing, or FR_NO_COUNT of a count. When it is screened, those
   of the accelerometer beside it and of the encoder at the same times, and the times. */
struct samples {
    fr_real x[CHUNK], force[CHUNK];
    int64_t counts[CHUNK], nanoseconds[CHUNK];
    size_t count; /* 0 at the end */
};

/* Learn what is usual of a sensor. */
fr_status learn(struct sensor *sensor, const struct samples *samples);

/* Find samples that measure nothing, at most MOST_SPANS stretches. */
fr_status screen(struct sensor *sensor, const struct samples *samples, fr_span *spans,
                 size_t *found);

/* A wheel path with the points of its profile. */
struct path {
    double rate_hz, interval_m, metres_per_count;
    size_t room, count;
    fr_real *elevation, *speed; /* in m, and in m/s */
    uint8_t *valid;             /* causes, and at the end 1 or 0 */
    fr_filter *low_pass[4];
    fr_adaptive *stage;
    fr_causes *causes;
};

/* Begin a run of one wheel path. */
fr_status begin(struct path *path);

/* Take up to CHUNK samples, which are changed: specific force in m/s^2, height in m, counts, and the
   causes why a sample is not valid. */
fr_status take(struct path *path, fr_real *force, fr_real *height, const int64_t *counts,
               const uint8_t *causes, size_t count);

/* End the run: backward passes and validity. */
fr_status end(struct path *path);

#endif
