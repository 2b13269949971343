/* SPDX-License-Identifier: Apache-2.0
 *
 * The loop that pushes the pieces of a stage, by the clock, and what is printed of it. STAGE names
 * the stage that an image has; the linker leaves out the others.
 */
#include <string.h>

#include "stages.h"

#ifndef STAGE
#error "STAGE is the name of a function of a stages_of_...c"
#endif

#ifndef WARM
#define WARM 30
#define TIMED 100
#endif

#ifndef TRACED
#define TRACED 0
#endif
enum { SHOWN = 16 };

#ifndef COUNTING_H
void STAGE(void);
#endif

signals now;
uint64_t memory[MEMORY / 8];
fr_real out[POINTS], beside[POINTS];
fr_span spans[8];

void board_put_number(uint64_t number)
{
    char text[24], *at = text + sizeof text - 1;
    *at = '\0';
    do
        *--at = (char)('0' + (int)(number % 10u));
    while ((number /= 10u) != 0u);
    board_put(at);
}

static void put_hexadecimal(const void *x, size_t size)
{
    uint64_t bits = 0;
    char text[18] = " ";
    (void)memcpy(&bits, x, size);
    for (size_t i = 0; i < 2u * size; i++) {
        text[2u * size - i] = "0123456789abcdef"[bits & 15u];
        bits >>= 4;
    }
    text[2u * size + 1u] = '\0';
    board_put(text);
}

/* The last of `count` values, each of `size` bytes, the latest first. */
static void put_last(const void *values, size_t count, size_t size)
{
    board_put("bits");
    for (size_t i = 0; i < SHOWN && i < count; i++)
        put_hexadecimal((const unsigned char *)values + (count - 1u - i) * size, size);
    board_put("\n");
}

void put_bits(size_t written, const fr_real *values)
{
    put_last(values, written, sizeof *values);
}

void put_doubles(size_t written, const double *values)
{
    put_last(values, written, sizeof *values);
}

uint32_t since(uint32_t begin)
{
    return begin - board_ticks();
}

int warm_pieces(void)
{
    return WARM;
}

int timed_pieces(void)
{
    return TIMED;
}

int is_traced(void)
{
    return TRACED;
}

static void put_named(const char *name, uint64_t number)
{
    board_put(name);
    board_put_number(number);
}

void put_costs(size_t bytes, uint64_t samples, uint64_t ticks, uint64_t longest)
{
    put_named("rate ", now.rate);
    put_named(" bytes ", bytes);
    put_named(" samples ", samples);
    put_named(" ticks ", ticks);
    put_named(" longest ", longest);
    board_put("\n");
}

size_t run_pieces(void *object, size_t bytes, push_of push)
{
    size_t piece = now.rate / 100u, written = 0;
    uint64_t ticks = 0, longest = 0;
    for (int k = 0; k < warm_pieces() + timed_pieces(); k++) {
        uint32_t begin, taken;
        fr_status status;
        signals_next(&now, piece);
        begin = board_ticks();
        status = push(object, piece, &written);
        taken = since(begin);
        if (status != FR_OK)
            board_put("refused\n");
        if (k >= warm_pieces()) {
            ticks += taken;
            longest = taken > longest ? taken : longest;
        }
    }
    put_costs(bytes, (uint64_t)timed_pieces() * piece, ticks, longest);
    return written;
}

void try_pieces(void *object, size_t bytes, push_of push)
{
    put_bits(run_pieces(object, bytes, push), out);
}

void try_profile(push_of push, void *config, size_t points)
{
    size_t written = 0;
    uint32_t begin, ticks;
    fr_status status;
    for (size_t done = 0; done < points; done += MOST) {
        size_t count = points - done < MOST ? points - done : MOST;
        signals_next(&now, count);
        (void)memcpy(out + done, now.height, count * sizeof *out);
        (void)memcpy(beside + done, now.force, count * sizeof *beside);
    }
    begin = board_ticks();
    status = push(config, points, &written);
    ticks = since(begin);
    if (status != FR_OK)
        board_put("refused\n");
    put_costs(0u, points, ticks, ticks);
    put_bits(written, out);
}

/* The harness itself, an empty push. */
static fr_status push_nothing(void *object, size_t count, size_t *written)
{
    (void)object;
    *written = 0u * count;
    return FR_OK;
}

void stage_nothing(void)
{
    try_pieces(NULL, 0u, push_nothing);
}

void measure(void)
{
    static const uint32_t rates[] = {4000u, 16000u};
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        (void)memset(&now, 0, sizeof now);
        now.rate = rates[i];
        STAGE();
    }
}
