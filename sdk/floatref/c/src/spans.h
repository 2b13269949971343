/* SPDX-License-Identifier: Apache-2.0
 *
 * Spans of samples that measure nothing, as the screening reports them.
 */
#ifndef FR_SPANS_H
#define FR_SPANS_H

#include "samples.h"

/* Write a span, if there is an array, and count it. */
static inline size_t fr_report(fr_span *spans, size_t made, int64_t first, int64_t behind,
                               int32_t kind)
{
    if (spans != NULL) {
        spans[made].first = first;
        spans[made].behind = behind;
        spans[made].kind = kind;
        spans[made].reserved = 0;
    }
    return made + 1u;
}

/* Whether there is room for `needed` spans; *written gets that number, 0 for a NULL pointer. */
static inline fr_status fr_room_for_spans(size_t needed, const fr_span *spans, size_t capacity,
                                          size_t *written)
{
    *written = 0u;
    if (needed > 0u && spans == NULL)
        return FR_NULL_POINTER;
    *written = needed;
    return needed > capacity ? FR_OUTPUT_FULL : FR_OK;
}

#endif
