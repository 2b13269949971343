/* Why something could not be done: one line for whoever reads the answer. */
#ifndef FAILURE_H
#define FAILURE_H

#include <stdbool.h>

struct failure {
    char text[512];
};

/* Keep the line, unless there is one already, and return false. */
bool fail(struct failure *failure, const char *format, ...);

#endif
