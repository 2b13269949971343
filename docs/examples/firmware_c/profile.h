/* Write a profile directory, floatref-profile/1. */
#ifndef PROFILE_H
#define PROFILE_H

#include "points.h"
#include "recording.h"

/* Make the folder `path` with the contents of `points`; its flags are 1, valid, or 0. */
bool profile_write(const char *path, const struct recording *recording,
                   const struct points *points, struct failure *failure);

#endif
