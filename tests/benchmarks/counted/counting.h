/* SPDX-License-Identifier: Apache-2.0
 *
 * Included before `.ci/embedded/pieces.c`, so that one program has all stages at any length.
 */
#ifndef COUNTING_H
#define COUNTING_H

/* The stage that runs, and its pieces of 10 ms behind those of the start. */
extern void (*counted_stage)(void);
extern int counted_pieces;

#define STAGE counted_stage
#define WARM 30
#define TIMED counted_pieces

#endif
