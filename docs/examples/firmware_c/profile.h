/* Write a profile directory, floatref-profile/1. */
#ifndef PROFILE_H
#define PROFILE_H

#include "recording.h"

/* Make the folder `path` with the points of all wheel paths, the first one at `start_m`. */
bool profile_write(const char *path, const struct recording *recording,
                   const struct path *const *paths, double start_m, struct failure *failure);

#endif
