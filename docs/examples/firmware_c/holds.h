/* Runs of identical samples: a held reading, a stuck sensor, the end of a range. */
#ifndef HOLDS_H
#define HOLDS_H

#include "window.h"

struct hold {
    long first, length;
    double value, step_in, step_out; /* a step from or to a missing sample is beyond all others */
};

/* Goes through a channel, hold by hold. */
struct holds {
    struct window *window;
    long next;
    struct hold open;
};

/* What is usual in a channel. */
struct usual {
    double hold; /* length of the holds in which the samples in the middle lie */
    double quantum, least, greatest; /* the smallest step, and the range of the samples */
};

struct holds holds_of(struct window *window);

/* Find the next hold, a single sample being one, too; false behind the last. */
bool holds_next(struct holds *holds, struct hold *hold);

struct usual usual_of(struct window *window);

#endif
