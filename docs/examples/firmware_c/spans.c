#include "spans.h"

#include <stdlib.h>

enum { FIRST_ROOM = 32 };

bool spans_add(struct spans *spans, long first, long behind, struct failure *failure)
{
    if (spans->count == spans->room) {
        long room = spans->room > 0 ? 2 * spans->room : FIRST_ROOM;
        struct span *grown = realloc(spans->span, (size_t)room * sizeof *grown);
        if (grown == NULL)
            return fail(failure, "out of memory for %ld damaged stretches", room);
        spans->span = grown;
        spans->room = room;
    }
    spans->span[spans->count++] = (struct span){first, behind};
    return true;
}

static int in_order(const void *a, const void *b)
{
    const struct span *p = a, *q = b;
    return (p->first > q->first) - (p->first < q->first);
}

void spans_settle(struct spans *spans)
{
    long kept = 0;
    if (spans->count > 0)
        qsort(spans->span, (size_t)spans->count, sizeof *spans->span, in_order);
    for (long k = 0; k < spans->count; k++) {
        struct span *last = kept > 0 ? &spans->span[kept - 1] : NULL, here = spans->span[k];
        if (last != NULL && here.first <= last->behind)
            last->behind = here.behind > last->behind ? here.behind : last->behind;
        else
            spans->span[kept++] = here;
    }
    spans->count = kept;
    spans->at = 0;
}

bool spans_hold(struct spans *spans, long index)
{
    while (spans->at > 0 && spans->span[spans->at - 1].behind > index)
        spans->at--;
    while (spans->at < spans->count && spans->span[spans->at].behind <= index)
        spans->at++;
    return spans->at < spans->count && spans->span[spans->at].first <= index;
}

void spans_free(struct spans *spans)
{
    free(spans->span);
    *spans = (struct spans){NULL, 0, 0, 0};
}
