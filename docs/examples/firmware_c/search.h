/* Before a run: every channel is shown to the firmware, which learns and screens its sensor. */
#ifndef SEARCH_H
#define SEARCH_H

#include "channel.h"

/* Exclude the samples of `channel` that measure nothing. `distance` is the encoder, already searched;
   `force` is the accelerometer beside a height. False, and the reason, if the firmware refuses. */
bool search(struct channel *channel, enum quantity quantity, struct channel *distance,
            struct channel *force, double metres_per_count, struct failure *failure);

#endif
