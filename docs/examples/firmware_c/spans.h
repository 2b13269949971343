/* Stretches of samples, in order and apart from each other. */
#ifndef SPANS_H
#define SPANS_H

#include "failure.h"

struct span {
    long first, behind;
};

/* Memory is allocated when a stretch is found, and doubled each time it is full. */
struct spans {
    struct span *span;
    long count, room, at;
};

/* Add samples `first` to `behind - 1`. */
bool spans_add(struct spans *spans, long first, long behind, struct failure *failure);

/* Put all in order and join those that touch, before they are asked for. */
void spans_settle(struct spans *spans);

/* Whether sample `index` is in one of them; fast for one index after the other. */
bool spans_hold(struct spans *spans, long index);

void spans_free(struct spans *spans);

#endif
