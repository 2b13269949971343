/* The stages of the library, fed with the whole signals of a golden vector. */
#ifndef REPLAY_H
#define REPLAY_H

#include <floatref.h>

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
    fr_status (*apply)(const double *settings, const struct signals *in, struct signals *out);
};

/* The stages of signals in time, and those with points of a profile; both end with an empty one. */
extern const struct stage SIGNAL_STAGES[], PROFILE_STAGES[];

/* The stage of a vector; NULL if the library does not have it. */
const struct stage *stage_named(const char *name);

/* Memory for the objects of a stage, its inputs in the precision of the library, and its output. */
extern uint64_t memory[4][8192];
extern fr_real x[MOST_SIGNALS][MOST_SAMPLES], y[MOST_SAMPLES];
extern int64_t counts[MOST_SAMPLES];
extern size_t made;

/* Place an object of the library in one of the memories. */
#define MAKE(n, kind, config, out) fr_##kind##_init(memory[n], sizeof memory[n], config, out)

#define TRY(call)                                                                                  \
    do {                                                                                           \
        fr_status status_ = (call);                                                                \
        if (status_ != FR_OK)                                                                      \
            return status_;                                                                        \
    } while (0)

/* Fill x, and return how many samples the first signal has. */
size_t load(const struct signals *in);

/* Fill the counts with samples that are multiples of a unit. */
void load_counts(const double *samples, size_t count, double unit);

fr_status store(struct signals *out, int signal, const fr_real *samples, size_t count);

#endif
