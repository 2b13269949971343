/* SPDX-License-Identifier: Apache-2.0
 *
 * What a program that measures stages needs from where it runs: an emulated board, or the host.
 */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Memory beside that of the core, which is not cleared; the host has one. */
#ifdef __arm__
#define BOARD_FAR __attribute__((section(".far")))
#else
#define BOARD_FAR
#endif

/* Ticks of a clock that counts down and wraps at 32 bits; 0 on the host, which is not timed. */
uint32_t board_ticks(void);
void board_put(const char *text);
void board_put_number(uint64_t number);

/* What the program does. */
void measure(void);

#endif
