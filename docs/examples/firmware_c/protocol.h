/* The exec protocol: one JSON object per line on stdin, one on stdout. */
#ifndef PROTOCOL_H
#define PROTOCOL_H

#include "failure.h"
#include "json.h"

struct device {
    const char *name, *version, *architecture;
    /* Process a recording into a profile; false and the reason if it cannot. */
    bool (*run)(const char *recording, const char *profile, struct failure *failure);
    /* If not NULL, every run is skipped for this reason. */
    const char *skips;
    /* If not NULL, the device streams: answer a message of a stream; false if it was the last. */
    bool (*stream)(struct json message);
};

/* Answer requests until `stop` or the end of the input; return the exit code. */
int serve(const struct device *device);

#endif
