/* SPDX-License-Identifier: Apache-2.0
 *
 * What stages share: the signals, the memory, and the loop over pieces of 10 ms.
 */
#ifndef STAGES_H
#define STAGES_H

#include "board.h"
#include "signals.h"

#define RATE_HZ ((double)now.rate)
#define COUNT_M 0.001
#define INTERVAL_M 0.025
enum { MEMORY = 65536, POINTS = 1024 };

extern signals now;
extern uint64_t memory[MEMORY / 8];
extern fr_real out[POINTS], beside[POINTS];
extern fr_span spans[8];

/* One push of `count` samples; the status. */
typedef fr_status (*push_of)(void *object, size_t count, size_t *written);

/* Ticks since `begin`. */
uint32_t since(uint32_t begin);

/* Pieces before the clock, which are longer than any start, and with it. */
int warm_pieces(void);
int timed_pieces(void);

/* Whether each instruction is looked at, so that a run has to be short. */
int is_traced(void);

/* A line of the bytes of the object, the samples that were timed, the ticks of all and of the
 * longest push; and a line of the bits of some outputs. */
void put_costs(size_t bytes, uint64_t samples, uint64_t ticks, uint64_t longest);
void put_bits(size_t written, const fr_real *values);
void put_doubles(size_t written, const double *values);

/* Push pieces, untimed until the start is over, and report the costs; what the last has written. */
size_t run_pieces(void *object, size_t bytes, push_of push);

/* The same, and the last of what is in `out`. */
void try_pieces(void *object, size_t bytes, push_of push);

/* Call `push` once with all `points` of a profile in `out` and `beside`, and report. */
void try_profile(push_of push, void *config, size_t points);

/* Place an object of `kind` in the memory and run it; `config` is set before. */
#define RUN(kind, config, push)                                                            \
    do {                                                                                   \
        fr_##kind *object = NULL;                                                          \
        if (fr_##kind##_init(memory, sizeof memory, &(config), &object) != FR_OK)          \
            board_put("not possible\n");                                                   \
        else                                                                               \
            try_pieces(object, fr_##kind##_size(&(config)), push);                         \
    } while (0)

/* The function `fr_call` of one output as a push_of: of an object or of settings, and of inputs. */
#define PUSH(call, type, ...)                                                              \
    static fr_status call(void *object, size_t count, size_t *written)                     \
    {                                                                                      \
        return fr_##call((type *)object, __VA_ARGS__, count, out, POINTS, written);        \
    }

#endif
