/* Samples that exist but measure nothing, searched for once before a run.

   The usual count, hold and range are estimated from the channel itself. */
#ifndef DAMAGE_H
#define DAMAGE_H

#include "channel.h"

/* Exclude an accelerometer's samples at the end of its range. */
bool damaged_force(struct channel *channel, struct failure *failure);

/* Exclude a height that is stuck while `force` beside it moves, or out of its range. */
bool damaged_height(struct channel *channel, struct channel *force, struct failure *failure);

/* Exclude the samples where a distance goes back, is silent, leaps or loses counts. */
bool damaged_distance(struct channel *channel, struct failure *failure);

#endif
