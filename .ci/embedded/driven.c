/* SPDX-License-Identifier: Apache-2.0 */
#include <string.h>

#include "driven.h"

enum { TRACED_PIECES = 6 };

uint64_t large[LARGE / 8u] BOARD_FAR;
drive on_road;
double heights[POINTS];

static size_t pieces_of(double length_s)
{
    return (size_t)(100.0 * length_s);
}

void begin_drive(int32_t cruise_ms)
{
    (void)memset(&on_road, 0, sizeof on_road);
    on_road.rate = now.rate;
    on_road.cruise_ms = cruise_ms;
    on_road.stand_ms = 1000;
}

static uint64_t timed(void *object, size_t piece, push_of push, end_of end, size_t *written)
{
    uint32_t begin = board_ticks(), taken;
    fr_status status = end != NULL ? end(object, written) : push(object, piece, written);
    taken = since(begin);
    if (status != FR_OK)
        board_put("refused\n");
    return taken;
}

size_t try_drive(void *object, size_t bytes, length run, push_of push, end_of end)
{
    size_t piece = now.rate / 100u, written = 0, shown = 0;
    size_t warm = is_traced() ? TRACED_PIECES : pieces_of(run.warm_s);
    size_t all = is_traced() ? warm + 1u : warm + pieces_of(run.timed_s);
    uint64_t ticks = 0, longest = 0, taken = 0;
    for (size_t k = 0; k < all; k++) {
        drive_next(&on_road, piece);
        if (k < warm && push(object, piece, &written) != FR_OK)
            board_put("refused\n");
        if (k >= warm)
            taken = timed(object, piece, push, NULL, &written);
        ticks += taken;
        longest = taken > longest ? taken : longest;
        shown = written > 0u ? written : shown;
    }
    taken = timed(object, piece, push, end, &written);
    put_costs(bytes, (uint64_t)(all - warm) * piece, is_traced() ? ticks + taken : ticks, longest);
    return written > 0u ? written : shown;
}
