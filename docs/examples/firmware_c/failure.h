/* The reason for a failure: one line for the reader of the answer. */
#ifndef FAILURE_H
#define FAILURE_H

#include <stdbool.h>

struct failure {
    char text[512];
};

/* Store the line, unless there is one already, and return false. */
bool fail(struct failure *failure, const char *format, ...);

#endif
