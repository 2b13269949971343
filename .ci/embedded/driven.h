/* SPDX-License-Identifier: Apache-2.0
 *
 * What stages on a drive with stops share: its signals, memory, and the loop over pieces of 10 ms.
 */
#ifndef DRIVEN_H
#define DRIVEN_H

#include "drive.h"
#include "stages.h"

#define GRAVITY_MPS2 9.80665
#define LARGE (15u << 20)

extern uint64_t large[LARGE / 8u];
extern drive on_road;
extern double heights[POINTS];

/* The end of a run. */
typedef fr_status (*end_of)(void *object, size_t *written);

/* Seconds before the clock and with it. Where every instruction is traced a run has a few pieces in
 * place of both, and its end is timed. */
typedef struct length {
    double warm_s, timed_s;
} length;

/* A drive that brakes after `cruise_ms`, again and again. */
void begin_drive(int32_t cruise_ms);

/* Push pieces and report the costs; the outputs of the last push that gave any. */
size_t try_drive(void *object, size_t bytes, length run, push_of push, end_of end);

/* Place an object of `kind` and run it. */
#define DRIVE(kind, config, run, put, from)                                                \
    do {                                                                                   \
        fr_##kind *object = NULL;                                                          \
        if (fr_##kind##_init(large, sizeof large, &(config), &object) != FR_OK)            \
            board_put("not possible\n");                                                   \
        else                                                                               \
            put(try_drive(object, fr_##kind##_size(&(config)), run, push_##kind, end_##kind), \
                from);                                                                     \
    } while (0)

#endif
