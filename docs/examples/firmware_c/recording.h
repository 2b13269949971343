/* Contents of recording.json: the file of every channel, and when its samples were taken. */
#ifndef RECORDING_H
#define RECORDING_H

#include "failure.h"
#include "firmware.h"

enum {
    MOST_TRACKS = 64,
    MOST_ENTRIES = 256,
    TRACK_SIZE = 200, /* 48 characters of up to four bytes */
    FILE_SIZE = 1024  /* 255 characters of up to four bytes */
};

extern const char *const QUANTITY_NAMES[QUANTITIES];
extern const double LARGEST[QUANTITIES]; /* largest possible samples */
extern const double FASTEST_HZ;

struct entry {
    enum quantity quantity;
    char track[TRACK_SIZE]; /* empty if the channel is shared */
    char file[FILE_SIZE];
    char time_file[FILE_SIZE]; /* empty if the clock is uniform */
    double rate_hz, start_s;
};

struct recording {
    char folder[FILE_SIZE];
    double interval_m;
    int tracks; /* wheel paths that have a height */
    char track[MOST_TRACKS][TRACK_SIZE];
    double reference_m[MOST_TRACKS]; /* accelerometers ahead of the vehicle point */
    double lever_m[MOST_TRACKS];     /* lasers ahead of their accelerometers */
    double front_axle_m, wheelbase_m; /* the front axle ahead of that point */
    int entries;
    struct entry entry[MOST_ENTRIES];
};

/* Read the recording.json at `path`; false and why if it is not one. */
bool recording_read(struct recording *recording, const char *path, struct failure *failure);

/* The channel of a wheel path, or the shared one, or NULL. */
const struct entry *recording_find(const struct recording *recording, enum quantity quantity,
                                   const char *track);

#endif
