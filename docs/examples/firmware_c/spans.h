/* Stretches of samples, in order and apart from each other. */
#ifndef SPANS_H
#define SPANS_H

#include "failure.h"

struct span {
    long first, behind;
};

/* Memory is taken when a stretch is found, and twice as much each time it is full. */
struct spans {
    struct span *span;
    long count, room, at;
};

/* Add samples `first` to `behind - 1`; none that begins before an earlier one. */
bool spans_add(struct spans *spans, long first, long behind, struct failure *failure);

/* Whether sample `index` lies in one of them; fast if asked for one index after the other. */
bool spans_hold(struct spans *spans, long index);

void spans_free(struct spans *spans);

#endif
