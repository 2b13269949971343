/* Write a profile directory, floatref-profile/1. */
#ifndef PROFILE_H
#define PROFILE_H

#include "points.h"
#include "recording.h"

/* Make the folder `path` with all that `points` holds; its flags say 1, trust it, or 0. */
bool profile_write(const char *path, const struct recording *recording,
                   const struct points *points, struct failure *failure);

#endif
