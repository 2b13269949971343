/* The stages of the firmware, fed with whole signals. */
#ifndef REPLAY_H
#define REPLAY_H

#include "filters.h"

enum { MOST_SAMPLES = 1000, MOST_SIGNALS = 4, MOST_SETTINGS = 6 };

/* Signals in the order that a stage names them; `count` samples are filled. */
struct signals {
    int count[MOST_SIGNALS];
    double samples[MOST_SIGNALS][MOST_SAMPLES];
};

/* One stage: its settings, inputs and outputs by name, and its function. */
struct stage {
    const char *name;
    const char *settings[MOST_SETTINGS];
    const char *inputs[MOST_SIGNALS];
    const char *outputs[MOST_SIGNALS];
    void (*apply)(const double *settings, const struct signals *in, struct signals *out);
};

extern const struct stage STAGES[];
extern const int STAGE_COUNT;

#endif
