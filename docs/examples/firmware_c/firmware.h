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

/* What the bench adds to the causes of a sample: its height is missing, and bridged by a line. */
enum { NO_HEIGHT = 16 };

/* Memory until the end of a run, aligned for any object; NULL without any. */
void *run_memory(size_t size);

/* Return the status of a call unless it is FR_OK. */
#define TRY(call)                                                                                  \
    do {                                                                                           \
        fr_status status_ = (call);                                                                \
        if (status_ != FR_OK)                                                                      \
            return status_;                                                                        \
    } while (0)

/* Place an object of the library in memory of the run. */
#define MAKE(kind, config, out)                                                                    \
    fr_##kind##_init(run_memory(fr_##kind##_size(config)), fr_##kind##_size(config), config, out)

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

/* The vehicle of a run. Places are ahead of the middle of the lasers. */
struct vehicle {
    int paths;
    size_t samples; /* of the run */
    double front_m, rear_m; /* axles */
    double lever_m;         /* middle of the lasers, ahead of that of the accelerometers */
    bool on_levers;         /* a laser is not at its accelerometer */
    struct waiting *waiting;
};

/* A wheel path with the points of its profile. */
struct path {
    struct vehicle *vehicle;
    int number; /* from 0 */
    double rate_hz, interval_m, metres_per_count;
    double lever_m; /* laser ahead of its accelerometer */
    size_t room, count;
    fr_real *elevation, *speed; /* in m, and in m/s */
    uint8_t *valid;             /* causes, and at the end 1 or 0 */
    fr_filter *low_pass[4];
    fr_adaptive *stage;
    fr_causes *causes;
    fr_validity_config validity;
    bool through_stops;         /* no speed is a cause */
    const uint8_t *of_samples;  /* the causes of those that the stage takes */
    fr_road_prior *road_prior;
    size_t made, placed;       /* points that the road prior and the levelling have reached */
    fr_real *sigma, *unlevel;  /* 1-sigma of points in m, and that which levelling leaves */
    uint8_t *flags;            /* FR_POINT_... */
};

/* Begin a run of one wheel path. */
fr_status begin(struct path *path);

/* Take up to CHUNK samples, which are changed: specific force in m/s^2, height in m, counts, and the
   causes why a sample is not valid. */
fr_status take(struct path *path, fr_real *force, fr_real *height, const int64_t *counts,
               const uint8_t *causes, size_t count);

/* End the run: backward passes and validity. All wheel paths have been taken whole. */
fr_status end(struct path *path);

/* The stage: what `begin`, `take` and `end` do with it. */
fr_status stage_begin(struct path *path);
fr_status stage_take(struct path *path, fr_real *force, fr_real *height, const int64_t *counts,
                     size_t count);
fr_status stage_end(struct path *path);

#endif
