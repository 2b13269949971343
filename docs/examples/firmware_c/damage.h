/* Samples that are there and yet measure nothing, looked for once before a run.

   What is usual, a count, a hold, a range, is taken from the channel itself. */
#ifndef DAMAGE_H
#define DAMAGE_H

#include "channel.h"

/* Leave out an accelerometer's samples at the end of its range. */
bool damaged_force(struct channel *channel, struct failure *failure);

/* Leave out a height that is stuck, while `force` beside it moves, or out of its range. */
bool damaged_height(struct channel *channel, struct channel *force, struct failure *failure);

/* Leave out where a distance goes back, is silent, leaps or loses counts. */
bool damaged_distance(struct channel *channel, struct failure *failure);

#endif
