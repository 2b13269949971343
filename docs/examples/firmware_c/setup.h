/* Where sensors and axles are, from the setup in recording.json. */
#ifndef SETUP_H
#define SETUP_H

#include "json.h"
#include "recording.h"

/* Read the places of all wheel paths; those that are not stated are the usual ones. */
bool setup_read(struct recording *recording, struct json document, struct failure *failure);

#endif
