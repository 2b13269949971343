#include "spans.h"

#include <stdlib.h>

enum { FIRST_ROOM = 32 };

bool spans_add(struct spans *spans, long first, long behind, struct failure *failure)
{
    struct span *last = spans->count > 0 ? &spans->span[spans->count - 1] : NULL;
    if (last != NULL && first <= last->behind) {
        last->behind = behind > last->behind ? behind : last->behind;
        return true;
    }
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
