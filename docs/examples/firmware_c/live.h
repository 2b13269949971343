/* A stream: samples that wait for those of other channels, and the wheel paths made of them. */
#ifndef LIVE_H
#define LIVE_H

#include <floatref.h>
#include <stdbool.h>

enum { MOST_PATHS = 4, LONGEST_NAME = 128, CHUNK_OF_STREAM = 256, WAITING = 1 << 17, POINTS = 1 << 15 };

/* Samples of one channel that wait for those of the others. */
struct queue {
    char name[LONGEST_NAME];
    fr_real values[WAITING];
    size_t count;
};

struct wheel_path {
    char name[LONGEST_NAME];
    struct queue force, height;
    fr_adaptive *stage;
    fr_real elevation[POINTS], speed[POINTS];
};

struct stream {
    struct queue distance;
    struct wheel_path paths[MOST_PATHS];
    size_t path_count;
    double interval_m, rate_hz, start_m;
    long first; /* number of the next point */
    bool begun;
};

/* Answer that the stream cannot go on, and return false. */
bool refuse(const char *text);

/* Place the stages of all wheel paths in memory. */
bool live_begin(struct stream *stream);

/* Make points of all samples that every channel has, and write them. */
bool live_process(struct stream *stream);

#endif
