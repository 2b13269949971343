/* SPDX-License-Identifier: Apache-2.0
 *
 * What every object starts with, and the checks that every call begins with.
 */
#ifndef FR_OBJECT_H
#define FR_OBJECT_H

#include "floatref.h"

/* A kind of object. The size of fr_real is part of it, so that a copy from the other build of the
 * library is no object. */
#define FR_MAGIC(number) ((uint32_t)0x46520000u + (uint32_t)(number) * 16u + (uint32_t)sizeof(fr_real))

enum { FR_STATE_RUNNING = 1, FR_STATE_ENDED = 2 };

/* More samples than this are a size that has run over. */
#define FR_MOST_SAMPLES (SIZE_MAX / 64u)

typedef struct fr_head {
    uint32_t magic;
    uint32_t state;
} fr_head;

/* Bytes of a struct, so that an array of int64_t or fr_real behind it is aligned. */
#define FR_PADDED(type) ((sizeof(type) + (FR_ALIGNMENT - 1u)) / FR_ALIGNMENT * FR_ALIGNMENT)

/* Where that array starts. */
#define FR_BEHIND(object, type) ((void *)((unsigned char *)(object) + FR_PADDED(type)))

/* Whether an object that needs `needed` bytes, 0 for a bad configuration, can be placed; if so its
 * memory is cleared and the head is written. */
fr_status fr_place(void *memory, size_t size, const void *config, const void *out, size_t needed,
                   uint32_t magic);

/* Whether `object` starts with the head of a running object of this kind. */
fr_status fr_ready(const void *object, uint32_t magic);

/* The same of an object whose run may have ended: its results are still there. */
fr_status fr_readable(const void *object, uint32_t magic);

/* Whether `count` samples fit into `y`. */
fr_status fr_room(size_t count, const void *y, size_t capacity, size_t *written);

#endif
