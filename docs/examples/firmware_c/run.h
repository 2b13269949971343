/* One run: from a recording directory to a profile directory. */
#ifndef RUN_H
#define RUN_H

#include "failure.h"

/* Process the recording.json at `recording` into the new folder `profile`. */
bool run(const char *recording, const char *profile, struct failure *failure);

#endif
