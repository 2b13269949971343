/* Where sensors and axles are, from the setup in recording.json. */
#ifndef SETUP_H
#define SETUP_H

#include "json.h"
#include "recording.h"

/* Read the places of all wheel paths; those that are not stated are the usual ones. */
bool setup_read(struct recording *recording, struct json document, struct failure *failure);

/* Where axles and lasers are, ahead of the middle of the lasers. */
void place_vehicle(struct vehicle *vehicle, const struct recording *recording);

#endif
