/* SPDX-License-Identifier: Apache-2.0
 *
 * Heights from the first one: the elevation of a profile has no datum of its own, (1.2), and a
 * high-pass filter then starts without a step of the sensor's stand-off.
 */
#ifndef FR_DATUM_H
#define FR_DATUM_H

#include "samples.h"

typedef struct fr_datum {
    int32_t known;
    fr_real height;
} fr_datum;

static inline fr_real fr_from_datum(fr_datum *datum, fr_real height)
{
    if (datum->known == 0 && !fr_missing(height)) {
        datum->known = 1;
        datum->height = height;
    }
    return height - datum->height;
}

#endif
