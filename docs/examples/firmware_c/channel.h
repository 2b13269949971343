/* One channel as a stream on the accelerometer's clock, read through small windows of its file.

   A sample is passed on where the two clocks agree, else interpolated linearly. A missing (NaN)
   or damaged sample is bridged by the line between its neighbours, which the reader looks ahead
   for, and marked. Nothing is allocated but the channel itself and the places of damage. */
#ifndef CHANNEL_H
#define CHANNEL_H

#include <stdio.h>

#include "recording.h"
#include "spans.h"

enum { WINDOW = 1024 };

/* A piece of a file of float64, moved to the samples that are read. */
struct window {
    FILE *file;
    long count, first, held;
    double samples[WINDOW];
};

/* A constant rate: sample 0 was taken at `start_s`. */
struct clock {
    double rate_hz, start_s;
};

struct channel {
    struct window values, ahead, times;
    char name[TRACK_SIZE + 32];
    struct spans gone;       /* exist, but measure nothing */
    struct spans lasting;    /* the same, and disturb later samples */
    bool encoder;            /* a line cannot bridge its lasting damage */
    double rate_hz, start_s; /* of a uniform clock; the rate is 0 with a time_file */
    double mean_rate_hz;
    double hole_s;           /* samples are missing between time stamps farther apart */
    double bridge_s;         /* a longer gap is lost, not just missing */
    long bridge;             /* the same in samples */
    long left, right;        /* the good samples on either side of the latest gap */
    long stamp;              /* the latest time stamp that was reached */
    bool same_grid;          /* as the accelerometer's clock, `offset` samples later */
    long offset;
};

struct reading {
    double value;
    bool missing, lost;
};

/* Open the channel's files and read them once; false and the reason if they cannot be used. */
bool channel_open(struct channel *channel, const struct recording *recording,
                  const struct entry *entry, struct failure *failure);
void channel_close(struct channel *channel);

/* Time of a sample in s. */
double channel_time(struct channel *channel, long index);

/* The clock of the channel, if its time stamps keep a constant rate but for holes of half the time
   at most; else false. */
bool channel_steady(struct channel *channel, struct clock *clock, struct failure *failure);

/* Find whether the channel's samples are at the times of those of `clock`. */
void channel_align(struct channel *channel, const struct clock *clock);

/* Go back to the first sample; spans may have been added. */
void channel_rewind(struct channel *channel);

/* The value of the channel at sample `index` of `clock`, at `time`. Times must not go back. */
struct reading channel_read(struct channel *channel, long index, double time);

/* Sample `index` of the channel itself, bridged if it is missing; NaN where it cannot be bridged. */
struct reading channel_sample(struct channel *channel, long index);

/* The median of the first steps between time stamps. */
double typical_step(struct window *times);

#endif
